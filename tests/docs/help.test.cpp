// What parts say of their parameters is what they do: the defaults they use, the values they refuse, the keys they
// read.
#include "espalier/environment/environment_process.h"
#include "espalier/turtle/geometry_stage.h"

#include "base/part_help.h"
#include "catch.h"
#include "page.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <regex>
#include <set>

using namespace espalier;

namespace {

using pages::fs::path;
using Json = nlohmann::json;

/// A part, the table of a scene that makes it, and how it is made.
struct Probe {
    std::string kind, name, help;
    std::string table;  ///< "environment.light"
    path scene;
    std::function<void(Settings& table, const Settings& scene)> make;
};

Settings table_of(const Settings& scene, const std::string& dotted) {
    Settings table = scene;
    std::istringstream in(dotted);
    std::vector<Settings> list;
    for (std::string key; std::getline(in, key, '.');) {
        if (std::isdigit(static_cast<unsigned char>(key[0]))) {
            table = list.at(std::stoul(key));
        } else if (key == "plant" || key == "stage") {
            list = table.tables(key);
        } else {
            table = table.table(key);
        }
    }
    return table;
}

/// The scene on the page of the reference.
path scene_of(const std::string& kind, const std::string& name) {
    for (const pages::Block& block : pages::blocks_of("docs/reference/" + kind + "/" + name + ".md")) {
        for (const std::string& line : block.lines) {
            if (line.starts_with("espalier run ")) return pages::root / line.substr(13, line.find(' ', 13) - 13);
        }
    }
    throw std::runtime_error("no scene shows the part " + name);
}

const ProcessType& process_of(const Settings& table) {
    return *registered<ProcessType>().at(table.text_or("process", ""));
}

/// With what stands before it in the scene, whose fields it may need.
std::unique_ptr<EnvironmentProcess> make_process(const std::string& key, Settings& table, const Settings& scene) {
    EnvironmentContext context{.name = {}, .domain = {}, .seed = 1, .plants = 1};
    const Settings simulation = scene.table("simulation");
    if (simulation.has("domain")) {
        context.domain = Box{simulation.table("domain").vector("lower"), simulation.table("domain").vector("upper")};
    }
    Fields fields;
    std::vector<std::unique_ptr<EnvironmentProcess>> before;
    const Settings environment = scene.table("environment");
    for (const std::string& other : environment.keys()) {
        if (other == key) break;
        if (!environment.is_table(other)) continue;
        Settings earlier = environment.table(other);
        context.name = other;
        before.push_back(process_of(earlier).make(earlier, context, fields));
    }
    context.name = "probed";
    return process_of(table).make(table, context, fields);
}

/// The table that the scene on a process's page has of it.
std::string table_of_process(const std::string& name, const Settings& scene) {
    const Settings environment = scene.table("environment");
    for (const std::string& key : environment.keys()) {
        if (environment.is_table(key) && environment.table(key).text_or("process", "") == name) return key;
    }
    throw std::runtime_error("the scene on the page of " + name + " has no such process");
}

/// What docs/clusters.md says that ranks send each other for each process.
std::map<std::string, Spreading> spreadings_on_page() {
    const std::map<std::string, Spreading> meanings{{"queries whose", Spreading::reach},
                                                    {"nothing", Spreading::reach},
                                                    {"all queries", Spreading::queries},
                                                    {"all plants", Spreading::plants},
                                                    {"these cannot be divided", Spreading::refused}};
    std::map<std::string, Spreading> all;
    for (const std::string& line : pages::lines_of("docs/clusters.md")) {
        const std::size_t second = line.find(" | ");
        if (!line.starts_with("| `") || second == std::string::npos) continue;
        const auto meaning = std::find_if(meanings.begin(), meanings.end(), [&](const auto& known) {
            return line.compare(second + 3, known.first.size(), known.first) == 0;
        });
        REQUIRE(meaning != meanings.end());
        static const std::regex name("`([a-z0-9-]+)`");
        const std::string names = line.substr(0, second);
        for (std::sregex_iterator at(names.begin(), names.end(), name), end; at != end; ++at) {
            all[(*at)[1]] = meaning->second;
        }
    }
    return all;
}

std::vector<Probe> probes() {
    std::vector<Probe> all;
    for (const auto& [name, type] : registered<ProcessType>()) {
        const path scene = scene_of("processes", name);
        const std::string key = table_of_process(name, Settings::read_toml(scene));
        all.push_back({"process", name, type->help, "environment." + key, scene,
                       [key](Settings& table, const Settings& of) { make_process(key, table, of); }});
    }
    for (const auto& [name, type] : registered<GeometryStageType>()) {
        const path scene = scene_of("stages", name);
        const std::vector<Settings> stages = Settings::read_toml(scene).tables("plant").at(0).tables("stage");
        for (std::size_t i = 0; i < stages.size(); ++i) {
            if (stages[i].text_or("stage", "") != name) continue;
            all.push_back({"stage", name, type->help, "plant.0.stage." + std::to_string(i), scene,
                           [type = type](Settings& table, const Settings&) { type->make(table); }});
        }
    }
    return all;
}

/// Makes the part with one value replaced; what it read.
Json made_with(const Probe& probe, const std::string& key = "", const std::string& value = "") {
    Settings scene = Settings::read_toml(probe.scene);
    if (!key.empty()) scene.set(probe.table + "." + key, value);
    Settings table = table_of(scene, probe.table);
    probe.make(table, scene);
    return Json::parse(table.resolved_json());
}

bool refuses(const Probe& probe, const std::string& key, double value) {
    try {
        made_with(probe, key, Json(value).dump());
        return false;
    } catch (const UserError&) {
        return true;
    }
}

/// Numbers just outside of a range as the help writes it; of lists nothing.
std::vector<double> outside(const std::string& range) {
    std::vector<double> numbers;
    std::istringstream items(range);
    for (std::string item; std::getline(items, item, ',');) {
        item = item.substr(item.find_first_not_of(' '));
        const std::size_t to = item.find(" to ");
        const auto above = [](double bound) { return bound + std::max(1.0, std::abs(bound) / 2); };
        if (to != item.npos) {
            const double lowest = std::stod(item);
            numbers.push_back(lowest - std::max(1.0, std::abs(lowest) / 2));
            numbers.push_back(above(std::stod(item.substr(to + 4))));
        } else if (item.starts_with(">= ")) {
            numbers.push_back(std::stod(item.substr(3)) - 1);
        } else if (item.starts_with("> ")) {
            numbers.push_back(std::stod(item.substr(2)));
        } else if (item.starts_with("<= ")) {
            numbers.push_back(above(std::stod(item.substr(3))));
        }
    }
    return numbers;
}

/// Whether the part looks at the number, as its scene is.
bool is_asked_for(const HelpRow& row, const Json& used) {
    const bool is_number = row.fallback.find_first_of("[{\"") == std::string::npos;
    return row.depth == 0 && is_number && (used.contains(row.name) || row.fallback == "none");
}

}  // namespace

