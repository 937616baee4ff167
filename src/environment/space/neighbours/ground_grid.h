// The ground as cells, and how many discs lie over each.
#pragma once

#include "base/picture_file.h"
#include "environment/exchange/parameter_file.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <vector>

namespace espalier::environment {

class GroundGrid {
public:
    enum class Rule {
        centres,  ///< discs cover the cells whose centres they contain, and a cell has the pixel over its centre
        touched,  ///< discs cover the cells that they touch by more than 0.03 of their width; corner cells have the
                  ///< corner pixels; counts end at 255
    };

    /// Reads `grid size`, `grid position`, `grid range` and `input image`. Throws UserError if the grid is larger than
    /// memory allows.
    GroundGrid(ParameterFile& file, const EnvironmentContext& context, Rule rule = Rule::centres);

    /// The cell over a place; nothing beside the grid.
    std::optional<std::size_t> cell(const glm::dvec2& place) const;
    /// Taking away more than there is leaves 0.
    void add_disc(const glm::dvec2& centre, double radius);
    void remove_disc(const glm::dvec2& centre, double radius);
    /// How far from its centre a disc may be counted: as far as the cells reach that it covers.
    glm::dvec2 reach(double radius) const;
    void clear() { counts_.assign(counts_.size(), 0); }

    std::size_t bytes() const { return counts_.size() * sizeof(std::uint32_t); }
    bool has_picture() const { return !image_.empty(); }
    std::uint32_t count(std::size_t cell) const { return counts_[cell]; }
    /// Returns the colour of the image over the cell; white if there is none.
    Picture::Colour colour(std::size_t cell) const;

    void save(std::ostream& out) const;
    void restore(std::istream& in);

private:
    template <class Change>
    void visit_disc(const glm::dvec2& centre, double radius, const Change& change);
    double distance(int axis, std::int64_t index, double place) const;

    Rule rule_;
    std::int64_t size_[2];
    glm::dvec2 lower_, range_;
    Picture image_;
    std::vector<std::uint32_t> counts_;
};

}  // namespace espalier::environment
