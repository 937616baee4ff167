// A species as the parts of its translation ask: what differs between species, and how text is put together.
#pragma once

#include "language/weber_penn/species.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

namespace espalier::language::weber_penn {

using Words = std::map<std::string, std::string>;

/// The text with the word for each <name>; words may have names in them.
std::string filled(std::string text, const Words& words);

/// The text with the mark of a place, if there is one.
std::string placed(const std::string& text, const std::optional<Location>& at);

class TranslatedSpecies {
public:
    explicit TranslatedSpecies(const Species& species) : species_(species) {}

    const Species& species() const { return species_; }
    int levels() const { return species_.levels(); }
    double value(const std::string& name, int level = -1) const { return species_.value(name, level); }

    /// Does a parameter have another value than its default?
    bool sets(const std::string& name, int level = -1) const {
        return value(name, level) != species_.standard(name, level);
    }

    bool prunes() const { return species_.prunes(); }
    bool bends_leaves() const { return value("Leaves") != 0 && sets("LeafBend"); }
    bool is_helix(int level) const { return value("CurveV", level) < 0; }
    bool splits(int level) const {
        return value("SegSplits", level) != 0 || (level == 0 && value("BaseSplits", 0) != 0);
    }
    bool has_lobes() const { return value("Lobes") > 0 && value("LobeDepth") > 0; }
    bool has_fans() const { return value("Leaves") < 0; }
    bool is_last(int level) const { return level + 1 == levels(); }
    /// Does a stem of the level bear stems or leaves along it?
    bool bears(int level) const { return is_last(level) ? value("Leaves") > 0 : true; }
    /// Is a segment drawn in pieces, because its radius changes along it?
    bool has_pieces(int level) const { return value("Taper", level) > 1 || (level == 0 && value("Flare") > 0); }

    /// The level whose parameters a level has.
    static int described(int level) { return std::min(level, highest_described_level); }

    /// The words of a level: <n> and <m> its number and that of its children, <c> and <d> those of their parameters,
    /// <stem> and <frame> the parameters of a stem and of a turtle, <ask>, <P> and <at> what pruning asks, <leaf> a new
    /// leaf, <side> the turn of a segment to its side.
    Words words(int level) const;

private:
    const Species& species_;
};

/// The `#define`s of the model's settings.
std::string settings(const TranslatedSpecies& species);

/// The macros of the tree and of every level: functions of a place on a stem.
std::string macros(const TranslatedSpecies& species);

/// The sections of the model for one level.
struct Rules {
    std::string productions, decomposition, drawing;
};
/// A bud becomes a stem that grows, splits and bears children.
void add_growth(const TranslatedSpecies& species, int level, Rules& rules);
/// Segments as internodes.
void add_drawing(const TranslatedSpecies& species, int level, Rules& rules);

/// A leaf of length `size` as polygons: modules that move the turtle around its outline.
std::string leaf_polygons(const Species& species, const std::string& size);

/// The production by which a new leaf turns to the light.
std::string leaf_turns();

}  // namespace espalier::language::weber_penn
