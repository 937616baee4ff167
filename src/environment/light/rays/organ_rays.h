// Rays from the surfaces of organs to the sources of light: how many, and where they begin.
#pragma once

#include "environment/light/rays/light_sources.h"
#include "environment/light/rays/lit_triangles.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace espalier::environment {

class OrganRays {
public:
    /// All triangles of a module, or of all solids.
    struct Organ {
        std::size_t first, end;                   ///< among the triangles, organ by organ
        std::uint64_t key;                        ///< of its random numbers: by where it is
        std::uint32_t place;                      ///< along a curve that keeps neighbours together
        std::array<double, source_kinds> open{};  ///< about the mol that each kind brings where nothing shades it
        std::array<std::uint32_t, source_kinds> rays{};  ///< to each kind, in each trial
    };
    struct Begin {
        std::size_t triangle;
        LitPatch patch;
        double open;  ///< the patch's
        glm::dvec3 place;
    };

    /// Keeps a reference to the triangles.
    void set(const LitTriangles& triangles, std::size_t slots, const LightSources& sources);
    /// Shares out about so many rays of each trial. Where they are enough for all organs, a half goes to each evenly, a
    /// half by the light that is open to it. Where they are not, the light of sun and sky on most organs is left to
    /// projections, of which a point stands for `point` mol, and organs on which few of these fall get the rays.
    void share_out(double rays, double point);
    /// Whether its light of sun and sky is left to projections.
    bool is_projected(const LitTriangles::Owner& owner) const { return projected_[organ_number(owner)] != 0; }
    bool has_projected() const { return has_projected_; }
    /// Whether it is so small that hardly a path meets it: its rays look for scattered light, too.
    bool is_small(const LitTriangles::Owner& owner) const { return small_[organ_number(owner)] != 0; }
    /// Which are small: where the light of less than so many mol would meet them.
    void find_small(double light);

    /// Neighbours stand near each other; in the same order however the plants are numbered.
    std::span<const Organ> organs() const { return organs_; }
    const LitTriangles::Owner& owner(const Organ& organ) const { return triangles_->owner(order_[organ.first]); }
    /// Where a ray to a kind of source begins, by two numbers in [0, 1).
    Begin begin(const Organ& organ, SourceKind kind, double u, double v) const;

private:
    struct Triangle {
        std::array<double, source_kinds> open;  ///< sums up to each triangle of an organ
    };

    std::size_t organ_number(const LitTriangles::Owner& owner) const {
        return owner.kind == LitKind::solid ? projected_.size() - 1 : owner.slot;
    }
    void sort_by_organ();
    void share_out_to_all(SourceKind kind, double rays);
    void share_out_to_small(double rays, double point);
    void look_at(Organ& organ, const LightSources& sources);
    LitPatch patch(std::size_t triangle) const;
    std::uint64_t key_of(std::size_t triangle) const;
    std::uint32_t place_of(std::size_t triangle) const;

    const LitTriangles* triangles_ = nullptr;
    std::vector<std::size_t> order_;  ///< triangles, organ by organ
    std::vector<Triangle> sums_;      ///< in that order
    std::vector<Organ> organs_;
    std::vector<std::uint8_t> projected_, small_;  ///< by module; that behind the last are the solids
    bool has_projected_ = false;
};

}  // namespace espalier::environment
