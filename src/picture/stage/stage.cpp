#include "picture/stage/stage.h"

#include "espalier/base/error.h"

#include "archive/meshes/axis_lines.h"
#include "archive/meshes/bark.h"
#include "picture/light/colour_space.h"
#include "picture/stage/background_scene.h"
#include "picture/stage/colouring.h"
#include "picture/stage/field_props.h"
#include "picture/stage/ground.h"
#include "picture/stage/legend.h"
#include "picture/stage/lit_stage.h"
#include "picture/stage/sky_visibility.h"
#include "picture/stage/stage_light.h"
#include "picture/stage/stage_mesh.h"
#include "picture/stage/stage_survey.h"
#include "picture/stage/stage_texture.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace espalier::picture {
namespace {

constexpr Rgb bright{255, 60, 0}, ink{30, 30, 30}, chalk{235, 235, 235};
constexpr std::size_t most_labels = 300;
const std::string none;

/// The time as a reader wants it: "step 12", or "6 days" where a scene says how long a step is.
std::string time_text(const RecordedRun& run, const RecordedFrame& frame) {
    if (run.time_unit() == "step") return fmt::format("step {}", frame.step);
    return fmt::format("{} {:.6g}", run.time_unit(), frame.time);
}

std::shared_ptr<const FrameGeometry> dressed(const FrameGeometry& geometry, const std::string& bark) {
    FrameGeometry copy = geometry;
    apply_bark(copy, bark);
    return std::make_shared<FrameGeometry>(std::move(copy));
}

}  // namespace

class Stage::Body {
public:
    Body(const RecordedRun& run, PictureStyle style) : run_(&run) {
        restyle(std::move(style));
        renderer_->AddActor(legend_actor_);
        renderer_->SetMaximumNumberOfPeels(6);
        renderer_->SetOcclusionRatio(0);
        legend_actor_->GetScene()->AddItem(legend_);
    }

    const RecordedRun* run_;
    PictureStyle style_;
    std::optional<Colouring> colouring_;
    std::optional<RecordedFrame> frame_;
    std::shared_ptr<const FrameGeometry> geometry_ = std::make_shared<FrameGeometry>();
    std::optional<StageSurvey> survey_;  ///< what `settle` was given
    StageSurvey here_;                   ///< survey of the frame that is shown
    std::optional<Highlight> highlighted_;

    struct Part {
        StageMesh mesh;
        vtkSmartPointer<vtkActor> actor;
    };
    std::vector<Part> parts_;
    std::vector<vtkSmartPointer<vtkProp>> others_;               ///< fields, ground, labels
    std::vector<vtkSmartPointer<vtkActor>> silhouettes_;         ///< of what a traced picture shows
    std::optional<vtkSmartPointer<vtkActor>> background_scene_;  ///< null: none. Read once
    std::vector<vtkSmartPointer<vtkActor>> highlight_actors_;
    std::optional<CameraView> view_;
    vtkNew<vtkRenderer> renderer_;
    vtkNew<vtkContextActor> legend_actor_;
    vtkNew<LegendItem> legend_;

    void restyle(PictureStyle style) {
        Colouring colouring(*run_, style.colour_by);
        for (const FieldLook& look : style.fields) check_field(*run_, look);
        const bool same_range = style.colour_by == style_.colour_by;
        if (survey_ && !same_range) survey_->range.reset();
        style_ = std::move(style);
        colouring_ = std::move(colouring);
        set_background();
        if (frame_) rebuild();
    }

    std::vector<Occluder> occluders() const {
        std::vector<Occluder> occluders;
        for (const Part& part : parts_) occluders.push_back({points_of(part.mesh), corners_of(part.mesh)});
        return occluders;
    }

    /// What a part of a frame cannot know of all of it.
    struct Whole {
        const StageSurvey& survey;
        const SkyVisibility* visibility;  ///< null: no shading
    };

    void show(const RecordedFrame& frame, std::shared_ptr<const FrameGeometry> geometry, const Whole* whole = nullptr) {
        geometry_ = style_.bark.empty() ? std::move(geometry) : dressed(*geometry, style_.bark);
        frame_ = frame;
        rebuild(whole);
    }

