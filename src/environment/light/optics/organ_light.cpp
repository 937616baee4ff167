#include "environment/light/optics/organ_light.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace espalier::environment {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

/// "absorbed" and "absorbed.nir": the first band has no name of its own.
std::string of_band(const std::string& quantity, const std::vector<LightBand>& bands, std::size_t band) {
    return band == 0 ? quantity : quantity + "." + bands[band].name;
}

}  // namespace

OrganLight::OrganLight(const Settings& settings, const std::vector<LightBand>& bands, std::size_t plants)
    : bands_(bands),
      in_energy_(settings.choice_or("unit", "photons", {"photons", "energy"}) == "energy"),
      keeps_in_dark_(settings.choice_or("dark", "keep", {"keep", "zero"}) == "keep"),
      plants_(plants),
      starts_(plants + 1, 0) {
    for (const LightBand& band : bands_) units_.push_back(in_energy_ ? 1 / band.photons : 1);  // MJ of a mol
    factors_.assign(bands_.size(), 1);
}

void OrganLight::begin(const WorldView& world, const Daylight& light) {
    light_ = light;
    has_time_passed_ = world.step > 0;
    keeps_share_ = keeps_in_dark_ && !(light.on_ground > 0);
    for (std::size_t b = 0; b < bands_.size(); ++b) {
        factors_[b] = light.energy > 0 ? light.photons(bands_[b]) / light.on_ground : 1;  // lamps have their own
    }
    std::fill(starts_.begin(), starts_.end(), 0);
    for (const PlantView& plant : world.plants) {
        if (plant.plant < plants_) starts_[plant.plant + 1] = plant.string->size();
    }
    for (std::size_t plant = 0; plant < plants_; ++plant) starts_[plant + 1] += starts_[plant];
    meetings_.assign(slots() * bands(), {});
    views_.assign(slots(), {});
    areas_.assign(slots(), 0);
    body_areas_.assign(slots(), 0);
}

OrganLight::Answered OrganLight::answered_by(const Query& query, std::size_t offset, std::size_t band) const {
    if (query.plant >= plants_ || query.module + offset >= starts_[query.plant + 1] - starts_[query.plant]) return {};
    const std::size_t slot = starts_[query.plant] + query.module + offset;
    const double area = area_of(slot);
    const double absorbed = meetings_[slot * bands() + band].absorbed;
    const double per_area = area > 0 ? absorbed / area : 0;
    const double in_time = light_.seconds > 0 ? 1e6 * in_unit(per_area, band) / light_.seconds : 0;
    return {area, light_.on_ground > 0 ? per_area / light_.on_ground : 0, amount(absorbed, band), in_time};
}

std::vector<Quantity> OrganLight::statistics(std::uint32_t plant, bool with_errors,
                                             const std::vector<double>& errors) const {
    const bool is_known = plant < plants_;
    double area = 0;
    std::vector<double> absorbed(bands(), 0);
    for (std::size_t slot = is_known ? starts_[plant] : 0; is_known && slot < starts_[plant + 1]; ++slot) {
        area += areas_[slot];
        for (std::size_t b = 0; b < bands(); ++b) absorbed[b] += meetings_[slot * bands() + b].absorbed;
    }
    const char* const unit = in_energy_ ? "MJ" : "mol";
    std::vector<Quantity> quantities;
    for (std::size_t b = 0; b < bands(); ++b) {
        quantities.push_back({of_band("absorbed", bands_, b), amount(absorbed[b], b), unit});
        if (!with_errors) continue;
        const double error = b < errors.size() ? errors[b] : 0;
        quantities.push_back({of_band("absorbed_error", bands_, b), amount(error, b), unit});
    }
    const double open = light_.on_ground * area;
    quantities.push_back({"leaf_area", area, "m2"});
    quantities.push_back({"mean", open > 0 ? absorbed[0] / open : no_value});
    for (std::size_t b = 0; b < bands(); ++b) {
        quantities.push_back({of_band("incoming", bands_, b), amount(light_.on_ground, b), std::string(unit) + "/m2"});
    }
    return quantities;
}

