// What a stage shows: pixels of frames made by hand.
#include "picture/stage/stage.h"

#include "espalier/base/error.h"

#include "picture/pictures.h"
#include "picture/stage/legend.h"
#include "temporary_folder.h"

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkImageData.h>

#include <fstream>

using namespace espalier;
using namespace espalier::picture;
using Catch::Contains;

namespace {

HandmadePlant stem(std::uint32_t number, double x, double z) {
    HandmadePlant plant;
    plant.number = number;
    plant.add_internode(1, 0, 0, 0, 0, {x, 0, z}, {x, 1, z}, 0.5);
    plant.add_internode(2, 1, 1, 0, 0, {x, 1, z}, {x, 2, z}, 0.75);
    return plant;
}

/// A disc of 1.6 m lies on its tip.
HandmadePlant tree_with_flat_crown() {
    HandmadePlant plant = stem(0, 0, 0);
    Pose level;
    level.position = {0, 2, 0};
    level.heading = {0, 0, 1};
    plant.add_organ(Organ::Shape::disc, 7, 1.6, level);
    return plant;
}

bool is_blue(const Pixel& pixel) {
    return pixel[2] > pixel[0] + 40;
}
bool is_orange(const Pixel& pixel) {
    return pixel[0] > pixel[2] + 40;
}

PictureStyle coloured_by(const std::string& name) {
    PictureStyle style = Pictured::plain();
    style.colour_by = name;
    return style;
}

}  // namespace

TEST_CASE("stage: each plant is seen in its colour at its place, and nothing beside them", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant left = stem(0, 0, 0), right = stem(1, 2, 0);
    Pictured pictured({&left, &right});
    const auto image = pictured.picture(coloured_by("plant"));
    for (const double y : {0.1, 1.0, 1.9}) {
        CHECK(is_blue(pictured.seen(*image, {0, y, 0})));
        CHECK(is_orange(pictured.seen(*image, {2, y, 0})));
        CHECK(is_white(pictured.seen(*image, {1, y, 0})));
    }
    CHECK(is_white(pictured.seen(*image, {0.15, 1, 0})));
}

TEST_CASE("stage: what stands behind is hidden, and seen from the other side", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant near = stem(0, 0, 1), far = stem(1, 0, -1);
    Pictured pictured({&near, &far});
    CHECK(is_blue(pictured.seen(*pictured.picture(coloured_by("plant"), {0, 0}), {0, 1, 0})));
    CHECK(is_orange(pictured.seen(*pictured.picture(coloured_by("plant"), {180, 0}), {0, 1, 0})));
    const auto aside = pictured.picture(coloured_by("plant"), {90, 0});
    CHECK(is_blue(pictured.seen(*aside, {0, 1, 1})));
    CHECK(is_orange(pictured.seen(*aside, {0, 1, -1})));
}

TEST_CASE("stage: one plant alone is shown and framed", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant left = stem(0, 0, 0), right = stem(1, 20, 0);
    Pictured pictured({&left, &right});
    PictureStyle style = coloured_by("plant");
    style.plant = 1;
    const auto image = pictured.picture(style);
    CHECK(is_orange(pictured.seen(*image, {20, 1, 0})));
    int orange = 0, blue = 0;
    for (int y = 0; y < Pictured::height; ++y) {
        for (int x = 0; x < Pictured::width; ++x) {
            orange += is_orange(pixel_at(*image, x, y));
            blue += is_blue(pixel_at(*image, x, y));
        }
    }
    CHECK(blue == 0);
    CHECK(orange > 1000);
}

