// The modules that contexts look at, found once for a whole string: whatever branches and ignored modules lie between,
// matching then takes a time proportional to the pattern.
#pragma once

#include "espalier/lsystem/module_string.h"

#include <cstdint>
#include <vector>

namespace espalier::lsystem {

/// One side of contexts: scanning along the string, each module becomes the neighbour of those that follow, or is
/// ignored.
struct ContextSide {
    bool wanted = false;
    bool branches = true;              ///< brackets begin and end branches; else they are modules like others
    std::vector<std::uint16_t> codes;  ///< by letter: its class, or `ignored`

    static constexpr std::uint16_t ignored = 0xFF00;
};

/// What productions ask of a string's neighbours.
struct ContextSides {
    ContextSide left;
    ContextSide right;
    ContextSide next;        ///< to the right, but into branches: for patterns that name `[`
    bool positions = false;  ///< where neighbours stand; else the classes of their letters are enough
    bool ring = false;
    /// No production asks for the right neighbours of brackets or ignored modules: both sides' classes are found in one
    /// scan.
    bool at_once = false;
};

/// What Neighbours takes for each module.
inline std::size_t bytes_of_neighbours(const ContextSides& sides) {
    const std::size_t columns = std::size_t{sides.left.wanted} + sides.right.wanted + sides.next.wanted;
    return columns * (sides.positions ? sizeof(std::uint32_t) : sizeof(std::uint8_t));
}

/// A part of the string that is scanned by itself: neighbours beyond it are filled in when all parts are scanned.
template <class Value>
struct Section {
    std::size_t begin = 0, end = 0;
    std::vector<std::uint32_t> exits;  ///< brackets that end branches begun before this part
    Column<Value> entries;             ///< what is seen before branches that begin here and end after this part
    Value last{};                      ///< what is seen from behind this part
    std::vector<Value> beyond;         ///< what is seen before this part, and before the branch that each exit ends
};

/// Where right neighbours are still to be entered at the end of a part, and what modules before the part see of it.
struct alignas(64) PendingRight {
    /// A branch: the entry of the module before it, and the class of its left neighbours.
    struct Branch {
        std::uint8_t* entry;
        std::uint8_t left;
    };
    Column<Branch> branches;        ///< branches begun in the part and not ended
    std::uint8_t* entry = nullptr;  ///< entry of the last module of the part
    std::vector<std::uint8_t>
        firsts;                  ///< right neighbours of modules before the part, and before branches that exits end
    std::uint8_t first = 0;      ///< entry of a module before the part
    std::uint8_t no_module = 0;  ///< entry where no module stands
};

/// Neighbours of the modules of one string, in the columns that are asked for; memory is reused.
class Neighbours {
public:
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    /// So many modules are scanned by one thread before another may have its turn.
    explicit Neighbours(std::size_t modules = 8192) : grain_(modules) {}

    void find(const ContextSides& sides, const ModuleString& string);

    // Positions, or `none`.
    Column<std::uint32_t> left, right, next;
    // Classes; 0 stands for no neighbour and for letters that no context names.
    Column<std::uint8_t> left_classes, right_classes;

private:
    void find_both(const ContextSides& sides, const ModuleString& string);
    void join_pending();

    std::size_t grain_;
    std::vector<Section<std::uint32_t>> positions_;
    std::vector<Section<std::uint8_t>> classes_;
    std::vector<PendingRight> pending_;
};

/// Where the parameters of each module begin, in half the memory that plain offsets take.
class ParameterPlaces {
public:
    /// Returns how many parameters all modules have.
    std::size_t find(const ModuleString& string, const std::uint16_t* arities);

    std::size_t operator[](std::size_t module) const { return bases_[module / grain] + within_[module]; }

private:
    static constexpr std::size_t grain = 8192;

    std::vector<std::size_t> bases_;
    Column<std::uint32_t> within_;
};

}  // namespace espalier::lsystem
