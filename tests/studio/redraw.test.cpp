// What changes only looks is drawn again without being derived, and comes out as if it had grown anew.
#include "espalier/base/file.h"

#include "catch.h"
#include "listening_page.h"
#include "studio/document/written_numbers.h"
#include "studio/growth/growth.h"
#include "temporary_folder.h"

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>

using namespace espalier;
using namespace espalier::studio;

namespace {

namespace fs = std::filesystem;

/// Waits for growths.
class Watcher final : public GrowthListener {
public:
    void started(std::uint32_t, GrowthStart start) override {
        note([&] { last_step = start.last_step; });
    }
    void grown(std::uint32_t, GrownStep step) override {
        note([&] {
            derived = step.derived;
            add(step.statistics);
            is_over = step.is_end;
            newest = step.step;
        });
    }
    void drawn(std::uint32_t, int, std::string rows) override {
        note([&] { add(rows); });
    }
    void printed(std::uint32_t, std::string) override {}
    void asks(std::uint32_t, std::size_t) override {}
    void stopped(std::uint32_t) override {
        note([&] { failed_ = true; });
    }
    void failed(std::uint32_t, std::vector<Diagnostic>) override {
        note([&] { failed_ = true; });
    }

    /// True once all steps are there; false if it failed.
    bool wait() {
        std::unique_lock lock(mutex_);
        changed_.wait_for(lock, std::chrono::seconds(60), [this] { return failed_ || (is_over && steps_ > newest); });
        return !failed_ && is_over && steps_ > newest;
    }

    int last_step = -1, derived = 0, newest = -1;
    bool is_over = false;
    std::string statistics;

private:
    template <class Change>
    void note(const Change& change) {
        const std::lock_guard lock(mutex_);
        change();
        changed_.notify_all();
    }
    // Counts the steps by the rows of the first plant.
    void add(const std::string& rows) {
        statistics += rows;
        const bool is_step = !rows.empty();
        steps_ += is_step;
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    bool failed_ = false;
    int steps_ = 0;
};

/// One growth after the other of one file.
class Grower {
public:
    explicit Grower(fs::path file) : file_(fs::absolute(file).lexically_normal()) {}

    struct Grown {
        Watcher watcher;
        std::unique_ptr<Growth> growth;
        bool is_whole = false;
    };

