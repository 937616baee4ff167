#include "language/measured/parts_tree.h"

#include <fmt/format.h>

#include <numeric>
#include <unordered_map>

namespace espalier::language::measured {
namespace {

constexpr std::uint32_t nobody = PartAxis::none;

/// What each part bears, in the order of the file, in one array.
class Borne {
public:
    explicit Borne(const std::vector<std::uint32_t>& bearers) : first_(bearers.size() + 2), parts_(bearers.size()) {
        for (const std::uint32_t bearer : bearers) ++first_[row(bearer) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t part = 0; part < bearers.size(); ++part) parts_[next[row(bearers[part])]++] = part;
    }

    /// By a part, or by none.
    void by(std::uint32_t bearer, std::vector<std::uint32_t>& borne) const {
        const std::size_t at = row(bearer);
        borne.assign(parts_.begin() + first_[at], parts_.begin() + first_[at + 1]);
    }

private:
    std::size_t row(std::uint32_t bearer) const { return bearer == nobody ? parts_.size() : bearer; }

    std::vector<std::uint32_t> first_, parts_;
};

}  // namespace

std::vector<std::uint32_t> bearers_of(const std::vector<NamedPart>& parts,
                                      const std::function<bool(std::int32_t parent)>& is_root,
                                      const std::string& file) {
    std::unordered_map<std::int32_t, std::uint32_t> number_of;
    number_of.reserve(parts.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const auto [found, is_new] = number_of.try_emplace(parts[i].id, i);
        if (is_new) continue;
        throw UserError(Place{file, parts[i].line, 1},
                        fmt::format("the number {} stands on line {}, too", parts[i].id, parts[found->second].line));
    }
    std::vector<std::uint32_t> bearers(parts.size(), nobody);
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
        const auto found = number_of.find(parts[i].parent);
        if (found != number_of.end()) {
            bearers[i] = found->second;
        } else if (!is_root(parts[i].parent)) {
            throw UserError(
                Place{file, parts[i].line, 1},
                fmt::format("there is no number {}, which {} names as its parent", parts[i].parent, parts[i].id));
        }
    }
    return bearers;
}

std::vector<std::uint32_t> bearers_first(const std::vector<NamedPart>& parts, const std::vector<std::uint32_t>& bearers,
                                         const std::string& file) {
    const Borne all(bearers);
    std::vector<std::uint32_t> order, borne;
    order.reserve(parts.size());
    all.by(nobody, order);
    for (std::size_t i = 0; i < order.size(); ++i) {
        all.by(order[i], borne);
        order.insert(order.end(), borne.begin(), borne.end());
    }
    if (order.size() == parts.size()) return order;
    std::vector<bool> is_reached(parts.size());
    for (const std::uint32_t part : order) is_reached[part] = true;
    std::uint32_t part = 0;
    while (is_reached[part]) ++part;
    throw UserError(Place{file, parts[part].line, 1},
                    fmt::format("the parents of {} lead round in a ring, and never to the ground", parts[part].id));
}

std::vector<PartAxis> axes_of_parts(
    const std::vector<NamedPart>& parts, const std::function<bool(std::int32_t parent)>& is_root,
    const std::function<std::size_t(std::uint32_t part, const std::vector<std::uint32_t>& borne)>& next,
    const std::string& file) {
    const std::vector<std::uint32_t> bearers = bearers_of(parts, is_root, file);
    bearers_first(parts, bearers, file);
    const Borne all(bearers);
    std::vector<std::uint32_t> borne;
    std::vector<PartAxis> axes;
    all.by(nobody, borne);
    for (const std::uint32_t root : borne) axes.push_back({nobody, nobody, {root}});
    for (std::uint32_t axis = 0; axis < axes.size(); ++axis) {
        for (std::size_t i = 0; i < axes[axis].parts.size(); ++i) {
            const std::uint32_t part = axes[axis].parts[i];
            all.by(part, borne);
            const std::size_t chosen = next(part, borne);
            for (std::size_t k = 0; k < borne.size(); ++k) {
                if (k != chosen) axes.push_back({axis, part, {borne[k]}});
            }
            if (chosen < borne.size()) axes[axis].parts.push_back(borne[chosen]);
        }
    }
    return axes;
}

LooseAxis& begin_axis(const PartAxis& axis, Place place, std::vector<LooseAxis>& axes, MeasuredPlants& plants) {
    LooseAxis& begun = axes.emplace_back();
    begun.place = std::move(place);
    if (axis.bearer == PartAxis::none) {
        begun.plant = plants.plants.size();
        plants.plants.push_back({});
    } else {
        begun.bearer = axis.bearer;
        begun.plant = axes[axis.bearer].plant;
    }
    return begun;
}

}  // namespace espalier::language::measured