std::vector<OrganQuantity> OrganLight::organ_quantities(bool with_errors) const {
    const std::string unit = in_energy_ ? "MJ" : "mol";
    std::vector<OrganQuantity> all;
    for (std::size_t b = 0; b < bands(); ++b) {
        all.push_back({of_band("absorbed", bands_, b), unit, "light that the organ absorbs in the step"});
        all.push_back({of_band("flux", bands_, b), in_energy_ ? "W m-2" : "umol m-2 s-1",
                       "light that leaves absorb per area of one side, while there is light"});
        all.push_back({of_band("power", bands_, b), "W m-2",
                       "energy that leaves absorb per area of one side, while there is light"});
        all.push_back({of_band("front", bands_, b), unit, "light that falls on the front"});
        all.push_back({of_band("back", bands_, b), unit, "light that falls on the back"});
        all.push_back({of_band("reflected", bands_, b), unit, "light that falls on the organ and is not absorbed"});
        all.push_back(
            {of_band("direct", bands_, b), "", "share of what leaves absorb that comes straight from the sun"});
        if (with_errors) all.push_back({of_band("error", bands_, b), unit, "standard error of what it absorbs"});
    }
    all.push_back({"area", "m2", "area of leaves, one side"});
    all.push_back({"lit", "s", "how long there is light in the step"});
    all.push_back({"sunlit", "", "share of the sun's light that no other organ takes away"});
    all.push_back({"brightest", "", "direction to the light that falls on it, as a mean", 3});
    return all;
}

double OrganLight::value(const std::string& what, std::size_t slot, std::size_t band) const {
    const Meeting& meeting = meetings_[slot * bands() + band];
    if (what == "absorbed") return amount(meeting.absorbed, band);
    if (what == "front") return amount(meeting.front, band);
    if (what == "back") return amount(meeting.back, band);
    if (what == "reflected") return amount(meeting.front + meeting.back - meeting.absorbed, band);
    if (what == "error") return amount(meeting.error, band);
    const double area = area_of(slot);
    if (!(area > 0 && light_.seconds > 0)) return no_value;
    if (what == "direct") {
        const double met = meeting.front + meeting.back;
        return met > 0 ? std::min(1.0, views_[slot].sun / met) : 0;
    }
    const double photons = 1e6 * meeting.absorbed * factors_[band] / area / light_.seconds;
    if (what == "power") return photons / bands_[band].photons;
    return units_[band] * photons;
}

std::shared_ptr<const std::vector<float>> OrganLight::organ_values(const std::string& name, std::uint32_t plant) const {
    if (plant >= plants_) return nullptr;
    const std::size_t first = starts_[plant], end = starts_[plant + 1];
    auto values = std::make_shared<std::vector<float>>();
    if (name == "brightest") {
        for (std::size_t slot = first; slot < end; ++slot) {
            const double length = glm::length(views_[slot].towards);
            for (int k = 0; k < 3; ++k) {
                values->push_back(static_cast<float>(length > 0 ? views_[slot].towards[k] / length : no_value));
            }
        }
        return values;
    }
    if (name == "area" || name == "lit") {
        for (std::size_t slot = first; slot < end; ++slot) {
            const bool is_leaf = areas_[slot] > 0;
            const double value = name == "area" ? areas_[slot] : has_time_passed_ ? light_.seconds : 0;
            values->push_back(static_cast<float>(is_leaf ? value : no_value));
        }
        return values;
    }
    const std::size_t dot = name.find('.');
    std::size_t band = 0;
    for (std::size_t b = 1; b < bands(); ++b) {
        if (dot != std::string::npos && name.substr(dot + 1) == bands_[b].name) band = b;
    }
    const std::string what = name.substr(0, dot);
    for (std::size_t slot = first; slot < end; ++slot) {
        const View& view = views_[slot];
        const double sunlit = view.open_sun > 0 ? view.sun / view.open_sun : no_value;
        values->push_back(static_cast<float>(what == "sunlit" ? sunlit : value(what, slot, band)));
    }
    return values;
}

const std::string& OrganLight::help() {
    static const std::string text =
        R"(unit          "photons": light is answered, counted and recorded in mol, and in umol m-2 s-1; or "energy": MJ and W m-2
dark          "keep": in a step without light there is no share of it, and f stays what it was, so that models which shed
              leaves by their f do not shed all of them at night; or "zero": f is 0. e and m are 0 in any case
)";
    return text;
}

}  // namespace espalier::environment