TEST_CASE("stage: everything is in the picture, and it fills it, from wherever one looks", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant plant = branched_plant();
    Pictured pictured({&plant});
    for (const CameraPlace place :
         {CameraPlace{0, 0}, CameraPlace{30, 12}, CameraPlace{200, -40}, CameraPlace{75, 80}}) {
        const auto image = pictured.picture(Pictured::plain(), {place.azimuth, place.elevation, 1, false});
        int left = Pictured::width, right = -1, bottom = Pictured::height, top = -1;
        for (int y = 0; y < Pictured::height; ++y) {
            for (int x = 0; x < Pictured::width; ++x) {
                if (is_white(pixel_at(*image, x, y))) continue;
                left = std::min(left, x), right = std::max(right, x);
                bottom = std::min(bottom, y), top = std::max(top, y);
            }
        }
        CHECK(left >= 4);
        CHECK(right < Pictured::width - 4);
        CHECK(bottom >= 4);
        CHECK(top < Pictured::height - 4);
        CHECK((right - left > 0.8 * Pictured::width || top - bottom > 0.8 * Pictured::height));
    }
}

TEST_CASE("stage: a field's plane has the colours of its values", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant plant = stem(0, 5, 0);
    Pictured pictured({&plant});
    PictureStyle style = Pictured::plain();
    style.fields.push_back({"light", FieldLook::Kind::slice, 'z', {}, {}});
    const auto image = pictured.picture(style);
    // 2 x 3 voxels of 0.5 m from (1, 2, 3) on: 0.5 in the first, 1 in the last, 0.25 in the others.
    const Pixel first = pictured.seen(*image, {1.25, 2.25, 3.25}), last = pictured.seen(*image, {1.75, 3.25, 3.25});
    const Pixel usual = pictured.seen(*image, {1.25, 3.25, 3.25});
    const auto light = [](const Pixel& pixel) { return pixel[0] + pixel[1] + pixel[2]; };
    CHECK(light(usual) > light(first) + 60);
    CHECK(light(first) > light(last) + 60);
    CHECK(last[2] > last[0] + 60);
    CHECK(is_white(pictured.seen(*image, {3, 2.5, 3.25})));
}

TEST_CASE("stage: the surface and the cloud of a field are drawn where it is", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant plant = stem(0, 5, 0);
    Pictured pictured({&plant});
    for (const FieldLook::Kind kind : {FieldLook::Kind::volume, FieldLook::Kind::surface}) {
        PictureStyle style = Pictured::plain();
        style.fields.push_back({"light", kind, 'z', {}, 0.3});
        const auto image = pictured.picture(style);
        int drawn = 0;
        for (int y = 0; y < Pictured::height; ++y) {
            for (int x = 0; x < Pictured::width / 2; ++x) drawn += !is_white(pixel_at(*image, x, y));
        }
        CHECK(drawn > 20);
        CHECK(pictured.painter->stage().legend().keys.size() == 1);
    }
}

TEST_CASE("stage: a traced picture has the colours of a field's plane where nothing stands before it", "[pictures]") {
    if (!can_draw()) return;
    HandmadePlant pole;
    pole.add_internode(1, 0, 0, 0, 0, {1.6, 2, 4}, {1.6, 3.5, 4}, 0.1);  // before the right half of the field
    Pictured pictured({&pole});
    PictureStyle style = pictured.plain();
    style.light = PictureLight();
    style.light->samples = 1;
    const auto traced = [&](double behind) {
        style.fields = {{"light", FieldLook::Kind::slice, 'z', behind, {}}};
        (void)pictured.picture(style);
        return pictured.painter->traced({}, {});
    };
    PictureStyle drawn = pictured.plain();
    drawn.fields = {{"light", FieldLook::Kind::slice, 'z', 3.25, {}}};
    const auto field = pictured.picture(drawn);
    const glm::dvec3 free(1.25, 2.25, 3.25), hidden(1.6, 2.4, 4.05);
    const Pixel expected = pictured.seen(*field, free);
    const auto with_field = traced(3.25);
    const Pixel there = pictured.seen(*with_field, free), pole_there = pictured.seen(*with_field, hidden);
    style.fields.clear();
    (void)pictured.picture(style);
    const auto without = pictured.painter->traced({}, {});
    const Pixel pole_alone = pictured.seen(*without, hidden), sky = pictured.seen(*without, free);
    for (int k = 0; k < 3; ++k) {
        // The plane lets 30 of 255 parts through: of white where nothing else is drawn.
        CHECK(there[k] == Approx(expected[k] - 30 + 30.0 / 255 * sky[k]).margin(6));
        CHECK(std::abs(pole_there[k] - pole_alone[k]) < 12);
    }
}

