#include "espalier/base/column.h"

#include "catch.h"

#include <cstdint>
#include <numeric>

using namespace espalier;

TEST_CASE("a column keeps its values when it grows into huge pages and back", "[base]") {
    Column<std::uint32_t> column;
    const std::size_t huge = huge_allocation / sizeof(std::uint32_t);
    for (const std::size_t size : {std::size_t{1000}, huge - 1, huge, 3 * huge + 17}) {
        const std::size_t before = column.size();
        column.resize(size);
        std::iota(column.begin() + static_cast<std::ptrdiff_t>(before), column.end(),
                  static_cast<std::uint32_t>(before));
    }
    column.resize(500);
    column.shrink_to_fit();
    std::uint32_t wrong = 0;
    for (std::uint32_t k = 0; k < column.size(); ++k) wrong += column[k] != k;
    CHECK(wrong == 0);
    CHECK(column.capacity() < huge);
}

TEST_CASE("a column too large for any memory is refused", "[base]") {
    Column<double> column;
    CHECK_THROWS(column.reserve(column.max_size()));
}
