// A turtle symbol: what it is called, how many parameters it may have, what it does. One entry in a file of
// src/turtle/symbols/ is all a new symbol needs.
#pragma once

#include "espalier/turtle/interpretation.h"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace espalier {

/// The walk of one turtle along one string: what a symbol acts upon.
class Walk {
public:
    Walk(const Model& model, const ModuleString& string, const TurtleSettings& settings, std::uint32_t plant,
         Interpretation& result);

    const TurtleSettings& settings;
    TurtleState turtle;
    std::vector<double> elasticities;  ///< one per tropism
    bool stopped = false;              ///< nothing that follows is drawn

    /// Moves by distance * scale along the heading, after the tropisms have acted on it.
    void move(double distance, bool draws, bool records_vertex);
    /// Moves elsewhere; the next internode begins a new axis.
    void jump(const glm::dvec3& position);
    /// The first parameter as an angle in degrees, or the model's angle if there is none.
    Rotation rotation(std::span<const double> parameters);

    void push();
    void pop();

    void set_width(double width);
    void set_scale(double scale);
    /// The elasticity of a tropism counted from 1; null if there is no such tropism.
    double* elasticity(double id);

    /// Opens a polygon; a group of vertices that is not `filled` collects them and draws nothing.
    void open_polygon(bool filled);
    void close_polygon();
    void record_vertex();

    /// Puts a disc, sphere or circle at `pose`; `diameter` in metres, the scale already in it.
    void place(Organ::Shape shape, const Pose& pose, double diameter);
    /// Draws the surface of this id, stretched along left, heading and up, and moves to its end point.
    void place_surface(std::uint32_t id, const glm::dvec3& factors);

    /// Begins a generalized cylinder here. `strips`: between control points that do not say.
    void begin_cylinder(GeneralizedCylinder::Curve curve, std::optional<double> strips);
    /// A control point of the open cylinder, `strips` from the one before. In a branch the first begins a cylinder of
    /// its own, from the last control point of the axis that bears the branch.
    void control_point(std::optional<double> strips);
    void end_cylinder(std::optional<double> strips);
    bool in_cylinder_braces() const { return !open_polygons_.empty() && !open_polygons_.back().filled; }

    /// Patches whose control points are positions of the turtle, by number.
    void begin_patch(double id, BicubicPatch::Basis basis);
    void patch_point(double id, double row, double column);
    void draw_patch(double id, double rows, double columns);

    /// The first value is the number of a text, printf's format for the others.
    void write_label(std::span<const double> values);

    /// Scales lengths and widths until the sub-L-system is left.
    void enter_system(double scale);
    void leave_system();

    const Brush& brush() const { return brushes_[turtle.brush]; }
    /// Changes the brush from here on, until the end of the branch.
    template <class Change>
    void change_brush(Change change) {
        Brush brush = brushes_[turtle.brush];
        change(brush);
        turtle.brush = std::uint32_t(brushes_.size());
        brushes_.push_back(brush);
    }

    /// Draws what the string left open.
    void finish();

    /// Sends the current module's parameters; does nothing inside a picture, whose answers nobody could read.
    void ask(QueryKind kind);

    /// The symbol of the current module, one code point or a declared name.
    const std::string& symbol() const;

    /// Throws RunError naming the module, the plant and the modules around it.
    [[noreturn]] void fail(const std::string& what) const;

private:
    friend class StringWalk;
    struct OpenPolygon {
        std::size_t first;
        std::uint32_t module;
        bool filled;
    };
    struct OpenCylinder {
        GeneralizedCylinder cylinder;
        int strips;
        bool last_is_marked;  ///< by a symbol of its own; the end of an F gives way to one in the same place
    };
    struct OpenPatch {
        BicubicPatch::Basis basis;
        glm::dvec3 origin;
        std::array<std::array<std::optional<glm::dvec3>, 5>, 5> points;  ///< counted from 0 or from 1
    };
    struct SystemScale {
        double scale, width;
    };
    struct KnownRotation {
        double degrees;
        Rotation rotation;
    };

    void begin_axis();
    void record_control_point(std::optional<double> strips, bool marked);
    void branch_cylinder();
    void draw_cylinder(std::int32_t number);
    void require_room() const;
    const Contour* contour() const;
    Look look() const;
    double radius(double width) const { return radius_of_width_ * width; }

    const Model& model_;
    const ModuleString& string_;
    PlantGeometry& geometry_;
    std::vector<Query>& queries_;
    const std::uint32_t plant_;
    const std::vector<std::int16_t>* processes_ = nullptr;  // by letter

    std::uint32_t module_ = 0;       // index in the plant's string of the module that is drawn
    std::size_t parameters_at_ = 0;  // where its parameters begin
    LetterId letter_ = no_letter;    // of the module that acts: module_'s own, or one of its picture
    bool in_picture_ = false;

    std::vector<TurtleState> stack_;
    std::vector<double> elasticity_stack_;
    std::vector<OpenPolygon> open_polygons_;
    std::vector<glm::dvec3> open_vertices_;
    std::vector<Brush> brushes_;
    std::vector<OpenCylinder> cylinders_;
    std::map<double, OpenPatch> patches_;
    std::vector<SystemScale> systems_;
    const double radius_of_width_;
    const Rotation default_rotation_;
    const glm::dvec3 older_tropism_;
    std::array<KnownRotation, 16> known_rotations_;  // angles repeat; sines are dear
};

using SymbolAction = void (*)(Walk& walk, std::span<const double> parameters);

/// Defining one registers it. `name` is what stands in the string ("F", "@o", "+"); its characters are modules of their
/// own, of which only the last may have parameters. A final `*` stands for any character ("~*"). `arities` are the
/// numbers of parameters it acts on, any if empty; with other numbers it is skipped.
struct Symbol {
    Symbol(std::string name, std::vector<int> arities, std::string help, SymbolAction action);
    Symbol(const Symbol&) = delete;
    Symbol& operator=(const Symbol&) = delete;

    bool accepts(int arity) const;

    std::string name;
    std::vector<int> arities;
    std::string help;
    SymbolAction action;
};

/// Every registered symbol, by name, with its help: what `espalier list symbols` prints.
const std::map<std::string, const Symbol*>& symbols();

}  // namespace espalier
