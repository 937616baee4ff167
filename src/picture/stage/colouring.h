// What colours the organs of a frame: the model's own colours, a number, or a name.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/picture/picture_style.h"

#include "picture/palette.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace espalier::picture {

/// The legend's content: a bar from low to high, or names with their colours.
struct ColourKey {
    std::string title;
    std::array<double, 2> range{0, 1};
    std::span<const Rgb> colours;  ///< colours of a bar; empty for names
    std::vector<std::pair<std::string, Rgb>> names;
};

class Colouring {
public:
    /// Throws UserError, naming the nearest, if the run has no such array.
    Colouring(const RecordedRun& run, const std::string& name);

    /// Every name it may bear for a run, "natural" first.
    static std::vector<std::string> names(const RecordedRun& run);
    /// Those that need nothing chosen.
    static std::vector<std::string> names_of_every_run();

    bool is_natural() const { return name_ == "natural"; }
    bool is_number() const { return !is_natural() && !is_category(); }

    /// A number per point of the frame; NaN where there is none.
    std::vector<double> values(const RecordedRun& run, const RecordedFrame& frame, const FrameGeometry& geometry) const;
    /// A colour per point of the frame. `range`: of numbers.
    std::vector<Rgb> colours(const RecordedRun& run, const RecordedFrame& frame, const FrameGeometry& geometry,
                             const std::array<double, 2>& range) const;
    /// None for natural colours, and for names too many for a key.
    std::optional<ColourKey> key(const RecordedRun& run, const FrameGeometry& geometry,
                                 const std::array<double, 2>& range) const;

private:
    bool is_category() const;
    std::string name_of(const RecordedRun& run, const FrameGeometry& geometry, std::size_t value) const;

    std::string name_;
    std::string title(const FrameGeometry& geometry) const;

    std::string field_, field_unit_;  ///< the field that is sampled, if it is one
};

/// "water (m3/m3)"; what has no unit stays as it is.
std::string with_unit(const std::string& name, const std::string& unit);

/// The least and the greatest that are numbers; none if none is.
std::optional<std::array<double, 2>> range_of(const std::vector<double>& values);

/// A field between its voxels, linearly; NaN outside.
double sampled(const RecordedField& field, const glm::dvec3& point);

}  // namespace espalier::picture
