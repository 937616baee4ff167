// The walk of one turtle along one string: what a symbol acts upon.
#pragma once

#include "espalier/base/stations.h"
#include "espalier/geometry/free_form.h"
#include "espalier/turtle/interpretation.h"
#include "espalier/turtle/open_drawings.h"
#include "espalier/turtle/row_writer.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace espalier::turtle {

/// Turtles at the open branches and, last, the one that walks: `[` copies it, `]` goes back to the one below.
class TurtleStack {
public:
    TurtleStack() : states_(1) { stand_at(0); }
    TurtleStack(const TurtleStack& other) : states_(other.begin(), other.end()) { stand_at(other.depth()); }
    TurtleStack& operator=(const TurtleStack& other) {
        states_.assign(other.begin(), other.end());
        stand_at(other.depth());
        return *this;
    }
    TurtleStack(TurtleStack&&) noexcept = default;  // what was moved from can be assigned to and destroyed
    TurtleStack& operator=(TurtleStack&&) noexcept = default;

    TurtleState& top() { return *top_; }
    const TurtleState& top() const { return *top_; }
    /// Open branches.
    std::size_t depth() const { return std::size_t(top_ - states_.data()); }
    const TurtleState* begin() const { return states_.data(); }
    const TurtleState* end() const { return top_ + 1; }

    /// Begins a branch.
    void push() {
        if (top_ == last_) make_room();
        branch(top_[0], top_[1]);
        ++top_;
    }
    /// The same for a turtle that walks elsewhere: leaves unwritten where it is, how it stands and how wide it draws.
    void push_rest() {
        if (top_ == last_) make_room();
        copy_rest(top_[0], top_[1]);
        ++top_;
    }
    /// Requires an open branch.
    void pop() { --top_; }
    /// The order of a branch of an axis of this order.
    static std::uint16_t deeper(std::uint16_t order) {
        return std::uint16_t(order + (order < std::numeric_limits<std::uint16_t>::max()));
    }
    /// One turtle as it was made; keeps the memory.
    void clear() {
        stand_at(0);
        *top_ = TurtleState();
    }

private:
    static void branch(const TurtleState& from, TurtleState& to);
    static void copy_rest(const TurtleState& from, TurtleState& to);
    void make_room();
    void stand_at(std::size_t depth) {
        top_ = states_.data() + depth;
        last_ = states_.data() + states_.size() - 1;
    }

    std::vector<TurtleState> states_;
    TurtleState *top_, *last_;
};

/// What a walk carries from one module to the next.
struct WalkState {
    struct OpenDeformation {
        FreeForm form;
        std::size_t internodes;  ///< drawn before it
        DrawnSoFar others;
    };
    struct SystemScale {
        double scale, width;
        bool has_width;
    };
    struct DrawnFrame {
        glm::dvec3 heading{0, 1, 0}, left{-1, 0, 0};
    };

    TurtleStack turtles;
    std::vector<double> elasticities;  ///< one per tropism
    bool stopped = false;              ///< nothing that follows is drawn
    std::vector<double> elasticity_stack;
    DrawnFrame drawn_frame;  ///< at the last drawn segment or @Tf, in a model with cpfg's arithmetic
    std::vector<DrawnFrame> frame_stack;
    std::vector<SystemScale> systems;  ///< entered sub-L-systems
    std::vector<Brush> brushes;
    OpenPolygons polygons;
    OpenCylinders cylinders;
    OpenPatches patches;
    OpenNets nets;
    std::vector<OpenDeformation> deformations;
    bool is_deformed = false;  ///< something drawn was moved, so its bounds are others

    /// Forgets everything, keeps the memory.
    void clear();
    /// True if nothing is half drawn and no brush was changed: what follows depends on turtles, scales and
    /// elasticities alone.
    bool is_between_drawings() const;
    /// Compares turtles, scales and elasticities, to the last bit, but not how axes are numbered.
    bool stands_like(const WalkState& other) const;
};

/// What a symbol says and the turtle cannot use.
enum class Ignored : unsigned { up_vector = 1, tropism = 2 };

/// Rotations by angles in degrees. Angles repeat, and sines are dear.
class KnownRotations {
public:
    /// Of what gives no angle.
    void set_default(double radians) {
        if (radians == default_angle_) return;
        default_angle_ = radians;
        default_rotation_ = Rotation(radians);
    }
    Rotation by_default() const { return default_rotation_; }
    Rotation of(double degrees) {
        const std::uint64_t bits = std::bit_cast<std::uint64_t>(degrees);
        Known& known = known_[(bits * 0x9E3779B97F4A7C15u) >> (64 - known_bits)];
        return known.degrees == degrees ? known.rotation : learn(known, degrees);
    }

private:
    struct Known {
        double degrees = 0;
        Rotation rotation;
    };
    static const Rotation& learn(Known& known, double degrees);

    double default_angle_ = 0;  // radians
    Rotation default_rotation_;
    static constexpr int known_bits = 6;  // few angles that a model uses in turn share a place
    std::array<Known, 1 << known_bits> known_;
};