    std::shared_ptr<const FrameGeometry> load(const RecordedFrame& frame) const {
        const bool is_here = frame_ && frame_->plants == frame.plants && !frame.plants.empty();
        if (is_here && style_.bark.empty()) return geometry_;
        if (frame.geometry) return frame.geometry;
        if (frame.plants.empty()) return std::make_shared<FrameGeometry>();
        return std::make_shared<FrameGeometry>(run_->geometry(frame));
    }

    void add_survey(const RecordedFrame& frame, const FrameGeometry& geometry, StageSurvey& survey) const {
        picture::add_survey(*run_, style_, *colouring_, frame, geometry, survey);
    }

    void place_camera(const CameraPlace& place, bool follow) {
        const StageSurvey& framed = survey_ && !follow ? *survey_ : here_;
        std::vector<glm::dvec3> points = framed.outline.points();
        const int* size = renderer_->GetSize();
        const double width = std::max(1, size[0]), height = std::max(1, size[1]);
        Margins margins;
        margins.right += legend_->legend.width(static_cast<int>(height)) / width;
        if (!style_.title.empty()) margins.top += 0.04;
        if (style_.scale_bar || style_.time_beneath) margins.bottom += 0.05;
        CameraPlace from = place;
        if (is_flat() && place.front_if_flat && !place.turns) from.azimuth = from.elevation = 0;
        view_ = fitted(points, from, place.turns, is_flat() || place.is_parallel, width / height, margins);
        vtkCamera& camera = *renderer_->GetActiveCamera();
        camera.SetFocalPoint(&view_->focus.x);
        camera.SetPosition(&view_->position.x);
        camera.SetViewUp(&view_->up.x);
        camera.SetParallelProjection(view_->is_parallel);
        camera.SetParallelScale(view_->half_height);
        camera.SetViewAngle(view_->view_angle);
        camera.SetWindowCenter(-view_->shift.x, -view_->shift.y);
        renderer_->ResetCameraClippingRange();
        if (!style_.scale_bar) return;
        legend_->legend.metres_per_pixel = 2 * view_->half_height / height;
        legend_actor_->GetScene()->SetDirty(true);
    }

    bool is_flat() const { return is_flat_box(survey_ ? survey_->box : here_.box); }

    std::vector<LitPart> lit_parts() const {
        const std::vector<Rgb> colours = colours_of_points();
        std::vector<LitPart> lit;
        for (const Part& part : parts_) {
            const std::string& file = texture_file(part.mesh);
            lit.push_back(lit_part(*run_, part.mesh, {colours, file, has_own_colours(file), colouring_->is_natural()}));
        }
        if (const auto background = run_->background()) lit.push_back(lit_background(*background));
        return lit;
    }

    std::optional<LitGround> lit_ground() const {
        const auto disc = ground_disc();
        if (!style_.ground || is_flat() || !disc) return std::nullopt;
        const bool goes_on = style_.light && style_.light->shows_sky;
        const auto [red, green, blue] = soil_of(style_.background);
        const Rgb soil{static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
                       static_cast<std::uint8_t>(blue)};
        return LitGround{disc->middle, disc->radius, goes_on ? open_ground : linear_of(soil), !goes_on};
    }

    bool shows_roots() const { return (survey_ && !survey_->box.empty() ? *survey_ : here_).has_roots_to_see(); }

    void clear_for_light(double grey) {
        renderer_->SetBackground(grey, grey, grey);
        for (const auto& actor : silhouettes_) actor->GetProperty()->SetColor(grey, grey, grey);
    }

    void show_highlight() {
        for (const auto& actor : highlight_actors_) renderer_->RemoveActor(actor);
        highlight_actors_.clear();
        if (!highlighted_) return;
        for (const Part& part : parts_) add_highlight(part);
    }

    const FrameAttributes& attributes(const StageMesh& mesh) const {
        return mesh.is_of_axes ? geometry_->of_points : geometry_->of_cells;
    }

