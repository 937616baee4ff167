// Writing beside the run: order, room, failures.
#include "timeline/frames/frame_writer.h"

#include "espalier/base/error.h"
#include "espalier/geometry/openvdb_grid.h"

#include "catch.h"
#include "timeline/frames.h"

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>

using namespace espalier;
using namespace espalier::timeline;

namespace {

void add(FrameWriter& writer, int step, const HandmadePlant& plant, bool due = true, const Fields& fields = {}) {
    writer.add({step, 0.5 * step, {plant.frame()}, &fields}, due);
}

/// A gate that holds the writing thread until it is opened.
class Gate {
public:
    void open() { open_ = true; }
    void pass() const {
        while (!open_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

private:
    std::atomic<bool> open_{false};
};

}  // namespace

TEST_CASE("frames are written in the order in which they came, each as it was", "[timeline]") {
    std::vector<int> steps;
    std::vector<std::size_t> modules, polygons;
    std::vector<double> answers;
    {
        FrameWriter writer({}, [&](const Frame& frame, bool due) {
            CHECK(due == (frame.step % 3 == 0));
            CHECK(frame.time == 0.5 * frame.step);
            steps.push_back(frame.step);
            modules.push_back(frame.plants[0].string->size());
            polygons.push_back(frame.plants[0].interpretation->geometry.polygons.size());
            answers.push_back(frame.plants[0].string->parameters[0]);
        });
        HandmadePlant plant;
        plant.add_query(1, {0, 0, 0}, 0);
        for (int step = 0; step < 200; ++step) {
            plant.string.parameters[0] = step;
            add(writer, step, plant, step % 3 == 0);
            plant.add_triangle(Identity(step));
        }
    }
    REQUIRE(steps.size() == 200);
    for (int step = 0; step < 200; ++step) {
        const auto i = static_cast<std::size_t>(step);
        CHECK(steps[i] == step);
        CHECK(modules[i] == 2 + i);
        CHECK(polygons[i] == i);
        CHECK(answers[i] == step);
    }
}

TEST_CASE("a run that is faster than the disk waits for it", "[timeline]") {
    Gate gate;
    std::atomic<int> added{0}, written{0};
    FrameWriter writer({}, [&](const Frame&, bool) {
        gate.pass();
        ++written;
    });
    const HandmadePlant plant = branched_plant();
    std::thread run([&] {
        for (int step = 0; step < 20; ++step) {
            add(writer, step, plant);
            ++added;
        }
    });
    while (added < int(FrameWriter::most_frames)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    CHECK(added == int(FrameWriter::most_frames));
    CHECK(written == 0);
    gate.open();
    run.join();
    writer.wait();
    CHECK(written == 20);
}

TEST_CASE("what went wrong with a frame is thrown at the next, and nothing is written after it", "[timeline]") {
    std::vector<int> steps;
    FrameWriter writer({}, [&](const Frame& frame, bool) {
        if (frame.step == 3) throw RunError("the disk is full");
        steps.push_back(frame.step);
    });
    const HandmadePlant plant = branched_plant();
    int step = 0;
    const auto run = [&] {
        for (; step < 100; ++step) add(writer, step, plant);
    };
    CHECK_THROWS_WITH(run(), "the disk is full");
    CHECK(step <= 3 + 1 + int(FrameWriter::most_frames));
    CHECK_THROWS_AS(writer.wait(), RunError);
    CHECK_THROWS_AS(add(writer, 100, plant), RunError);
    CHECK(steps == std::vector<int>{0, 1, 2});
}

TEST_CASE("frames that are due hold the fields asked for, and those alone are made", "[timeline]") {
    initialize_openvdb();
    std::map<std::string, int> made;
    const auto field = [&](const std::string& name) {
        const auto make = [&made, name] {
            ++made[name];
            auto grid = std::make_shared<FieldGrid>();
            grid->grid = openvdb::FloatGrid::create(0);
            return std::shared_ptr<const FieldGrid>(grid);
        };
        return Field{name, "1", "", nullptr, true, make};
    };
    Fields fields;
    for (const char* name : {"light", "shade", "water"}) fields.provide(field(name));
    std::vector<std::size_t> held;
    FrameWriter writer({"light"}, [&](const Frame& frame, bool) { held.push_back(frame.fields->all().size()); });
    const HandmadePlant plant;
    add(writer, 0, plant, true, fields);
    add(writer, 1, plant, false, fields);
    writer.wait();
    CHECK(held == std::vector<std::size_t>{1, 0});
    CHECK(made["light"] > 0);
    CHECK(made["shade"] + made["water"] == 0);
}