TEST_CASE("stage: the same frame gives the same picture, byte for byte", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant plant = branched_plant();
    PictureStyle style;
    style.ground = true;
    style.scale_bar = true;
    style.colour_by = "vigour";
    std::vector<std::string> pictures;
    for (int i = 0; i < 2; ++i) {
        Pictured pictured({&plant});
        const auto image = pictured.picture(style, {30, 12});
        const auto* bytes = static_cast<const char*>(image->GetScalarPointer());
        pictures.emplace_back(bytes, 3 * Pictured::width * Pictured::height);
    }
    CHECK((pictures[0] == pictures[1]));
}

TEST_CASE("stage: a transparent background is clear, plants are not", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant plant = stem(0, 0, 0);
    Pictured pictured({&plant});
    PictureStyle style = Pictured::plain();
    style.background.transparent = true;
    const auto image = pictured.picture(style);
    CHECK(pixel_at(*image, 2, 2)[3] == 0);
    CHECK(pictured.seen(*image, {0, 1, 0})[3] == 255);
}

TEST_CASE("stage: a crown's shadow falls on the ground away from the sun", "[pictures]") {
    if (!can_draw()) return;
    HandmadePlant plant = tree_with_flat_crown();
    Pictured pictured({&plant});
    PictureStyle style;
    style.ground = true;
    style.sun_azimuth = 90;
    style.sun_elevation = 75;
    const auto image = pictured.picture(style, {0, 30});
    const Pixel lit = pictured.seen(*image, {0.6, 0, 0}), shaded = pictured.seen(*image, {-0.6, 0, 0});
    CHECK(lit[0] > shaded[0] + 15);
    CHECK(lit[0] < 255);
}

TEST_CASE("stage: roots are seen through the ground, and darker than beside it", "[pictures]") {
    if (!can_draw()) return;
    HandmadePlant plant = stem(0, 0, 0);
    plant.add_internode(3, 1, 1, 1, 1, {0, 0, 0}, {0, -1.5, 0}, 0.5);
    plant.add_internode(4, 1, 1, 2, 1, {0, 1, 0}, {1.5, 1.5, 1.5}, 0.5);
    plant.add_internode(5, 1, 1, 3, 1, {0, 1, 0}, {-1.5, 1.5, -1.5}, 0.5);
    Pictured pictured({&plant});
    PictureStyle style = Pictured::plain();
    const glm::dvec3 root{0, -0.2, 0};
    auto image = pictured.picture(style, {0, 20});
    const Pixel bare = pictured.seen(*image, root);
    style.ground = true;
    image = pictured.picture(style, {0, 20});
    const Pixel below = pictured.seen(*image, root), beside = pictured.seen(*image, {0.5, -0.2, 0});
    CHECK_FALSE(is_white(beside));
    CHECK(std::abs(below[0] - bare[0]) > 5);     // through the ground
    CHECK(std::abs(below[0] - beside[0]) > 25);  // but still seen
}

