// Which leaf is of which kind, and what a model says of single leaves.
#pragma once

#include "espalier/environment/environment_process.h"

#include "environment/leaf/gas/settings.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace espalier::environment::leaf {

/// The kinds of a scene: that of its table, and those of its tables `kinds` for some plants and colours.
class LeafKinds {
public:
    LeafKinds(const Settings& settings, std::uint32_t plants);

    std::size_t size() const { return kinds_.size(); }
    const LeafKind& operator[](std::size_t kind) const { return kinds_[kind]; }
    /// Whether kinds are told apart by the colours of leaves.
    bool know_colours() const { return know_colours_; }
    /// The number of the kind: of the last table that means this plant and colour.
    std::uint16_t of(std::uint32_t plant, std::uint16_t colour = 0) const;

private:
    struct Chosen {
        std::vector<bool> plants;            ///< empty: all
        std::vector<std::uint16_t> colours;  ///< empty: all
    };
    std::vector<LeafKind> kinds_;
    std::vector<Chosen> chosen_;  ///< of each kind but the first
    bool know_colours_ = false;
};

/// What a model may say of a leaf, and what is in its place where it says 0.
enum class OwnParameter { v, jmax, rd, g1, width };
inline constexpr std::size_t own_parameters = 5;

struct OwnParameterRange {
    const char *name, *unit;
    Range range;
};
const OwnParameterRange& range_of(OwnParameter parameter);

/// Own parameters of a plant's leaves, column by column; NaN: what the kind has. Empty where none is said.
using OwnParameters = std::array<std::vector<float>, own_parameters>;

/// What the parameters of a query are, in turn.
class QueryForm {
public:
    /// Reads the key `query`.
    QueryForm(const Settings& settings, std::string process);

    std::size_t size() const { return roles_.size(); }
    bool says_something() const { return says_something_; }
    /// The number of the answer (see `answered`) that the parameter is given; none: the model says it.
    int answer(std::size_t parameter) const { return roles_[parameter]; }
    /// Writes what the query says of leaf `row` of `leaves`. Throws RunError for what no leaf has.
    void read(const Query& query, std::size_t leaves, std::size_t row, OwnParameters& own) const;

    static const std::vector<std::string>& answered();

private:
    std::string process_;
    std::vector<int> roles_;  ///< below 0: own parameter -1 - role
    bool says_something_ = false;
};

}  // namespace espalier::environment::leaf
