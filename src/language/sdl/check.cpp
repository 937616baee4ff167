#include "base/text.h"
#include "language/sdl/parser.h"
#include "language/sdl/translation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace espalier::language::sdl {
namespace {

class Check {
public:
    Check(const Skeleton& skeleton, Mistakes& mistakes) : skeleton_(skeleton), mistakes_(mistakes) {
        for (const Component& component : skeleton.components) names_.push_back(component.name);
    }

    void components() {
        std::map<std::string, int> lines;
        for (const Component& component : skeleton_.components) {
            const auto [first, is_new] = lines.emplace(component.name, component.at.line);
            if (!is_new) {
                mistakes_.error(component.at,
                                fmt::format("component '{}' is defined a second time; the first one is in line {}",
                                            component.name, first->second));
            }
            beginning(component);
        }
    }

    void rules() {
        std::set<std::string> seen;
        for (const Rule& rule : skeleton_.rules) {
            require_known(rule.master, rule.at);
            if (!seen.insert(rule.master).second) {
                mistakes_.error(rule.at, fmt::format("'{0}' has a rule already; write several right sides as "
                                                     "{0} -> (...) | (...);",
                                                     rule.master));
            }
            weights(rule);
            for (const RightSide& side : rule.right_sides) slaves(side.slaves);
        }
    }

    void fibres() {
        std::map<std::string, int> lines;
        for (const Fibre& fibre : skeleton_.fibres) {
            for (const std::string& name : fibre.components) require_known(name, fibre.at);
            const std::vector<std::string> all_others{""};
            for (const std::string& name : fibre.components.empty() ? all_others : fibre.components) {
                const auto [first, is_new] = lines.emplace(name, fibre.at.line);
                if (is_new) continue;
                mistakes_.error(fibre.at,
                                name.empty()
                                    ? fmt::format("the fibres of all other components are set already, in "
                                                  "line {}; name the components that these belong to",
                                                  first->second)
                                    : fmt::format("'{}' has fibres already, set in line {}", name, first->second));
            }
        }
    }

    /// Slaves of a NULL component move along the fibre of its master.
    void contours() {
        for (const Component& component : skeleton_.components) {
            if (!component.is_null) continue;
            std::set<std::vector<double>> bends;
            for (const Fibre* fibre : bearers(skeleton_, component.name)) {
                bends.insert(fibre ? fibre->contour : std::vector<double>{});
            }
            if (bends.size() <= 1) continue;
            mistakes_.error(component.at,
                            fmt::format("the masters of '{}' have fibres with different contours, so its "
                                        "slaves would not know where to begin; give each of these masters "
                                        "a NULL component of its own",
                                        component.name));
        }
    }

private:
    /// A place on the master is from 0, its beginning, to 1, its end.
    void beginning(const Component& component) {
        const Attribute& place = component.features[Component::beginning];
        if (component.is_null || !place.middle.number) return;
        const double middle = *place.middle.number;
        const double deviation = place.deviation ? place.deviation->number.value_or(0) : 0;
        constexpr double rounding = 1e-12;
        if (middle - deviation >= -rounding && middle + deviation <= 1 + rounding) return;
        const std::string low = format_general(middle - deviation), high = format_general(middle + deviation);
        mistakes_.error(
            place.at, fmt::format("'{}' begins {} of its master; a place on the master is from 0 to 1", component.name,
                                  deviation == 0 ? "at " + low : fmt::format("between {} and {}", low, high)));
    }

    void weights(const Rule& rule) {
        const bool can_be_chosen = std::any_of(rule.right_sides.begin(), rule.right_sides.end(), [](const auto& side) {
            return !side.weight || side.weight->number != 0.0;
        });
        if (can_be_chosen) return;
        mistakes_.error(rule.at, fmt::format("all right sides of '{0}' have the weight 0, so none can be chosen; write "
                                             "{0} -> (); for a component without slaves",
                                             rule.master));
    }

    void slaves(const std::vector<Slave>& list) {
        for (const Slave& slave : list) {
            require_known(slave.component, slave.at);
            slaves(slave.slaves);
        }
    }

    void require_known(const std::string& name, Location at) {
        if (skeleton_.component(name)) return;
        mistakes_.error(at, fmt::format("component '{}' is not defined{}", name, did_you_mean(name, names_)));
    }

    const Skeleton& skeleton_;
    Mistakes& mistakes_;
    std::vector<std::string> names_;
};

}  // namespace

void check(const Skeleton& skeleton, Mistakes& mistakes) {
    Check check(skeleton, mistakes);
    check.components();
    check.rules();
    check.fibres();
    check.contours();
}

}  // namespace espalier::language::sdl
