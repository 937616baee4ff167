// The light of a step, organ by organ: what both processes of measured light answer, count and record.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/light/sky/daylight.h"

#include <span>
#include <string>
#include <vector>

namespace espalier::environment {

/// Light that modules meet and absorb. Modules of all plants are numbered one after the other: slots.
class OrganLight {
public:
    /// What one module has met in a band, as mol of photons of PAR before the band's own factor.
    struct Meeting {
        double front = 0, back = 0;  ///< incident on the two sides of leaves, and on stems
        double absorbed = 0;
        double error = 0;  ///< standard error of `absorbed`; NaN: unknown
    };
    /// What it has met before light was scattered.
    struct View {
        double sun = 0, open_sun = 0;  ///< of the sun, and what it would be without shade
        glm::dvec3 towards{0, 0, 0};   ///< to the sources, weighted with their light
    };

    OrganLight(const Settings& settings, const std::vector<LightBand>& bands, std::size_t plants);

    /// Begins a step without light. At step 0 no time has passed: shares and rates are those of `light`, and amounts 0.
    void begin(const WorldView& world, const Daylight& light);
    bool has_time_passed() const { return has_time_passed_; }
    std::size_t slots() const { return starts_.back(); }
    std::size_t bands() const { return bands_.size(); }
    /// Of a plant's first module; that of the plant behind it is its end.
    std::size_t start(std::size_t plant) const { return starts_[plant]; }
    /// The factor from photons of PAR to those of a band.
    double factor(std::size_t band) const { return factors_[band]; }

    Meeting& meeting(std::size_t slot, std::size_t band) { return meetings_[slot * bands() + band]; }
    View& view(std::size_t slot) { return views_[slot]; }
    double& leaf_area(std::size_t slot) { return areas_[slot]; }
    /// Half the surface of bodies: the light meets half of this on average, as of leaves.
    double& body_area(std::size_t slot) { return body_areas_[slot]; }

    /// Writes f, m, e of each band; `open_share(band)` is f where the module behind the query draws nothing. In the
    /// dark f stays what it is if the scene says so.
    template <class OpenShare>
    void answer(const Query& query, std::size_t offset, Answer answer, const OpenShare& open_share) const {
        for (std::size_t b = 0; b < bands() && 3 * b < answer.size(); ++b) {
            const Answered answered = answered_by(query, offset, b);
            const Answer own = answer.subspan(3 * b);
            if (!keeps_share_) own[0] = answered.area > 0 ? answered.share : open_share(b);
            if (own.size() > 1) own[1] = answered.amount;
            if (own.size() > 2) own[2] = answered.rate;
        }
    }

    /// absorbed and its error for each band, leaf_area, mean, incoming.
    std::vector<Quantity> statistics(std::uint32_t plant, bool with_errors, const std::vector<double>& errors) const;
    /// What a timeline may record of each organ.
    std::vector<OrganQuantity> organ_quantities(bool with_errors) const;
    std::shared_ptr<const std::vector<float>> organ_values(const std::string& name, std::uint32_t plant) const;

    /// From photons of PAR to what is answered and recorded in a band, mol or MJ.
    double amount(double photons, std::size_t band) const { return has_time_passed_ ? in_unit(photons, band) : 0; }
    std::string unit() const { return in_energy_ ? "MJ" : "mol"; }

    static const std::string& help();

private:
    struct Answered {
        double area, share, amount, rate;
    };
    double in_unit(double photons, std::size_t band) const { return photons * factors_[band] * units_[band]; }
    Answered answered_by(const Query& query, std::size_t offset, std::size_t band) const;
    double area_of(std::size_t slot) const { return areas_[slot] > 0 ? areas_[slot] : body_areas_[slot]; }
    double value(const std::string& what, std::size_t slot, std::size_t band) const;

    std::vector<LightBand> bands_;
    bool in_energy_, keeps_in_dark_;
    std::vector<double> units_;  ///< by band: from mol to what is answered, mol or MJ
    std::size_t plants_;

    Daylight light_;
    bool has_time_passed_ = true, keeps_share_ = false;  ///< of the step
    std::vector<std::size_t> starts_;
    std::vector<double> factors_, areas_, body_areas_;
    std::vector<Meeting> meetings_;
    std::vector<View> views_;
};

}  // namespace espalier::environment