TEST_CASE("stage: roots stand below feet; what a plane would cut through is no root", "[pictures]") {
    HandmadePlant rooted = stem(0, 0, 0);
    rooted.add_internode(3, 1, 1, 1, 1, {0, 0, 0}, {0.7, -1.5, 0}, 0.5);
    HandmadePlant neighbour = stem(1, 30, 0);
    neighbour.add_internode(3, 1, 1, 1, 1, {30, 0, 0}, {30, -1.5, 0}, 0.5);
    HandmadePlant arch = stem(0, 0, 0);
    arch.add_internode(3, 1, 1, 1, 1, {0, 2, 0}, {2, 1, 0}, 0.5);
    arch.add_internode(4, 3, 1, 1, 1, {2, 1, 0}, {2, -1, 0}, 0.5);
    const auto surveyed = [](const std::vector<const HandmadePlant*>& plants) {
        const Pictured pictured(plants);
        const Stage stage(*pictured.run, Pictured::plain());
        const RecordedFrame* const frame = &pictured.run->frames().back();
        return stage.survey(std::span(&frame, 1));
    };
    const HandmadePlant upright = stem(0, 0, 0);
    CHECK_FALSE(surveyed({&upright}).grows_beneath());
    CHECK(surveyed({&rooted, &neighbour}).grows_beneath());
    CHECK(surveyed({&rooted, &neighbour}).is_rooted());
    CHECK(surveyed({&arch}).grows_beneath());
    CHECK_FALSE(surveyed({&arch}).is_rooted());
}

TEST_CASE("stage: light paths draw the plants where the graphics card does, with a shadow away from the sun",
          "[pictures][light]") {
    if (!can_draw()) return;
    HandmadePlant plant = tree_with_flat_crown();
    Pictured pictured({&plant});
    PictureStyle style = Pictured::plain();
    style.ground = true;
    style.sun_azimuth = 90;
    style.sun_elevation = 75;
    style.background.transparent = true;
    style.light = PictureLight();
    style.light->samples = 8;
    style.light->shows_sky = false;
    const auto plain = pictured.picture(
        [&] {
            PictureStyle rastered = style;
            rastered.light.reset();
            rastered.ground = false;
            return rastered;
        }(),
        {0, 30});
    pictured.picture(style, {0, 30});
    const auto traced = pictured.painter->traced(style.light->sky);
    const Pixel lit = pictured.seen(*traced, {0.6, 0, 0}), shaded = pictured.seen(*traced, {-0.6, 0, 0});
    CHECK(lit[0] > shaded[0] + 30);
    // Without the ground both have the plants in the same pixels.
    style.ground = false;
    pictured.picture(style, {0, 30});
    const auto alone = pictured.painter->traced(style.light->sky);
    int plants = 0, different = 0;
    for (int y = 0; y < Pictured::height; ++y) {
        for (int x = 0; x < Pictured::width; ++x) {
            const int a = pixel_at(*plain, x, y)[3], b = pixel_at(*alone, x, y)[3];
            plants += a > 0;
            different += std::abs(a - b) > 160;
        }
    }
    CHECK(plants > 500);
    CHECK(different == 0);
    CHECK(pixel_at(*alone, 2, 2)[3] == 0);
}

TEST_CASE("stage: what is thin is as bright from behind as in front, what is closed is dark beneath", "[pictures]") {
    if (!can_draw()) return;
    HandmadePlant plant = tree_with_flat_crown();
    Pose upright;
    upright.position = {3, 2, 0};
    plant.add_organ(Organ::Shape::sphere, 8, 1.6, upright);
    Pictured pictured({&plant});
    PictureStyle style = Pictured::plain();
    style.sun_elevation = 80;
    const auto above = pictured.picture(style, {0, 60, 1, false});
    const Pixel disc_above = pictured.seen(*above, {0.4, 2, 0}), sphere_above = pictured.seen(*above, {3, 2.8, 0});
    const auto beneath = pictured.picture(style, {0, -60, 1, false});
    const Pixel disc_beneath = pictured.seen(*beneath, {0.4, 2, 0}),
                sphere_beneath = pictured.seen(*beneath, {3, 1.2, 0});
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(disc_above[k] - disc_beneath[k]) <= 8);
    CHECK(sphere_above[1] > sphere_beneath[1] + 20);
}