    StageModule module_of(const StageMesh& mesh, std::size_t triangle) const {
        const std::size_t row = mesh.row_of_triangle[triangle];
        const FrameAttributes& of = attributes(mesh);
        StageModule module{of.plants[row], of.identities[row], row, mesh.is_of_axes, glm::dvec3(0)};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<std::size_t>(corners_of(mesh)[3 * triangle + k]);
            module.position += glm::dvec3(points_of(mesh)[corner]) / 3.0;
        }
        return module;
    }

private:
    void set_background() {
        const Rgb& rgb = style_.background.rgb;
        renderer_->SetBackground(rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        renderer_->SetBackgroundAlpha(style_.background.transparent || style_.light ? 0 : 1);
    }

    std::array<double, 2> colour_range() const {
        if (style_.range) return *style_.range;
        if (survey_ && survey_->range) return *survey_->range;
        return here_.range.value_or(std::array<double, 2>{0, 1});
    }

    void rebuild(const Whole* whole = nullptr) {
        for (const Part& part : parts_) renderer_->RemoveActor(part.actor);
        for (const auto& prop : others_) renderer_->RemoveViewProp(prop);
        parts_.clear();
        others_.clear();
        silhouettes_.clear();
        here_ = whole ? whole->survey : StageSurvey{};
        if (!whole) add_survey(*frame_, *geometry_, here_);
        legend_->legend = {};
        build_meshes();
        // What is seen through is drawn in its order; VTK's quicker way draws it over what stands before it.
        renderer_->SetUseDepthPeeling(whole || shows_more_than_ground());
        if (!style_.light) add_lights_and_colours(whole);
        if (style_.light && !style_.fields.empty()) add_silhouettes();
        add_field_props();
        if (!style_.light) add_background_scene();
        add_labels();
        write_legend();
        show_highlight();
    }

    double size() const { return diagonal(here_.box); }

    /// Returns the size of all that the camera frames: lines without radius keep their width from frame to frame.
    double framed_size() const { return diagonal(survey_ && !survey_->box.empty() ? survey_->box : here_.box); }

    void build_meshes() {
        StageMeshOptions options;
        options.plant = style_.plant;
        options.triangles = static_cast<std::size_t>(std::max(0, style_.triangles));
        options.size = size();
        options.thinnest = static_cast<float>(framed_size() / 1000);
        options.skin = style_.skin;
        std::vector<StageMesh> meshes = surfaces_of(*geometry_, options);
        std::vector<StageMesh> tubes = tubes_of(*geometry_, options);
        std::move(tubes.begin(), tubes.end(), std::back_inserter(meshes));
        for (StageMesh& mesh : meshes) {
            if (mesh.row_of_triangle.empty()) continue;
            parts_.push_back({std::move(mesh), vtkSmartPointer<vtkActor>::New()});
        }
    }

    void add_lights_and_colours(const Whole* whole) {
        const glm::vec3 sun = direction_at(style_.sun_azimuth, style_.sun_elevation);
        set_lights(*renderer_, sun);
        std::optional<SkyVisibility> own;
        if (style_.shading && !is_flat() && !whole) own.emplace(occluders(), sun);
        const SkyVisibility* const visibility = whole ? whole->visibility : own ? &*own : nullptr;
        const std::vector<Rgb> colours = colours_of_points();
        // Colours that mean a number are only tinged, or they could not be read.
        const float shade = colouring_->is_natural() ? 1.0F : 0.5F;
        const std::vector<Rgb> white(colours.size(), Rgb{255, 255, 255});
        for (Part& part : parts_) {
            const auto texture = texture_worn(part.mesh);
            const std::string& file = texture ? geometry_->texture_files[part.mesh.texture] : none;
            dress_actor(*part.actor, part.mesh,
                        {texture && has_own_colours(file) ? white : colours, visibility, shade, !is_flat()});
            part.actor->SetTexture(texture);
            if (texture && !is_flat()) add_relief(*part.actor, run_->folder(), file);
            renderer_->AddActor(part.actor);
        }
        if (style_.ground && !is_flat()) add_ground(visibility);
    }

    /// Plants in one colour without light, so that they hide what of fields lies behind them.
    void add_silhouettes() {
        for (Part& part : parts_) add_silhouette(part.actor, part.mesh.data);
        if (!background_scene_) background_scene_ = background_actor(*run_);
        if (!*background_scene_) return;
        (*background_scene_)->GetMapper()->Update();
        const auto actor = vtkSmartPointer<vtkActor>::New();
        add_silhouette(actor, vtkPolyData::SafeDownCast((*background_scene_)->GetMapper()->GetInput()));
        others_.emplace_back(actor);
    }

    void add_silhouette(const vtkSmartPointer<vtkActor>& actor, vtkPolyData* data) {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(data);
        mapper->ScalarVisibilityOff();
        actor->SetMapper(mapper);
        actor->GetProperty()->LightingOff();
        silhouettes_.push_back(actor);
        renderer_->AddActor(actor);
    }

    /// "" where there is none, or something else is shown.
    const std::string& texture_file(const StageMesh& mesh) const {
        if (mesh.texture == 0 || !style_.textures || !colouring_->is_natural()) return none;
        return geometry_->texture_files[mesh.texture];
    }

    vtkSmartPointer<vtkTexture> texture_worn(const StageMesh& mesh) const {
        const std::string& file = texture_file(mesh);
        return file.empty() ? nullptr : texture_of(run_->folder(), file);
    }

    /// Where no colour is given the picture has it; bark is only brighter and darker.
    bool has_own_colours(const std::string& texture) const {
        return geometry_->of_points.rgb.empty() && !is_bark(texture);
    }

    std::vector<Rgb> colours_of_points() const {
        std::vector<Rgb> colours = colouring_->colours(*run_, *frame_, *geometry_, colour_range());
        if (is_line_drawing()) std::fill(colours.begin(), colours.end(), style_.background.is_dark() ? chalk : ink);
        return colours;
    }

    /// A flat curve without a colour of its own.
    bool is_line_drawing() const {
        return colouring_->is_natural() && is_flat() && geometry_->of_points.rgb.empty() && !here_.has_faces;
    }

    void add_ground(const SkyVisibility* visibility) {
        const auto disc = ground_disc();
        if (!disc) return;
        const auto ground =
            ground_actor(disc->middle, disc->radius, visibility, style_.background, shows_roots() ? clear_ground : 1);
        if (!renderer_->GetUseDepthPeeling()) ground->SetForceOpaque(true);
        others_.push_back(ground);
        renderer_->AddViewProp(ground);
    }

    /// Among what is seen through. The ground alone needs no order, which takes half of a picture's time: it is drawn
    /// after all else.
    bool shows_more_than_ground() const {
        const auto is_textured = [&](const Part& part) { return !texture_file(part.mesh).empty(); };
        return !style_.fields.empty() || here_.has_labels || run_->background() ||
               std::any_of(parts_.begin(), parts_.end(), is_textured);
    }

    /// None where nothing is shown.
    struct Disc {
        glm::dvec3 middle;
        double radius;
    };
    std::optional<Disc> ground_disc() const {
        const Box& box = survey_ && !survey_->box.empty() ? survey_->box : here_.box;
        if (box.empty()) return std::nullopt;
        const glm::dvec3 half = (box.upper - box.lower) / 2.0;
        return Disc{box.lower + half, 1.5 * std::max({half.x, half.z, 0.7 * half.y})};
    }

    void add_field_props() {
        const auto& ranges = survey_ && !survey_->field_ranges.empty() ? survey_->field_ranges : here_.field_ranges;
        const glm::dvec3 middle = here_.box.empty() ? glm::dvec3(0) : (here_.box.lower + here_.box.upper) / 2.0;
        std::map<std::string, std::size_t> hues;
        for (const FieldLook& look : style_.fields) {
            const std::size_t hue = hues.try_emplace(look.name, hues.size()).first->second;
            const auto colours = field_colours(hue, style_.background.is_dark());
            if (!frame_->fields.contains(look.name)) continue;
            const RecordedField field = run_->field(*frame_, look.name);
            const auto range = ranges.find(look.name);
            if (range == ranges.end()) continue;
            FieldProp made = field_prop(field, look, range->second, middle, colours);
            others_.push_back(made.prop);
            renderer_->AddViewProp(made.prop);
            legend_->legend.keys.push_back(std::move(made.key));
        }
    }

    /// What stands around the plants in the background scenes of their view files.
    void add_background_scene() {
        if (!background_scene_) background_scene_ = background_actor(*run_);
        if (!*background_scene_) return;
        others_.push_back(*background_scene_);
        renderer_->AddViewProp(others_.back());
    }

    void add_labels() {
        const double ink = style_.background.is_dark() ? 0.9 : 0.15;
        for (std::size_t cell = 0, label = 0; cell < geometry_->vertices.size(); ++cell) {
            if (geometry_->of_cells.kinds[geometry_->vertices.first + cell] != Kind::label) continue;
            if (label >= std::min(most_labels, geometry_->label_texts.size())) return;
            vtkNew<vtkBillboardTextActor3D> text;
            text->SetInput(geometry_->label_texts[label++].c_str());
            const glm::dvec3 at(geometry_->points[static_cast<std::size_t>(geometry_->vertices[cell].front())]);
            text->SetPosition(at.x, at.y, at.z);
            text->GetTextProperty()->SetColor(ink, ink, ink);
            text->GetTextProperty()->SetFontSize(18);
            others_.emplace_back(text);
            renderer_->AddViewProp(text);
        }
    }

    void write_legend() {
        Legend& legend = legend_->legend;
        const auto key = colouring_->key(*run_, *geometry_, colour_range());
        if (key) legend.keys.insert(legend.keys.begin(), *key);
        legend.shows_keys = style_.legend;
        legend.title = style_.title;
        if (style_.time_label) legend.time = time_text(*run_, *frame_);
        if (style_.time_beneath) legend.caption = time_text(*run_, *frame_);
        legend.dark = style_.background.is_dark();
        if (style_.scale_bar && view_) {
            legend.metres_per_pixel = 2 * view_->half_height / std::max(1, renderer_->GetSize()[1]);
        }
        legend_actor_->GetScene()->SetDirty(true);
    }

    void add_highlight(const Part& part) {
        const FrameAttributes& of = attributes(part.mesh);
        vtkNew<vtkCellArray> triangles;
        for (std::size_t i = 0; i < part.mesh.row_of_triangle.size(); ++i) {
            const std::size_t row = part.mesh.row_of_triangle[i];
            if (of.identities[row] != highlighted_->identity || of.plants[row] != highlighted_->plant) continue;
            const auto corners = corners_of(part.mesh).subspan(3 * i, 3);
            triangles->InsertNextCell({corners[0], corners[1], corners[2]});
        }
        if (triangles->GetNumberOfCells() == 0) return;
        vtkNew<vtkPolyData> data;
        data->SetPoints(part.mesh.data->GetPoints());
        data->SetPolys(triangles);
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(data);
        mapper->SetResolveCoincidentTopologyToPolygonOffset();
        mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(-4, -200);
        const auto actor = vtkSmartPointer<vtkActor>::New();
        actor->SetMapper(mapper);
        actor->PickableOff();
        actor->GetProperty()->SetColor(bright[0] / 255.0, bright[1] / 255.0, bright[2] / 255.0);
        actor->GetProperty()->LightingOff();
        renderer_->AddActor(actor);
        highlight_actors_.push_back(actor);
    }
};

