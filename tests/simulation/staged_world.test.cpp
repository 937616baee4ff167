// Stages that are called one by one leave what a whole step leaves.
#include "espalier/simulation/staged_world.h"

#include "catch.h"
#include "simulation/shading_stand.h"
#include "temporary_folder.h"

#include <type_traits>
#include <vector>

using namespace espalier;

static_assert(std::is_nothrow_move_constructible_v<World> && std::is_nothrow_move_assignable_v<StagedWorld>);
static_assert(!std::is_copy_constructible_v<World>);

namespace {

class StagedWorlds : public TemporaryFolder {
public:
    StagedWorlds() {
        write("shading.l", shading);
        write("growing.l",
              "lsystem: 1\nseed: 4\nderivation length: 9\naxiom: A\nA --> F[+A]A : 1\nA --> FA : 2\nendlsystem\n");
    }

    /// Two plants whose modules are born by turns.
    Scene scene(const std::string& model, const std::string& rest = "") const {
        return read_scene_text(
            "[[plant]]\nmodel = '" + model + "'\n[[plant]]\nmodel = '" + model + "'\nposition = [1, 0, 0]\n" + rest,
            "scene.toml", path());
    }
};

std::vector<std::uint64_t> birth_numbers(const ModuleString& string) {
    std::vector<std::uint64_t> numbers;
    for (std::size_t i = 0; i < string.size(); ++i) numbers.push_back(string.birth_number(i));
    return numbers;
}

void check_same_plants(const World& one, const World& other) {
    for (std::size_t plant = 0; plant < one.size(); ++plant) {
        const ModuleString &string = one.string(plant), &same = other.string(plant);
        CHECK(to_text(string, one.model(plant).alphabet) == to_text(same, other.model(plant).alphabet));
        CHECK(birth_numbers(string) == birth_numbers(same));
        CHECK(one.interpretation(plant).geometry.internodes.size() ==
              other.interpretation(plant).geometry.internodes.size());
    }
}

}  // namespace

TEST_CASE_METHOD(StagedWorlds, "stages called one by one leave what a step leaves, birth numbers, too",
                 "[simulation]") {
    const Scene described = scene("shading.l", light);
    World whole(described);
    StagedWorld staged(described);
    whole.start();
    staged.write_axioms();
    for (int step = 0; step < 7; ++step) {
        INFO("step " << step);
        staged.interpret();
        staged.exchange();
        check_same_plants(whole, staged);
        whole.step();
        staged.derive();
    }
}

TEST_CASE_METHOD(StagedWorlds, "a step that is taken again has the modules, numbers and drawing of the run",
                 "[simulation]") {
    const Scene described = scene("growing.l");
    World whole(described);
    StagedWorld deriving(described), drawing(described);
    whole.start();
    deriving.write_axioms();
    std::vector<DerivedStep> steps{deriving.derived()};
    for (int step = 1; step <= 6; ++step) {
        deriving.derive();
        steps.push_back(deriving.derived());
    }
    for (int step = 1; step <= 4; ++step) whole.step();
    drawing.take(steps[4]);
    drawing.interpret();
    check_same_plants(whole, drawing);
    // It goes on from there, too.
    for (int step = 5; step <= 6; ++step) {
        whole.step();
        drawing.derive();
    }
    drawing.interpret();
    CHECK(drawing.derived().births == steps[6].births);
    check_same_plants(whole, drawing);
}
