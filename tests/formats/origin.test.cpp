// Exported files say where 0 of a run lies on the map, where they can.
#include "espalier/language/measured_plants.h"

#include "catch.h"
#include "formats/exporting.h"
#include "temporary_folder.h"

#include <nlohmann/json.hpp>
#include <openvdb/io/File.h>

#include <fstream>

using namespace espalier;

namespace {

/// A file of a run, whose 0 lies on the map if it is asked to.
std::string exported_text(const std::string& format, bool on_map, char up = 'y') {
    const RunFolder folder;
    const HandmadePlant plant = branched_plant();
    Timeline timeline(folder.path, timeline_table(), 0);
    record(timeline, 0, {&plant});
    timeline.finish();
    auto json = nlohmann::ordered_json::parse(run_json);
    if (on_map) json["origin"] = {592700, 250, -5432100.5};
    timeline.write_run(json.dump());
    const RecordedRun run(folder.path);
    const RecordedFrame* const frames[] = {&run.frame(0)};
    std::vector<ExportedFile> files;
    ExportJob job{run, frames, {}, folder.path / "export", [&](const ExportedFile& file) { files.push_back(file); }};
    job.options.up = up;
    export_run(job, std::vector{format});
    return text_of(files.at(0).path);
}

}  // namespace

TEST_CASE("files that can hold it say the origin, in their own axes", "[export][origin]") {
    CHECK_THAT(exported_text("obj", true), Catch::Contains("\n# origin: 592700 250 -5432100.5\n"));
    CHECK_THAT(exported_text("obj", true, 'z'), Catch::Contains("\n# origin: 592700 5432100.5 250\n"));
    CHECK_THAT(exported_text("ply", true), Catch::Contains("\ncomment origin: 592700 250 -5432100.5\n"));
    CHECK_THAT(exported_text("gltf", true), Catch::Contains("\"extras\":{\"origin\":[592700.0,250.0,-5432100.5]}"));
    CHECK_THAT(exported_text("usd", true), Catch::Contains("double3 origin = (592700, 250, -5432100.5)"));
    for (const char* const format : {"obj", "ply", "gltf", "usd", "mtg"}) {
        INFO(format);
        CHECK_THAT(exported_text(format, false), !Catch::Contains("origin"));
    }
}

TEST_CASE("an MTG of a run on a map is read back where it was", "[export][origin]") {
    const TemporaryFolder folder;
    for (const char up : {'y', 'z'}) {
        const auto there = read_measured_plants(folder.write("there.mtg", exported_text("mtg", true, up)));
        const auto here = read_measured_plants(folder.write("here.mtg", exported_text("mtg", false, up)));
        REQUIRE(there.axes.size() == here.axes.size());
        const glm::dvec3 shift = there.axes[0].nodes[0].at - here.axes[0].nodes[0].at;
        CHECK(shift.x == Approx(592700).epsilon(1e-12));
        CHECK(shift.y == Approx(250).epsilon(1e-12));
        CHECK(shift.z == Approx(-5432100.5).epsilon(1e-12));
        CHECK(summary_of(there).length == Approx(summary_of(here).length));
    }
}

TEST_CASE("a field of a run on a map has the origin as metadata of its grid, in its own axes", "[export][origin]") {
    const RecordedFolder recorded;
    const std::filesystem::path record = recorded.folder.path / "run.json";
    auto json = nlohmann::ordered_json::parse(text_of(record));
    json["origin"] = {592700, 250, -5432100.5};
    std::ofstream(record) << json.dump();
    const RecordedRun run(recorded.folder.path);
    const RecordedFrame* const frames[] = {&run.frame(4)};
    for (const char up : {'y', 'z'}) {
        std::vector<ExportedFile> files;
        ExportJob job{
            run, frames, {}, recorded.folder.path / "export", [&](const ExportedFile& file) { files.push_back(file); }};
        job.options.up = up;
        export_run(job, std::vector<std::string>{"vdb"});
        openvdb::io::File file(files.at(0).path.string());
        file.open(false);
        const auto origin = file.readGridMetadata("light")->metaValue<openvdb::Vec3d>("origin");
        CHECK(origin == (up == 'y' ? openvdb::Vec3d(592700, 250, -5432100.5) : openvdb::Vec3d(592700, 5432100.5, 250)));
    }
    CHECK(!Exported("vdb").run.origin());
}
