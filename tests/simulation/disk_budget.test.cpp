#include "simulation/run/disk_budget.h"

#include "catch.h"
#include "temporary_folder.h"

#include <string>

using espalier::simulation::DiskBudget;

TEST_CASE("the disk is looked at the 1st, 2nd, 4th ... time, however soon that is", "[simulation]") {
    const TemporaryFolder folder;
    folder.write("there before", std::string(5000, 'x'));
    DiskBudget budget(folder.path(), 100, /*resumed=*/false);
    CHECK_FALSE(budget.is_spent());
    folder.write("a", std::string(100, 'x'));
    CHECK_FALSE(budget.is_spent());
    CHECK(budget.written() == 100);
    budget.is_spent();  // may look or not
    folder.write("b", "x");
    CHECK(budget.is_spent());
    CHECK(budget.written() == 101);
    CHECK(DiskBudget(folder.path(), 5000, /*resumed=*/true).is_spent());
}