TEST_CASE("stage: a texture is seen in its own colours where nobody gave others", "[pictures]") {
    if (!can_draw()) return;
    const RunFolder files;
    std::filesystem::create_directories(files.path);
    const std::filesystem::path file = files.path / "leaf.ppm";
    std::ofstream(file) << "P6\n1 1\n255\n\xff" << '\0' << '\xff';
    HandmadePlant plant;
    plant.interpretation.geometry.shapes = square_leaf(file);
    plant.add_organ(Organ::Shape::surface, 5, 1);
    plant.interpretation.geometry.organs.back().surface = 'l';
    plant.interpretation.geometry.organs.back().look = {4, 1};
    Pictured pictured({&plant});
    const auto image = pictured.picture(Pictured::plain(), {30, 30, 1, false});
    int magenta = 0;
    for (int y = 0; y < Pictured::height; ++y) {
        for (int x = 0; x < Pictured::width; ++x) {
            const Pixel pixel = pixel_at(*image, x, y);
            magenta += pixel[0] > 140 && pixel[1] < 60 && pixel[2] > 140;
        }
    }
    CHECK(magenta > 500);
}

TEST_CASE("stage: a picked triangle tells its module, which can be made bright", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant left = stem(0, 0, 0), right = stem(1, 2, 0);
    Pictured pictured({&left, &right});
    pictured.picture();
    Stage& stage = pictured.painter->stage();
    vtkActorCollection& actors = *stage.renderer().GetActors();
    actors.InitTraversal();
    vtkActor* tubes = actors.GetNextActor();
    const auto picked = stage.module_at(tubes, 0);
    REQUIRE(picked);
    CHECK(picked->plant == 0);
    CHECK(picked->identity == 1);
    CHECK(picked->of_points);
    CHECK(stage.geometry().of_points.identities[picked->row] == 1);
    CHECK(picked->position.x == Approx(0).margin(0.11));
    CHECK_FALSE(stage.module_at(tubes, 1'000'000));
    CHECK_FALSE(stage.module_at(nullptr, 0));

    const auto places = stage.places_of(1, 2);
    REQUIRE(places.size() == 1);
    CHECK(places[0].position.x == Approx(2).margin(0.02));
    CHECK(places[0].position.y == Approx(1.5).margin(0.2));
    stage.highlight(Stage::Highlight{1, 2});
    const auto image = pictured.painter->picture();
    CHECK(pictured.seen(*image, {2, 1.5, 0}) == Pixel{255, 60, 0, 255});
    CHECK(pictured.seen(*image, {2, 0.5, 0}) != Pixel{255, 60, 0, 255});
    CHECK(pictured.seen(*image, {0, 1.5, 0}) != Pixel{255, 60, 0, 255});
}

TEST_CASE("stage: colours span what was surveyed, not what a frame happens to hold", "[pictures]") {
    if (!can_draw()) return;
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    FramePainter painter(run, coloured_by("vigour"), {120, 90});
    Stage& stage = painter.stage();
    const RecordedFrame* const frames[] = {&run.frames().front(), &run.frames().back()};
    const StageSurvey survey = stage.survey(frames);
    REQUIRE(survey.range);
    CHECK(survey.range->at(0) == 0.25);
    CHECK(survey.range->at(1) == 0.75);
    CHECK(survey.box.upper.x == Approx(6));
    stage.settle(survey);
    stage.show(run.frames().front());
    REQUIRE(stage.legend().keys.size() == 1);
    CHECK(stage.legend().keys[0].range == *survey.range);
    CHECK(stage.legend().keys[0].title == "vigour");
}

TEST_CASE("colour bars say the units of what they show", "[pictures]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    FrameGeometry geometry = run.geometry(run.frames().back());
    const auto title = [&](const std::string& name) { return Colouring(run, name).key(run, geometry, {0, 1})->title; };
    CHECK(title("vigour") == "vigour");
    geometry.units["vigour"] = "umol m-2 s-1";
    CHECK(title("vigour") == "vigour (umol m-2 s-1)");
    CHECK(title("light") == "light");  // a share
    CHECK(with_unit("water", "m3/m3") == "water (m3/m3)");
}

