// Pictures as the author of a model saw it.
#include "espalier/picture/author_view.h"

#include "picture/pictures.h"
#include "picture/stage/camera_fit.h"
#include "picture/stage/stage_survey.h"

using namespace espalier;

TEST_CASE("the camera looks from where the author did", "[pictures]") {
    RecordedView view;
    CHECK(camera_of(view).azimuth == 0);
    CHECK(camera_of(view).elevation == 0);
    CHECK(camera_of(view).is_parallel);
    view.towards_eye = {3, 0, 0};
    CHECK(camera_of(view).azimuth == Approx(90));
    view.towards_eye = {0, 1, 1};
    view.perspective = true;
    view.angle = 30;
    CHECK(camera_of(view).elevation == Approx(45));
    CHECK(camera_of(view).view_angle == 30.0);
    CHECK_FALSE(camera_of(view).is_parallel);
}

TEST_CASE("a twisted camera has its up to the side", "[pictures]") {
    const std::vector<glm::dvec3> points{{-1, -1, 0}, {1, 1, 0}};
    CameraPlace place{0, 0};
    CHECK(fitted(points, place, false, true, 1, {}).up.y == Approx(1));
    place.twist = 90;
    const CameraView view = fitted(points, place, false, true, 1, {});
    CHECK(view.up.x == Approx(-1));
    CHECK(view.up.y == Approx(0).margin(1e-12));
}

TEST_CASE("the sun shines from the author's light, and not from below the ground", "[pictures]") {
    RecordedView view;
    PictureStyle style;
    light_as(view, style);
    CHECK(style.sun_azimuth == PictureStyle().sun_azimuth);
    view.towards_light = {1, -5, 0};
    light_as(view, style);
    CHECK(style.sun_azimuth == Approx(90));
    CHECK(style.sun_elevation == 5);
}

TEST_CASE("the background is dark where most colours are hardly seen on white", "[pictures]") {
    const auto survey_of = [](const glm::dvec4& colour) {
        const RunFolder folder;
        Palette palette;
        for (int i = 0; i < 256; ++i) palette.entries[256 + i].diffuse = colour;
        const HandmadePlant plant = branched_plant();
        Timeline timeline(folder.path, timeline_table(), 0);
        PlantFrame frame = plant.frame();
        frame.palette = &palette;
        const Fields fields;
        timeline.record({0, 0, {frame}, &fields});
        timeline.finish();
        timeline.write_run(run_json);
        const RecordedRun run(folder.path);
        const PictureStyle style;
        StageSurvey survey;
        add_survey(run, style, Colouring(run, "natural"), run.frames()[0], run.geometry(run.frames()[0]), survey);
        CHECK(chosen_background(run, survey, light_background).is_dark() == survey.wants_dark());
        return survey;
    };
    CHECK(survey_of({1, 1, 0, 1}).wants_dark());
    CHECK_FALSE(survey_of({0.2, 0.6, 0.1, 1}).wants_dark());
    CHECK_FALSE(StageSurvey().wants_dark());
}