class Walk : private WalkState {
public:
    /// A stretch of a column for each kind of row that was counted before.
    struct Room {
        std::span<Internode> internodes;
        std::span<Query> queries;
        std::span<TurtleAnswer> answers;
    };

    Walk() = default;
    Walk(const Walk&) = delete;
    Walk& operator=(const Walk&) = delete;

    /// As a turtle begins, into an empty result; with `room`, rows that were counted go there instead.
    void begin(const Model& model, const ModuleString& string, const TurtleSettings& settings, std::uint32_t plant,
               Interpretation& result, const Room* room = nullptr);
    /// Leaves the result as it is; the walk may start again.
    void end();

    const TurtleSettings& settings() const { return *settings_; }
    /// What vector fields read; null if there is nothing.
    const FieldValues* fields() const { return fields_; }
    using WalkState::cylinders;
    using WalkState::elasticities;
    using WalkState::nets;
    using WalkState::patches;
    using WalkState::polygons;
    using WalkState::stopped;
    TurtleState& turtle() { return turtles.top(); }
    const TurtleState& turtle() const { return turtles.top(); }

    /// Moves by distance * scale along the heading, after the tropisms have acted on it.
    void move(double distance, bool draws, bool records_vertex);
    /// Moves elsewhere; the next internode begins a new axis.
    void jump(const glm::dvec3& position);
    /// Turns the heading there with the least twist; a zero vector means straight up.
    void set_heading(glm::dvec3 heading);
    /// In cpfg up follows, where a tropism, @R or @Tp turns the heading, from the frame at the last drawn segment or
    /// @Tf: rolls since then are lost. Such a frame is this one.
    void keep_frame() { keep_frame(turtle().pose); }
    /// Loses them, in a model with cpfg's arithmetic.
    void lose_rolls() {
        if (is_as_cpfg_) set_heading(turtle().pose.heading);
    }
    /// The first parameter as an angle in degrees, or the model's angle if there is none.
    Rotation rotation(std::span<const double> parameters);

    void push();
    void pop();

    void set_width(double width);
    void set_scale(double scale);
    /// The elasticity of a tropism counted from 1; null if there is no such tropism.
    double* elasticity(double id);

    /// Puts a disc, sphere or circle at `pose`; `diameter` in metres, the scale already in it.
    void place(Organ::Shape shape, const Pose& pose, double diameter);
    /// Draws the surface of this id, stretched along left, heading and up, and moves to its end point.
    void place_surface(std::uint32_t id, const glm::dvec3& factors);

    /// What is drawn until the deformation ends is moved then. The turtle itself goes on undisturbed.
    void begin_deformation(FreeForm form);
    void end_deformation();

    /// A text of the model by its number; null if there is none.
    const std::string* text(double number) const;
    /// The first value is the number of a text, printf's format for the others.
    void write_label(std::span<const double> values);

    /// Scales lengths and widths until the sub-L-system is left.
    void enter_system(double scale);
    void leave_system();

    /// What the current module draws on, its place in the plant's string, and how it looks.
    PlantGeometry& geometry() const { return *geometry_; }
    std::uint32_t module() const { return acting_.module; }
    Look look() const;
    /// Throws RunError if the plant's surfaces are more than a timeline could hold: it ends here instead of in the
    /// memory of the machine.
    void require_room() const;

    const Brush& brush() const { return brushes[turtle().brush]; }
    /// Changes the brush from here on, until the end of the branch.
    template <class Change>
    void change_brush(Change change) {
        Brush brush = brushes[turtle().brush];
        change(brush);
        turtle().brush = std::uint32_t(brushes.size());
        brushes.push_back(brush);
    }

    /// Draws what the string left open.
    void finish();

    /// Sends the current module's parameters; does nothing inside a picture, whose answers are never read.
    void ask();
    /// Answers the first `count` of the current module's parameters with the position; nothing inside a picture.
    void answer(std::size_t count);
    /// The same with other values.
    void answer_with(const std::array<double, 4>& values, std::size_t count);

    /// The symbol of the current module, one code point or a declared name.
    const std::string& symbol() const;

    /// Notes what the current module says in vain: it is told once of each model.
    void ignore(Ignored what) const;

    /// Throws RunError naming the module, the plant and the modules around it.
    [[noreturn]] void fail(const std::string& what) const;
    [[noreturn]] void fail(const char* what) const;

private:
    friend class StringWalk;
    /// The module that acts, or in whose picture another does.
    struct Acting {
        std::uint32_t module = 0;       // its place in the plant's string
        std::size_t parameters_at = 0;  // where its parameters begin
        LetterId letter = no_letter;    // its own, or that of one of its picture
        bool in_picture = false;
    };

    void push_more();
    void pop_more();
    void pop_rest();
    void add_organ(const Organ& organ);
    void draw_segment(TurtleState& turtle, const glm::dvec3& base, const glm::dvec3& tip, Box& bounds);
    void keep_frame(const Pose& pose) { drawn_frame = {pose.heading, pose.left}; }
    static void add_ball(const glm::dvec3& centre, double radius, Box& bounds) {
        bounds.lower = glm::min(bounds.lower, centre - radius);
        bounds.upper = glm::max(bounds.upper, centre + radius);
    }