    std::unique_ptr<Grown> grow(const std::string& text, const Growth* before, int steps, int unseen_to = INT_MAX) {
        auto grown = std::make_unique<Grown>();
        GrowthOrder order;
        order.number = ++number_;
        order.opened = {file_, steps, {}};
        order.unsaved[file_] = text;
        order.scratch = scratch_.path();
        order.read = studio_test::read_as_run;
        if (before) order.before = before->shared_steps();
        order.unseen_to = unseen_to;
        order.looked_at = {steps / 2};
        grown->growth = std::make_unique<Growth>(std::move(order), grown->watcher, workers_);
        grown->is_whole = grown->watcher.wait();
        return grown;
    }

private:
    fs::path file_;
    TemporaryFolder scratch_;
    Workers workers_;
    std::uint32_t number_ = 0;
};

// Without the number of the growth.
std::string picture(const Growth& growth, int step) {
    return growth.steps().packet(step).substr(8);
}

void check_same(const Grower::Grown& a, const Grower::Grown& b) {
    REQUIRE(a.watcher.newest == b.watcher.newest);
    CHECK(a.watcher.statistics == b.watcher.statistics);
    for (int step = 0; step <= a.watcher.newest; ++step) {
        INFO("step " << step);
        CHECK((picture(*a.growth, step) == picture(*b.growth, step)));
        const auto text = [&](const Grower::Grown& grown) {
            std::string all;
            for (std::size_t i = 0; i < grown.growth->scene()->plants.size(); ++i) {
                all += to_text(grown.growth->steps().string(step, i),
                               source_of(*grown.growth->scene()->plants[i].model).alphabet);
            }
            return all;
        };
        CHECK((text(a) == text(b)));
    }
}

// Another value that the setting may have.
std::string other_value(const WrittenNumber& number) {
    if (number.is_switch) return number.text == "true" ? "false" : "true";
    const double step = number.whole ? 1 : number.value == 0 ? 0.1 : number.value * 0.1;
    double value = number.value + step;
    if (value > number.highest) value = number.value - step;
    if (value < number.lowest) return "";
    return number.whole ? std::to_string(static_cast<long long>(value)) : std::to_string(value);
}

std::vector<fs::path> library() {
    std::vector<fs::path> files;
    for (const char* folder : {"models", "environments"}) {
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(ESPALIER_SOURCE_DIR) / folder)) {
            const std::string kind = entry.path().extension().string();
            const bool is_model = kind == ".l" || kind == ".species" || kind == ".pgraph" || kind == ".sdl";
            if (entry.is_regular_file() && (is_model || kind == ".toml")) files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

const char* const redrawn_tree = R"(#define ANGLE 30
#define RATIO 0.9
#define COLOUR 3
lsystem: 1
derivation length: 6
axiom: A(1)
A(l) --> F(l) [ +(ANGLE) ;(COLOUR) A(l*RATIO) ] [ -(ANGLE) A(l*RATIO) ] ~L
homomorphism
~L --> @o(0.1)
endlsystem
)";

std::string with(std::string text, const std::string& what, const std::string& instead) {
    return text.replace(text.find(what), what.size(), instead);
}

}  // namespace

TEST_CASE("a growth lets go of the steps of the one before it", "[studio]") {
    const TemporaryFolder folder;
    Grower grower(folder.write("tree.l", redrawn_tree));
    auto first = grower.grow(redrawn_tree, nullptr, 6);
    const std::weak_ptr<const KeptSteps> steps = first->growth->shared_steps();
    const auto second = grower.grow(with(redrawn_tree, "ANGLE 30", "ANGLE 45"), first->growth.get(), 6);
    REQUIRE(second->is_whole);
    CHECK_FALSE(steps.expired());
    first.reset();
    CHECK(steps.expired());
}

TEST_CASE("angles, colours and pictures of modules change without a step of derivation", "[studio]") {
    const TemporaryFolder folder;
    Grower grower(folder.write("tree.l", redrawn_tree));
    const auto first = grower.grow(redrawn_tree, nullptr, 6, 0);
    REQUIRE(first->is_whole);
    CHECK(first->watcher.derived == 7);
    for (const std::string& text :
         {with(redrawn_tree, "ANGLE 30", "ANGLE 45.5"), with(redrawn_tree, "COLOUR 3", "COLOUR 7"),
          with(redrawn_tree, "@o(0.1)", "@o(0.3)"), with(redrawn_tree, "-(ANGLE)", "-(ANGLE*2)"),
          with(redrawn_tree, "derivation", "/* a remark */ derivation")}) {
        INFO(text);
        const auto redrawn = grower.grow(text, first->growth.get(), 6);
        const auto anew = grower.grow(text, nullptr, 6, 0);
        REQUIRE(redrawn->is_whole);
        CHECK(redrawn->watcher.derived == 0);
        check_same(*redrawn, *anew);
    }
    // What is drawn again can be gone on from, and be drawn again.
    const auto turned = grower.grow(with(redrawn_tree, "ANGLE 30", "ANGLE 60"), first->growth.get(), 6);
    const auto longer = grower.grow(with(redrawn_tree, "ANGLE 30", "ANGLE 80"), turned->growth.get(), 8);
    REQUIRE(longer->is_whole);
    CHECK(longer->watcher.derived == 2);
    check_same(*longer, *grower.grow(with(redrawn_tree, "ANGLE 30", "ANGLE 80"), nullptr, 8, 0));
    const auto back = grower.grow(redrawn_tree, longer->growth.get(), 3);
    CHECK(back->watcher.derived == 0);
    check_same(*back, *grower.grow(redrawn_tree, nullptr, 3, 0));
}

TEST_CASE("contexts that skip the end of a branch are compared", "[studio]") {
    const std::string text = with(redrawn_tree, "A(l) -->", "A(l) > [+=] A(m) --> A(l)\nA(l) -->");
    const TemporaryFolder folder;
    Grower grower(folder.write("tree.l", text));
    const auto first = grower.grow(text, nullptr, 6, 0);
    REQUIRE(first->is_whole);
    CHECK(grower.grow(with(text, "COLOUR 3", "COLOUR 7"), first->growth.get(), 6)->watcher.derived == 0);
    CHECK(grower.grow(with(text, "[+=]", "[+(a)=]"), first->growth.get(), 6)->watcher.derived == 7);
}

TEST_CASE("what derivation reads is derived again", "[studio]") {
    const TemporaryFolder folder;
    Grower grower(folder.write("tree.l", redrawn_tree));
    const auto first = grower.grow(redrawn_tree, nullptr, 6, 0);
    for (const std::string& text : {with(redrawn_tree, "RATIO 0.9", "RATIO 0.8"), with(redrawn_tree, "A(1)", "A(2)"),
                                    with(redrawn_tree, "] ~L", "] ~L ~L"), with(redrawn_tree, "-(ANGLE)", "-(ANGLE*l)"),
                                    with(redrawn_tree, "] ~L", "] ?P(0,0,0) ~L"),
                                    // One constant becomes two: their modules cannot be told apart.
                                    with(with(redrawn_tree, "] ~L", "] +(30) ~L"), "ANGLE 30", "ANGLE 30.5")}) {
        INFO(text);
        const std::string before =
            text.find("+(30)") == std::string::npos ? redrawn_tree : with(redrawn_tree, "] ~L", "] +(30) ~L");
        const auto there = before == redrawn_tree ? nullptr : grower.grow(before, nullptr, 6, 0);
        const auto grown = grower.grow(text, there ? there->growth.get() : first->growth.get(), 6);
        REQUIRE(grown->is_whole);
        CHECK(grown->watcher.derived == 7);
        check_same(*grown, *grower.grow(text, nullptr, 6, 0));
    }
}

// It asks for light, and its stages take settings of the model.
const char* const asking_tree = R"(#define STEM 1   /* length of the stem; 0..9; m */
#define SHARE 0.7
environment light;
lsystem: 1
derivation length: 5
axiom: A(1)?light(1)
A(l) ?light(q) : q > 0.2 --> F(l) [ +(30) A(l * SHARE)?light(1) ] /(90) A(l * SHARE)?light(1)
homomorphism
F(l) --> !(0.05) F(l)
endlsystem
)";

