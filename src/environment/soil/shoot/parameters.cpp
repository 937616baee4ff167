#include "environment/soil/shoot/parameters.h"

#include "environment/leaf/gas/air.h"
#include "environment/soil/hydraulics/heads.h"

namespace espalier::environment {
namespace {

constexpr double seconds_per_day = 86400;

Vulnerability read_vulnerability(const Settings& table) {
    Vulnerability conduits;
    conduits.head = table.number_or("b", 3, Range::between(0, 100)) * cm_per_megapascal;
    conduits.power = table.number_or("c", 3, Range::between(1, 50));
    return conduits;
}

}  // namespace

std::optional<ShootKind> ShootKind::read(const Settings& settings) {
    if (!settings.has("stem")) {
        if (!settings.has("leaf")) return std::nullopt;
        throw UserError(settings.place("leaf"),
                        "'leaf' says how water enters leaves from stems: say of those, too, as stem = { conductivity "
                        "= 2 }");
    }
    const Settings stem = settings.table("stem"), leaf = settings.table("leaf");
    ShootKind shoot;
    // kg m-1 s-1 MPa-1 over an area is cm3/d for a head of 1 cm over a length of 1 cm.
    const double conductivity = stem.number_or("conductivity", 2, Range::between(1e-6, 1e4));
    shoot.stem_conductivity = conductivity * seconds_per_day * 10 / leaf::water_density / cm_per_megapascal;
    shoot.stem_capacity =
        1e-3 * stem.number_or("capacitance", 0, Range::between(0, 1e4)) / leaf::water_density / cm_per_megapascal;
    shoot.stem = read_vulnerability(stem);
    const double cm_of_mole = 1e3 * leaf::water_molar_mass / leaf::water_density * 1e-4;  // over a square metre
    const double conductance = leaf.number_or("conductance", 8, Range::between(1e-6, 1e6));
    shoot.leaf_conductance = 1e-3 * conductance * cm_of_mole * seconds_per_day / cm_per_megapascal;
    shoot.leaf_capacity = leaf.number_or("capacitance", 0, Range::between(0, 1e4)) * cm_of_mole / cm_per_megapascal;
    shoot.leaf = read_vulnerability(leaf);
    return shoot;
}

}  // namespace espalier::environment
