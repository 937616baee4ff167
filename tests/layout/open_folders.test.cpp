// A file in an open folder is all a new part needs: what lies there and what is registered must be the same.
#include "espalier/environment/environment_process.h"
#include "espalier/formats/exporter.h"
#include "espalier/language/notation.h"
#include "espalier/turtle/geometry_stage.h"

#include "catch.h"
#include "sources.h"

#include <set>

namespace {

using namespace layout;

// "voxel_shade.cpp" registers "voxel-shade".
std::string part_name(const fs::path& file) {
    std::string name = file.stem().string();
    std::replace(name.begin(), name.end(), '_', '-');
    return name;
}

std::set<std::string> parts_in(const fs::path& folder) {
    std::set<std::string> names;
    for (const fs::path& file : sources_below(folder)) {
        if (file.extension() == ".cpp" && file.parent_path() == folder) names.insert(part_name(file));
    }
    return names;
}

template <class Kind>
std::set<std::string> names_of() {
    std::set<std::string> names;
    for (const auto& part : espalier::registered<Kind>()) names.insert(part.first);
    return names;
}

}  // namespace

TEST_CASE("every file of a subject of the environment registers the process it is named after", "[layout]") {
    std::set<std::string> parts;
    for (const char* subject : {"given", "leaf", "light", "soil", "space"}) {
        const std::set<std::string> of_subject = parts_in(fs::path("src/environment") / subject);
        CHECK(!of_subject.empty());
        parts.insert(of_subject.begin(), of_subject.end());
    }
    CHECK(parts == names_of<espalier::ProcessType>());
}

TEST_CASE("every process explains itself", "[layout]") {
    for (const auto& [name, process] : espalier::registered<espalier::ProcessType>()) {
        INFO(name);
        CHECK(!process->summary.empty());
        CHECK(!process->help.empty());
    }
}

TEST_CASE("every file of turtle/stages registers the geometry stage it is named after and explains it", "[layout]") {
    CHECK(!parts_in("src/turtle/stages").empty());
    CHECK(parts_in("src/turtle/stages") == names_of<espalier::GeometryStageType>());
    for (const auto& [name, stage] : espalier::registered<espalier::GeometryStageType>()) {
        INFO(name);
        CHECK(!stage->summary.empty());
        CHECK(!stage->help.empty());
    }
}

TEST_CASE("every file of language/notations registers the notation it is named after and explains it", "[layout]") {
    CHECK(parts_in("src/language/notations") == names_of<espalier::NotationType>());
    for (const auto& [name, notation] : espalier::registered<espalier::NotationType>()) {
        INFO(name);
        CHECK(notation->extension.starts_with("."));
        CHECK(!notation->summary.empty());
        CHECK(!notation->help.empty());
    }
}

TEST_CASE("every file of formats/exporters registers the format it is named after", "[layout]") {
    CHECK(!parts_in("src/formats/exporters").empty());
    CHECK(parts_in("src/formats/exporters") == names_of<espalier::ExporterType>());
}

TEST_CASE("every exporter says what it carries and what is lost", "[layout]") {
    for (const auto& [name, exporter] : espalier::registered<espalier::ExporterType>()) {
        INFO(name);
        CHECK(!exporter->summary.empty());
        CHECK(!exporter->help.empty());
    }
}