const char* const asking_scene = R"([simulation]
seed = 3
[[plant]]
model = "asking.l"
[[plant.stage]]
stage = "stem"
length = "= STEM"
[[plant.stage]]
stage = "pipe-radii"
exponent = 2
[environment.light]
process = "voxel-shade"
voxel = 0.5
)";

TEST_CASE("what stages draw of plants that ask is drawn again without a step, where no process reads it", "[studio]") {
    const TemporaryFolder folder;
    const fs::path model = folder.write("asking.l", asking_tree);
    Grower grower(folder.write("scene.toml", asking_scene));
    const auto first = grower.grow(asking_scene, nullptr, 5, 0);
    REQUIRE(first->is_whole);
    CHECK(first->watcher.derived == 6);
    const Growth* before = first->growth.get();
    const auto defined = with(asking_scene, "asking.l\"", "asking.l\"\ndefine = { STEM = 3 }");
    std::vector<std::unique_ptr<Grower::Grown>> kept;
    for (const std::string& text :
         {with(asking_scene, "\"= STEM\"", "2"), with(asking_scene, "exponent = 2", "exponent = 3"), defined,
          with(asking_scene, "[[plant.stage]]", "[[plant.stage]]\nwhen = false"),
          with(asking_scene, "[environment.light]", "# a remark\n[environment.light]")}) {
        INFO(text);
        kept.push_back(grower.grow(text, before, 5));
        const auto anew = grower.grow(text, nullptr, 5, 0);
        REQUIRE(kept.back()->is_whole);
        CHECK(kept.back()->watcher.derived == 0);
        check_same(*kept.back(), *anew);
        for (int step = 0; step <= 5; ++step) {
            const auto field = [&](const Growth& growth) { return growth.field(step, "light").substr(8); };
            CHECK((field(*kept.back()->growth) == field(*anew->growth)));
        }
        before = kept.back()->growth.get();  // the next is drawn from what was drawn again
    }
    // The stem moved what is drawn by one vector.
    const auto height = [](const Grower::Grown& grown) {
        const std::string rows = grown.watcher.statistics.substr(grown.watcher.statistics.rfind("\n5,"));
        std::vector<std::string> cells;
        for (std::size_t at = 0; at < rows.size(); at = std::min(rows.find(',', at), rows.size() - 1) + 1) {
            cells.push_back(rows.substr(at, rows.find(',', at) - at));
        }
        return std::stod(cells.at(9));
    };
    CHECK(height(*kept[0]) == Approx(height(*first) + 1));
    CHECK(height(*kept[2]) == Approx(height(*first) + 2));
}