TEST_CASE("stage: a run in one plane is flat and seen from the front", "[pictures]") {
    if (!can_draw()) return;
    const HandmadePlant plant = branched_plant();
    Pictured pictured({&plant});
    const auto image = pictured.picture(Pictured::plain(), {75, 60});
    CHECK(pictured.painter->stage().is_flat());
    // A line drawing: ink on the light.
    CHECK(pictured.seen(*image, {0, 2, 0})[0] < 40);
    CHECK(pictured.seen(*image, {0, 2, 0})[1] < 40);
}

TEST_CASE("stage: names that a run has not are told with the nearest", "[pictures]") {
    const RecordedFolder recorded;
    const RecordedRun run(recorded.folder.path);
    CHECK_THROWS_WITH(Stage(run, coloured_by("vigor")), Contains("did you mean 'vigour'?"));
    CHECK_THROWS_AS(Stage(run, coloured_by("nothing")), UserError);
    PictureStyle style;
    style.fields.push_back({"ligth", FieldLook::Kind::slice, 'z', {}, {}});
    CHECK_THROWS_WITH(Stage(run, style), Contains("did you mean 'light'?"));
    // The parameter 'light' is an answer of queries alone, which nobody draws: the name means the field.
    const std::vector<std::string> names = Stage(run, {}).colour_names();
    CHECK(names.front() == "natural");
    CHECK(std::count(names.begin(), names.end(), "light") == 1);
    CHECK(std::count(names.begin(), names.end(), "vigour") == 1);
}

TEST_CASE("stage: light shows the relief of bark, and a smooth skin fills the fork", "[pictures]") {
    if (!can_draw()) return;
    HandmadePlant plant = stem(0, 0, 0);
    plant.add_internode(3, 1, 1, 1, 1, {0, 1, 0}, {1, 2, 0.3}, 0);
    for (Internode& internode : plant.interpretation.geometry.internodes) {
        internode.base_radius = internode.tip_radius = 0.2;
    }
    const TemporaryFolder folder;
    const auto differing = [&](const PictureStyle& a, const PictureStyle& b) {
        Pictured pictured({&plant});
        const auto first = pictured.picture(a), second = pictured.picture(b);
        int count = 0;
        for (int x = 0; x < Pictured::width; ++x) {
            for (int y = 0; y < Pictured::height; ++y) count += pixel_at(*first, x, y) != pixel_at(*second, x, y);
        }
        return count;
    };
    const auto barked = [&](const char* name, const std::string& settings) {
        PictureStyle style = Pictured::plain();
        style.bark = folder.write(name, settings);
        return style;
    };
    // Both are equally bright: what differs is the light on what rises and falls.
    const PictureStyle flat = barked("flat.bark", "depth = 0\ndarkness = 0\nsize = 64\n");
    const PictureStyle deep = barked("deep.bark", "depth = 0.1\ndarkness = 0\nsize = 64\n");
    CHECK(differing(flat, flat) == 0);
    CHECK(differing(flat, deep) > 500);
    const HandmadePlant unlit = stem(0, 0, 0);  // flat drawings have no light
    Pictured flat_drawing({&unlit});
    CHECK_FALSE(is_white(flat_drawing.seen(*flat_drawing.picture(deep), {0, 1, 0})));
    PictureStyle smooth = Pictured::plain();
    smooth.skin.smooth = true;
    CHECK(differing(Pictured::plain(), smooth) > 50);
    Pictured pictured({&plant});
    const glm::dvec3 in_the_fork(0.24, 1.58, 0.07);
    CHECK(is_white(pictured.seen(*pictured.picture(), in_the_fork)));
    CHECK_FALSE(is_white(pictured.seen(*pictured.picture(smooth), in_the_fork)));
}
