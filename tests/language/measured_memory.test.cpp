// What it takes to read a large measured plant: memory above what the program had before.
#include "base/platform.h"
#include "catch.h"
#include "language/large_plant.h"
#include "language/measured_file.h"
#include "temporary_folder.h"

#include <fstream>

using namespace espalier;

namespace {

/// Of the process, whose tests before have left no free memory if this one runs alone, as those of CTest do.
std::size_t bytes_of_a_node(const char* name, large_plant::Write write) {
    const TemporaryFolder folder;
    write(std::ofstream(folder.path() / name));
    const std::size_t before = platform::peak_memory();
    const MeasuredSummary summary = summary_of(read_measured_plants(folder.path() / name));
    CHECK(summary.axes == large_plant::branches + 1);
    CHECK(summary.link_length == Approx(0).margin(1e-4));
    return (platform::peak_memory() - before) / large_plant::nodes;
}

}  // namespace

// AddressSanitizer keeps what is freed.
#ifndef __SANITIZE_ADDRESS__
TEST_CASE("a measured plant of 100,000 nodes is read in 200 bytes a node", "[rsml]") {
    CHECK(bytes_of_a_node("plant.rsml", large_plant::write_rsml) <= 200);
}

TEST_CASE("a multiscale tree graph of 100,000 nodes is read in 200 bytes a node", "[mtg]") {
    CHECK(bytes_of_a_node("plant.mtg", large_plant::write_mtg) <= 200);
}

TEST_CASE("a tree of 100,000 cylinders is read in 200 bytes a cylinder", "[cylinders]") {
    CHECK(bytes_of_a_node("plant.csv", large_plant::write_cylinders) <= 200);
}
#endif