Stage::Stage(const RecordedRun& run, PictureStyle style) : body_(std::make_unique<Body>(run, std::move(style))) {}

Stage::~Stage() = default;

vtkRenderer& Stage::renderer() {
    return *body_->renderer_;
}

void Stage::use(const RecordedRun& run) {
    body_->run_ = &run;
}

void Stage::show(const RecordedFrame& frame) {
    body_->show(frame, body_->load(frame));
}

void Stage::show(const RecordedFrame& frame, std::shared_ptr<const FrameGeometry> geometry) {
    body_->show(frame, std::move(geometry));
}

void Stage::show_piece(const RecordedFrame& piece, const StageSurvey& whole, const SkyVisibility* visibility) {
    const Body::Whole all{whole, visibility};
    body_->show(piece, body_->load(piece), &all);
}

void Stage::add_occluders(SkyVisibility& visibility) const {
    visibility.add(body_->occluders());
}

const RecordedFrame* Stage::shown() const {
    return body_->frame_ ? &*body_->frame_ : nullptr;
}

const FrameGeometry& Stage::geometry() const {
    return *body_->geometry_;
}

StageSurvey Stage::survey(std::span<const RecordedFrame* const> frames) const {
    StageSurvey survey;
    for (const RecordedFrame* frame : frames) {
        for (RecordedFrame piece : frame->pieces()) {
            if (piece.plants != frame->plants) piece.fields.clear();  // the first has them
            body_->add_survey(piece, *body_->load(piece), survey);
        }
    }
    return survey;
}