    const Model* model_ = nullptr;
    const ModuleString* string_ = nullptr;
    const TurtleSettings* settings_ = nullptr;
    PlantGeometry* geometry_ = nullptr;
    std::vector<TurtleDirection>* directions_ = nullptr;
    RowWriter<Column<Internode>> internodes_;
    RowWriter<QueryColumn> queries_;
    RowWriter<Column<TurtleAnswer>> answers_;
    std::uint32_t plant_ = 0;
    const FieldValues* fields_ = nullptr;
    const std::vector<std::int16_t>* processes_ = nullptr;  // by letter
    std::atomic<unsigned>* ignored_ = nullptr;              // bits of `Ignored`; null: nobody asks

    Acting acting_;

    static constexpr double thinnest_line = 1e-7;  // cpfg's
    double radius_of_width_ = 0.5;
    bool is_as_cpfg_ = false;
    bool pushes_more_ = false;  // than turtles
    KnownRotations rotations_;  // kept from walk to walk
};

// --- what the letters of every tree do ------------------------------------------------------------------------------

[[gnu::always_inline]] inline void Walk::draw_segment(TurtleState& turtle, const glm::dvec3& base,
                                                      const glm::dvec3& tip, Box& bounds) {
    const bool continues = turtle.on_axis && settings_->tapered_lines;
    const double tip_radius = turtle.has_width ? radius_of_width_ * turtle.width : 0;
    const double base_radius = continues ? turtle.node_radius : tip_radius;
    if (!turtle.on_axis) {
        turtle.axis = geometry_->axes++;
        turtle.on_axis = true;
    }
    turtle.node_radius = tip_radius;
    if (is_as_cpfg_) keep_frame(turtle.pose);
    Internode& row = internodes_.add();  // unwritten: every member is set
    row.module = acting_.module;
    row.axis = turtle.axis;
    row.order = turtle.order;
    row.colour = std::uint16_t(turtle.colour);
    row.pixels = tip_radius > 0 ? 0 : float(turtle.width);
    row.base = base;
    row.tip = tip;
    row.base_radius = base_radius;
    row.tip_radius = tip_radius;
    if (!continues) add_ball(base, base_radius, bounds);  // else it is the end of the segment before
    add_ball(tip, tip_radius, bounds);
}

inline Rotation Walk::rotation(std::span<const double> parameters) {
    return parameters.empty() ? rotations_.by_default() : rotations_.of(parameters[0]);
}

// Copied number by number and vector by vector, as they are read and written elsewhere: a load that spans two stores
// just made waits until both have reached the cache.
inline void copy_bits(const double& from, double& to) {
    std::memcpy(&to, &from, sizeof(double));
}

inline void copy_vector(const glm::dvec3& from, glm::dvec3& to) {
    std::memcpy(&to.x, &from.x, 2 * sizeof(double));
    copy_bits(from.z, to.z);
}

inline void TurtleStack::branch(const TurtleState& from, TurtleState& to) {
    copy_vector(from.pose.position, to.pose.position);
    copy_vector(from.pose.heading, to.pose.heading);
    copy_vector(from.pose.left, to.pose.left);
    copy_vector(from.pose.up, to.pose.up);
    to.width = from.width;
    to.axis = from.axis;
    to.has_width = from.has_width;
    to.order = deeper(from.order);
    to.on_axis = false;
    to.branches_off = true;
    to.node_radius = 0;
    copy_rest(from, to);
}

inline void TurtleStack::copy_rest(const TurtleState& from, TurtleState& to) {
    copy_bits(from.scale, to.scale);
    to.colour = from.colour;
    to.back_colour = from.back_colour;
    to.texture = from.texture;
    to.brush = from.brush;
    to.systems = from.systems;
    to.cylinder = from.cylinder;
    copy_bits(from.elasticity, to.elasticity);
}

inline void Walk::push() {
    turtles.push();
    if (pushes_more_) push_more();
}

inline void Walk::pop() {
    // Strings of old models may end more branches than they began; `check` warns of the productions.
    if (turtles.depth() == 0) return;
    turtles.pop();
    pop_rest();
}

inline void Walk::pop_rest() {
    if (!systems.empty() && systems.size() > turtle().systems) systems.resize(turtle().systems);
    if (pushes_more_) pop_more();
}

inline void Walk::answer(std::size_t count) {
    if (acting_.in_picture) return;
    TurtleAnswer& row = answers_.add();  // unwritten: every member is set
    row.module = acting_.module;
    row.count = std::uint32_t(count);
    row.parameters_at = acting_.parameters_at;
    row.position = turtle().pose.position;
    row.width = turtle().width;
}

inline void Walk::set_width(double width) {
    if (!std::isfinite(width)) fail("the line width is not a number");
    turtle().width = std::max(width, thinnest_line);
    turtle().has_width = true;
}

}  // namespace espalier::turtle
