#include "environment/soil/roots/conductances.h"

#include <algorithm>

namespace espalier::environment {

double RootCurve::operator()(double x) const {
    const auto after = std::upper_bound(at.begin(), at.end(), x);
    if (after == at.begin()) return values.front();
    const auto i = static_cast<std::size_t>(after - at.begin());
    if (i == at.size()) return values.back();
    return values[i - 1] + (values[i] - values[i - 1]) * (x - at[i - 1]) / (at[i] - at[i - 1]);
}

RootCurve RootCurve::read(const Settings& settings, const std::string& key, const RootCurve* fallback) {
    if (fallback && !settings.has(key)) return *fallback;
    if (!settings.is_table(key)) return {{0}, {settings.number(key, Range::between(0, 1e9))}};
    const Settings table = settings.table(key);
    RootCurve curve{table.numbers("at"), table.numbers("values")};
    if (curve.at.empty() || curve.at.size() != curve.values.size()) {
        throw UserError(table.place("at"), "a curve needs as many numbers in 'at' as in 'values'");
    }
    if (!std::is_sorted(curve.at.begin(), curve.at.end(), std::less_equal<>())) {
        throw UserError(table.place("at"), "the numbers of 'at' must rise");
    }
    for (const double value : curve.values) {
        if (!(value >= 0 && value <= 1e9)) throw UserError(table.place("values"), "a conductance is from 0 to 1e9");
    }
    return curve;
}

std::vector<RootConductances> read_root_conductances(const Settings& settings) {
    std::vector<RootConductances> orders;
    const std::vector<Settings> tables = settings.tables("orders");
    if (tables.empty() || settings.has("radial")) {
        orders.push_back({RootCurve::read(settings, "radial", nullptr), RootCurve::read(settings, "axial", nullptr)});
    }
    std::vector<RootConductances> by_order;
    for (const Settings& table : tables) {
        const RootConductances* common = orders.empty() ? nullptr : &orders[0];
        by_order.push_back({RootCurve::read(table, "radial", common ? &common->radial : nullptr),
                            RootCurve::read(table, "axial", common ? &common->axial : nullptr)});
    }
    orders = by_order.empty() ? orders : by_order;
    for (const RootConductances& order : orders) {
        for (const double value : order.axial.values) {
            if (!(value > 0))
                throw UserError(settings.place("axial"), "'axial' must be more than 0: roots conduct along");
        }
    }
    return orders;
}

}  // namespace espalier::environment