TEST_CASE("the stem, the thickness, the leaves and the droop of the tree are drawn again without a step", "[studio]") {
    const fs::path file = fs::path(ESPALIER_SOURCE_DIR) / "environments/tree.toml";
    const std::string text = read_text(file), model = "colour_map =";
    Grower grower(file);
    const auto with_settings = [&](const std::string& settings) {
        return with(text, model, "define = { " + settings + " }\n" + model);
    };
    const auto first = grower.grow(with_settings("CROWN_WIDTH = 3"), nullptr, 12, 0);
    REQUIRE(first->is_whole);
    CHECK(first->watcher.derived == 13);
    for (const std::string setting :
         {"STEM_LENGTH = 3", "THICKNESS = 1.5", "LEAF_SIZE = 0.3", "LEAVES = 0", "DROOP = 0.4", "BARK_COLOUR = 3"}) {
        INFO(setting);
        const std::string changed = with_settings("CROWN_WIDTH = 3, " + setting);
        const auto redrawn = grower.grow(changed, first->growth.get(), 12);
        REQUIRE(redrawn->is_whole);
        CHECK(redrawn->watcher.derived == 0);
        check_same(*redrawn, *grower.grow(changed, nullptr, 12, 0));
    }
    CHECK(grower.grow(with_settings("CROWN_WIDTH = 4"), first->growth.get(), 12)->watcher.derived == 13);
}

TEST_CASE("what comes back to the strings of plants that ask is grown anew", "[studio]") {
    const TemporaryFolder folder;
    folder.write("asking.l", asking_tree);
    folder.write("other.l", with(asking_tree, "!(0.05)", "!(0.06)"));
    folder.write("longer.l", with(asking_tree, "length: 5", "length: 7"));
    Grower grower(folder.write("scene.toml", asking_scene));
    const auto first = grower.grow(asking_scene, nullptr, 5, 0);
    for (const std::string& text :
         {with(asking_scene, "voxel = 0.5", "voxel = 0.4"), with(asking_scene, "seed = 3", "seed = 4"),
          with(asking_scene, "asking.l\"", "asking.l\"\nposition = [1, 0, 0]"),
          with(asking_scene, "asking.l", "other.l"),
          with(asking_scene, "asking.l\"", "asking.l\"\ndefine = { SHARE = 0.8 }"),
          with(asking_scene, "voxel = 0.5", "voxel = 0.5\nstrength = 0.3")}) {
        INFO(text);
        const auto grown = grower.grow(text, first->growth.get(), 5);
        REQUIRE(grown->is_whole);
        CHECK(grown->watcher.derived == 6);
        check_same(*grown, *grower.grow(text, nullptr, 5, 0));
    }
    // More steps than there are, and a process that reads what stages draw.
    CHECK(grower.grow(with(asking_scene, "asking.l", "longer.l"), first->growth.get(), 7)->watcher.derived == 8);
    const std::string lit =
        with(asking_scene, "process = \"voxel-shade\"\nvoxel = 0.5", "process = \"canopy-light\"\nvoxel = 0.5");
    const auto canopy = grower.grow(lit, nullptr, 5, 0);
    if (canopy->is_whole) {
        const auto again = grower.grow(with(lit, "exponent = 2", "exponent = 3"), canopy->growth.get(), 5);
        CHECK(again->watcher.derived == 6);
    }
}

TEST_CASE("settings of every model and scene of the library show the same, redrawn or grown anew", "[studio]") {
    int redrawn = 0, derived = 0;
    for (const fs::path& file : library()) {
        INFO(file.string());
        const std::string text = read_text(file);
        Grower grower(file);
        const auto first = grower.grow(text, nullptr, 3, 0);
        if (!first->is_whole) continue;  // a side of an experiment, or what needs an argument
        const auto again = grower.grow(text, first->growth.get(), 3);
        REQUIRE(again->is_whole);
        check_same(*again, *first);
        int tried = 0;
        for (const WrittenNumber& number : written_numbers(file, text)) {
            const std::string value = other_value(number);
            if (value.empty() || ++tried > 2) continue;
            const std::string changed = with_number(text, number, value);
            const auto after = grower.grow(changed, first->growth.get(), 3);
            if (!after->is_whole) continue;
            INFO(number.name << " " << value);
            ++(after->watcher.derived == 0 ? redrawn : derived);
            check_same(*after, *grower.grow(changed, nullptr, 3, 0));
        }
    }
    CHECK(redrawn > 50);
    CHECK(derived > 200);
}
