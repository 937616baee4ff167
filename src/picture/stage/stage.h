// One recorded frame of a run as VTK actors in a renderer. Pictures, animations and the window are made of it.
#pragma once

#include "espalier/archive/recorded_run.h"
#include "espalier/geometry/plant_geometry.h"
#include "espalier/picture/picture_style.h"

#include "picture/light/lit_scene.h"
#include "picture/stage/camera_fit.h"

#include <vtkType.h>

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

class vtkProp;
class vtkRenderer;

namespace espalier::picture {

class SkyVisibility;
struct Legend;

/// What frames have in common, so that neither camera nor colours jump between them.
struct StageSurvey {
    Box box;                                     ///< box of the plants that are shown; empty where nothing is
    Outline outline;                             ///< outline of plants and fields
    std::optional<std::array<double, 2>> range;  ///< range of `colour_by`, if it is a number
    std::map<std::string, std::array<double, 2>> field_ranges;
    bool has_labels = false, has_faces = false;
    std::size_t drawn = 0, pale = 0;  ///< lines and faces whose colour is known, and those hardly seen on white
    /// A plant, and where it passes through the height 0.
    struct Stance {
        Box box, feet;
        glm::dvec3 origin{0};  ///< its first point
    };
    std::map<std::uint32_t, Stance> stances;

    /// True if a part worth mentioning lies below the height 0.
    bool grows_beneath() const;
    /// True if more lies there than the foot of a trunk: it is seen through the ground.
    bool has_roots_to_see() const;
    /// True if what lies there is below the feet of plants, as roots are, not something that the plane would cut
    /// through.
    bool is_rooted() const;
    /// A dark background shows more of the plants' own colours.
    bool wants_dark() const { return 2 * pale > drawn; }
};

/// Something of a frame that was pointed at.
struct StageModule {
    std::uint32_t plant = 0;
    std::uint64_t identity = 0;
    std::size_t row = 0;  ///< row of `of_points` (internodes) or `of_cells` (everything else)
    bool of_points = false;
    glm::dvec3 position{0};  ///< the middle of its cell
};

class Stage {
public:
    /// The run must outlive the stage or be replaced by `use`. Nothing is shown before `show`.
    /// Throws UserError if the style names an array or field that the run has not.
    Stage(const RecordedRun& run, PictureStyle style);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Belongs to the stage; add it to a window. Legend, title and bars are in it too.
    vtkRenderer& renderer();

    /// The same run opened again, with more frames.
    void use(const RecordedRun& run);
    /// Replaces what is shown. Throws UserError if files are damaged.
    void show(const RecordedFrame& frame);
    /// The same with plants that were read already, by another thread for instance.
    void show(const RecordedFrame& frame, std::shared_ptr<const FrameGeometry> geometry);
    /// One file of a frame that has several. `whole`: the survey of all of them; `visibility`: what reaches its plants
    /// past those of all, null: no shading.
    void show_piece(const RecordedFrame& piece, const StageSurvey& whole, const SkyVisibility* visibility);
    /// What is shown hides light from other pieces.
    void add_occluders(SkyVisibility& visibility) const;
    const RecordedFrame* shown() const;
    /// What is shown; empty before `show`.
    const FrameGeometry& geometry() const;

    /// Reads frames for what they have in common. Without `settle`, colours and `place_camera` fit the frame that is
    /// shown; after it, from the next `show` on, what was surveyed.
    StageSurvey survey(std::span<const RecordedFrame* const> frames) const;
    StageSurvey survey(const RecordedFrame& frame, const FrameGeometry& geometry) const;
    void settle(const StageSurvey& survey);

    const PictureStyle& style() const;
    /// Takes effect at once. Throws UserError as the constructor does, and keeps the old style then.
    void restyle(PictureStyle style);
    /// Shadows or none, from the next `show` on.
    void shade(bool shading);
    /// Everything `colour_by` may be for this run, "natural" first.
    std::vector<std::string> colour_names() const;

    /// What stands in the light of a style with `light`, and the ground under it, until something else is shown.
    std::vector<LitPart> lit_parts() const;
    std::optional<LitGround> lit_ground() const;
    /// The same where it hides what is below: roots are seen through the ground of a style without `light`.
    std::optional<LitGround> hiding_ground() const;
    /// The row behind a triangle of lit_parts(): of `of_points` or of `of_cells`. None: of the background scene.
    struct LitRow {
        std::size_t row;
        bool of_points;
    };
    std::optional<LitRow> row_of_lit(std::size_t part, std::size_t triangle) const;
    /// Paints all that such a picture shows in one grey, 0 to 1: the background, and behind fields the plants. Between
    /// 0 and 1, a pixel differs by the share of the picture that is seen through fields, labels and legend.
    void clear_for_light(double grey);
    /// From where `place_camera` looks.
    const CameraView& view() const;

    /// What is written on the picture of the frame that is shown.
    const Legend& legend() const;

    /// True if all there is lies in a plane across z: it is seen from the front, without perspective.
    bool is_flat() const;
    /// Looks at the surveyed box, or at what is shown where there is no survey or `follow` says so.
    void place_camera(const CameraPlace& place, bool follow = false);

    /// The module behind a cell of a prop that a picker found; none if it is a field, the ground or a legend.
    std::optional<StageModule> module_at(vtkProp* prop, vtkIdType cell) const;
    /// Where a module is in what is shown: all its rows.
    std::vector<StageModule> places_of(std::uint32_t plant, std::uint64_t identity) const;
    /// Draws one module brightly, in every frame, until another or none is asked for.
    struct Highlight {
        std::uint32_t plant;
        std::uint64_t identity;
    };
    void highlight(std::optional<Highlight> module);

private:
    class Body;
    std::unique_ptr<Body> body_;
};

}  // namespace espalier::picture