TEST_CASE("the page on clusters says of each process how ranks divide it", "[docs]") {
    const std::map<std::string, Spreading> said = spreadings_on_page();
    std::map<std::string, Spreading> done;
    for (const auto& [name, type] : registered<ProcessType>()) {
        const Settings scene = Settings::read_toml(scene_of("processes", name));
        const std::string key = table_of_process(name, scene);
        Settings table = scene.table("environment").table(key);
        done[name] = make_process(key, table, scene)->spreading();
    }
    for (const auto& [name, spreading] : done) {
        INFO(name);
        REQUIRE(said.contains(name));
        CHECK(said.at(name) == spreading);
    }
    CHECK(said.size() == done.size());
}

TEST_CASE("The defaults that parts tell of are those they use", "[docs]") {
    std::size_t compared = 0;
    for (const Probe& probe : probes()) {
        const Json used = made_with(probe);
        const Settings given = table_of(Settings::read_toml(probe.scene), probe.table);
        for (const HelpRow& row : parameters_of(probe.help)) {
            const Json told = Json::parse(row.fallback, nullptr, false);
            if (row.depth > 0 || told.is_discarded() || given.has(row.name) || !used.contains(row.name)) continue;
            INFO(probe.kind << " " << probe.name << ": " << row.name);
            CHECK(used[row.name] == told);
            ++compared;
        }
    }
    CHECK(compared > 80);
}

TEST_CASE("Parts refuse the numbers outside of the ranges that they tell of", "[docs]") {
    std::size_t tried = 0;
    for (const Probe& probe : probes()) {
        const Json used = made_with(probe);
        for (const HelpRow& row : parameters_of(probe.help)) {
            if (!is_asked_for(row, used)) continue;
            for (const double number : outside(row.range)) {
                INFO(probe.kind << " " << probe.name << ": " << row.name << " = " << number);
                CHECK(refuses(probe, row.name, number));
                ++tried;
            }
        }
    }
    CHECK(tried > 100);
}

TEST_CASE("Parts tell of every parameter that they read", "[docs]") {
    for (const Probe& probe : probes()) {
        std::set<std::string> told{"process", "stage", "digits", "turtle", "following_module"};
        for (const HelpRow& row : parameters_of(probe.help)) {
            std::istringstream names(row.name);
            for (std::string name; std::getline(names, name, ',');)
                told.insert(name.substr(name.find_first_not_of(' ')));
        }
        const Json used = made_with(probe);
        for (const auto& [key, value] : used.items()) {
            INFO(probe.kind << " " << probe.name << ": " << key);
            CHECK((told.contains(key) || probe.help.find(key) != std::string::npos));
        }
    }
}

TEST_CASE("A row of a part's help says something when read alone", "[docs]") {
    for (const Probe& probe : probes()) {
        for (const HelpRow& row : parameters_of(probe.help)) {
            INFO(probe.kind << " " << probe.name << ": " << row.name);
            CHECK(row.meaning.size() >= 10);
        }
    }
}