StageSurvey Stage::survey(const RecordedFrame& frame, const FrameGeometry& geometry) const {
    StageSurvey survey;
    body_->add_survey(frame, geometry, survey);
    return survey;
}

void Stage::settle(const StageSurvey& survey) {
    body_->survey_ = survey;
}

const PictureStyle& Stage::style() const {
    return body_->style_;
}

void Stage::restyle(PictureStyle style) {
    body_->restyle(std::move(style));
}

void Stage::shade(bool shading) {
    body_->style_.shading = shading;
}

std::vector<std::string> Stage::colour_names() const {
    return Colouring::names(*body_->run_);
}

std::vector<LitPart> Stage::lit_parts() const {
    return body_->lit_parts();
}

std::optional<LitGround> Stage::lit_ground() const {
    return body_->lit_ground();
}

std::optional<LitGround> Stage::hiding_ground() const {
    return !body_->style_.light && body_->shows_roots() ? std::nullopt : lit_ground();
}

std::optional<Stage::LitRow> Stage::row_of_lit(std::size_t part, std::size_t triangle) const {
    if (part >= body_->parts_.size()) return std::nullopt;
    const StageMesh& mesh = body_->parts_[part].mesh;
    return LitRow{mesh.row_of_triangle[triangle], mesh.is_of_axes};
}

