// The origin of a scene on the map: files may hold places that are hundreds of kilometres from 0.
#pragma once

#include "espalier/base/error.h"

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace espalier {

/// Places that a scene writes are relative to it; those of files are of the map, and it is subtracted from them. All in
/// metres, with y upwards.
class MapOrigin {
public:
    /// Places farther from 0 than this are of a map: 32 bits keep a millimetre up to here.
    static constexpr double far_away = 10000;

    /// Without a given one, the first file whose places lie far away decides it: rounded to 100 m, along the axes on
    /// which they do. Files near 0 then are relative to the scene, as if nothing had been decided.
    explicit MapOrigin(std::optional<glm::dvec3> given = {}) : value_(given), is_given_(given.has_value()) {}

    /// What is subtracted from the places of a file, which lie between two corners.
    glm::dvec3 of(const glm::dvec3& lower, const glm::dvec3& upper, const Place& file);
    /// A place less what is subtracted. Decimals of a map come out as they were written, up to seven of them.
    static glm::dvec3 shifted(const glm::dvec3& place, const glm::dvec3& subtracted);

    /// That of the scene whose files this thread reads; null: nothing is subtracted.
    static MapOrigin* current();

    /// Makes an origin the current one of this thread while it lives; null: none.
    class Scope {
    public:
        explicit Scope(MapOrigin* origin);
        ~Scope();
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        MapOrigin* before_;
    };

    /// None: nobody said or needed one.
    const std::optional<glm::dvec3>& value() const { return value_; }
    /// What is to be said of it since the last call.
    std::vector<Diagnostic> take_warnings();

private:
    std::optional<glm::dvec3> value_;
    bool is_given_;
    std::vector<Diagnostic> warnings_;
};

}  // namespace espalier
