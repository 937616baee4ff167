// The tables of four instruments: what each row says, in one set of units.
#include "environment/leaf/measured/leaf_records.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "environment/leaf/measured/leaf_files.h"
#include "temporary_folder.h"

using namespace espalier;
using namespace espalier::environment::leaf;
using Catch::Contains;

namespace {

LeafRecords read(const std::string& text) {
    const TemporaryFolder folder;
    return read_leaf_records(folder.write("leaf.txt", text));
}

std::string refusal(const std::string& text) {
    try {
        read(text);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

void check_rows(const LeafRecords& found, const std::vector<leaf_files::Row>& rows) {
    REQUIRE(found.rows.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        INFO(found.instrument << ", row " << i);
        const LeafRecord& is = found.rows[i];
        CHECK(is.assimilation == Approx(rows[i].a).epsilon(1e-5));
        CHECK(is.conductance == Approx(rows[i].gs).epsilon(1e-5));
        CHECK(is.transpiration == Approx(rows[i].e).epsilon(1e-5));
        CHECK(is.internal == Approx(rows[i].ci).epsilon(1e-5));
        CHECK(is.incident == Approx(rows[i].incident));
        CHECK(is.temperature == Approx(rows[i].temperature));
        CHECK(is.deficit == Approx(rows[i].deficit).epsilon(1e-5));
        CHECK(is.pressure == Approx(rows[i].pressure));
        CHECK(is.carbon_dioxide == Approx(rows[i].ca).epsilon(1e-5));
    }
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    return text.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("the tables of four instruments say the same of one leaf", "[leaf][measured]") {
    const std::vector<leaf_files::Row> rows = leaf_files::measured({});
    const LeafRecords li6400 = read(leaf_files::li6400(rows)), li6800 = read(leaf_files::li6800(rows)),
                      gfs = read(leaf_files::gfs3000(rows)), ciras = read(leaf_files::ciras4(rows));
    CHECK(li6400.instrument == "LI-6400");
    CHECK(li6800.instrument == "LI-6800");
    CHECK(gfs.instrument == "GFS-3000");
    CHECK(ciras.instrument == "CIRAS-4");
    for (const LeafRecords* found : {&li6400, &li6800, &gfs, &ciras}) {
        check_rows(*found, rows);
        CHECK(found->left_out == 0);
    }
    CHECK(li6800.rows[2].absorbed == Approx(rows[2].absorbed));
    CHECK(std::isnan(gfs.rows[2].absorbed));
    CHECK(li6400.rows[3].line == 10);  // behind a remark
}

TEST_CASE("units that a file writes count instead of the instrument's own", "[leaf][measured]") {
    const std::vector<leaf_files::Row> rows = leaf_files::measured({});
    check_rows(read(leaf_files::ciras4(rows, "gs (mol m-2 s-1)", 1)), rows);
    std::string pascal = leaf_files::gfs3000(rows);
    pascal = with(pascal, ";Pa/kPa;", ";mmol/mol;");
    check_rows(read(pascal), rows);
    std::string kelvin = leaf_files::ciras4(rows);
    kelvin = with(kelvin, "Tleaf", "Tleaf (K)");
    for (const char* celsius : {" 26,", " 24.5,"}) {
        for (std::size_t at = kelvin.find(celsius); at != std::string::npos; at = kelvin.find(celsius, at + 3)) {
            kelvin.replace(at, std::string(celsius).size(),
                           *celsius == ' ' && celsius[2] == '6' ? " 299.15," : " 297.65,");
        }
    }
    check_rows(read(kelvin), rows);
}

TEST_CASE("a table of a leaf that cannot be right is refused with one clear line", "[leaf][measured]") {
    const std::vector<leaf_files::Row> rows = leaf_files::measured({});
    CHECK_THAT(refusal("a,b\n1,2\n"), Contains("names the columns of an instrument") && Contains("GFS-3000 (A, GH2O"));
    CHECK_THAT(refusal(""), Contains("names the columns"));
    CHECK_THAT(refusal(with(leaf_files::li6400(rows), "\"PARi\"", "\"PARo\"")),
               Contains(":5: ") && Contains("no column 'PARi'"));
    CHECK_THAT(refusal(with(leaf_files::gfs3000(rows), ";Pa/kPa;", ";bar;")),
               Contains(":1:8: ") && Contains("'VPD' has the unit 'bar': write one of Pa/kPa"));
    // Conductance in mol under a name whose unit is mmol.
    CHECK_THAT(refusal(leaf_files::ciras4(rows, "gs", 1)),
               Contains("gs (mmol)") && Contains("do not belong together") && Contains("behind the name"));
    const std::string header = leaf_files::ciras4({});
    CHECK_THAT(refusal(header + "1, 01/07/2023, 08:00:00, 420, 400, 992, 1800, 999.9, 200, 300, 1, 20, 5\n"),
               Contains("no measurement with all of A, Ci, Tleaf, PARi, Patm: in line 2 'Tleaf' is '999.9'"));
    CHECK_THAT(refusal(header), Contains("has no measurement"));
}

TEST_CASE("rows that lack what is needed are left out and counted", "[leaf][measured]") {
    const std::vector<leaf_files::Row> rows = leaf_files::measured({});
    const std::string text = leaf_files::ciras4(rows);
    const LeafRecords found =
        read(text + "1, 01/07/2023, 09:00:00, 420, 400, 992, , 25, 200, 300, 1, 20, 5\n1, 01/07\n");
    CHECK(found.rows.size() == rows.size());
    CHECK(found.left_out == 1);
    CHECK_THAT(found.why, Contains("'PARi' is ''"));
    // No sensor of conductance: the row still tells photosynthesis.
    const LeafRecords dry = read(text + "1, 01/07/2023, 09:00:00, 420, 400, 992, 900, 25, 200, , , 20, \n");
    CHECK(dry.rows.size() == rows.size() + 1);
    CHECK(std::isnan(dry.rows.back().conductance));
}