void Stage::clear_for_light(double grey) {
    body_->clear_for_light(grey);
}

const CameraView& Stage::view() const {
    if (!body_->view_) throw std::logic_error("the camera has not been placed");
    return *body_->view_;
}

const Legend& Stage::legend() const {
    return body_->legend_->legend;
}

bool Stage::is_flat() const {
    return body_->is_flat();
}

void Stage::place_camera(const CameraPlace& place, bool follow) {
    body_->place_camera(place, follow);
}

std::optional<StageModule> Stage::module_at(vtkProp* prop, vtkIdType cell) const {
    for (const Body::Part& part : body_->parts_) {
        if (part.actor != prop || cell < 0) continue;
        const auto triangle = static_cast<std::size_t>(cell);
        if (triangle < part.mesh.row_of_triangle.size()) return body_->module_of(part.mesh, triangle);
    }
    return std::nullopt;
}

std::vector<StageModule> Stage::places_of(std::uint32_t plant, std::uint64_t identity) const {
    std::vector<StageModule> places;
    for (const Body::Part& part : body_->parts_) {
        const FrameAttributes& of = body_->attributes(part.mesh);
        std::map<std::size_t, std::pair<glm::dvec3, int>> middles;
        for (std::size_t i = 0; i < part.mesh.row_of_triangle.size(); ++i) {
            const std::size_t row = part.mesh.row_of_triangle[i];
            if (of.identities[row] != identity || of.plants[row] != plant) continue;
            auto& [sum, count] = middles.try_emplace(row, glm::dvec3(0), 0).first->second;
            sum += body_->module_of(part.mesh, i).position;
            ++count;
        }
        for (const auto& [row, middle] : middles) {
            places.push_back({plant, identity, row, part.mesh.is_of_axes, middle.first / double(middle.second)});
        }
    }
    return places;
}

void Stage::highlight(std::optional<Highlight> module) {
    body_->highlighted_ = module;
    body_->show_highlight();
}

}  // namespace espalier::picture
