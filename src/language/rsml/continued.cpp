#include "language/rsml/continued.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace espalier::language::rsml {
namespace {

std::optional<double> property_of(const RawRoot& root, Quantity quantity) {
    for (const RawProperty& property : root.properties) {
        if (property.term.quantity == quantity) return property.value;
    }
    return std::nullopt;
}

/// One for each point; NaN where there are none.
void pad(std::vector<double>& samples, std::size_t points) {
    samples.resize(points, std::numeric_limits<double>::quiet_NaN());
}

void append_functions(RawRoot& root, const RawRoot& piece, std::size_t before, measured::Notes& notes) {
    for (const RawFunction& further : piece.functions) {
        auto known = std::find_if(root.functions.begin(), root.functions.end(),
                                  [&](const RawFunction& each) { return each.name == further.name; });
        if (known == root.functions.end()) {
            root.functions.push_back(further);
            known = std::prev(root.functions.end());
            known->samples.clear();
        }
        if (known->domain != Domain::polyline || further.domain != Domain::polyline) {
            notes.unused("a function along the length of a root that continues another", further.place);
            continue;
        }
        pad(known->samples, before);
        known->samples.insert(known->samples.end(), further.samples.begin(), further.samples.end());
    }
    for (RawFunction& function : root.functions) {
        if (function.domain == Domain::polyline) pad(function.samples, root.points.size());
    }
}

void append(RawRoot& root, const RawRoot& piece, measured::Notes& notes) {
    const std::size_t before = root.points.size();
    if (before > 0 && !piece.points.empty()) root.breaks.push_back(before);
    for (const std::size_t at : piece.breaks) root.breaks.push_back(before + at);
    root.points.insert(root.points.end(), piece.points.begin(), piece.points.end());
    append_functions(root, piece, before, notes);
    for (RawProperty& property : root.properties) {
        if (property.term.quantity == Quantity::length)
            property.value += property_of(piece, Quantity::length).value_or(0);
    }
}

/// Where the pieces of roots are now.
struct Piece {
    std::size_t root;        ///< that it is a piece of
    std::size_t before = 0;  ///< so many points of that come before its own
};

void hang_on_whole(RawRoot& lateral, const std::vector<Piece>& pieces) {
    if (!lateral.axis.bearer) return;
    const Piece& bearer = pieces[*lateral.axis.bearer];
    lateral.axis.bearer = bearer.root;
    for (RawProperty& property : lateral.properties) {
        if (property.term.quantity == Quantity::parent_node) property.value += static_cast<double>(bearer.before);
    }
}

}  // namespace

void join_continued(RawFile& file, const std::map<double, std::size_t>& root_of_id, measured::Notes& notes) {
    std::vector<Piece> pieces;
    std::vector<std::size_t> place;  // of roots among those that are left
    std::vector<RawRoot> whole;
    for (RawRoot& root : file.roots) {
        const std::size_t number = pieces.size();
        place.push_back(whole.size());
        pieces.push_back({number});
        if (const std::optional<double> id = property_of(root, Quantity::continues)) {
            const auto found = root_of_id.find(*id);
            if (found != root_of_id.end() && found->second < number) {
                const std::size_t before = pieces[found->second].root;
                pieces.back() = {before, whole[place[before]].points.size()};
                append(whole[place[before]], root, notes);
                continue;
            }
            notes.warn("a root continues none that stands before it: it is one of its own", root.axis.place);
        }
        hang_on_whole(root, pieces);
        if (root.axis.bearer) root.axis.bearer = place[*root.axis.bearer];
        whole.push_back(std::move(root));
    }
    file.roots = std::move(whole);
}

}  // namespace espalier::language::rsml
