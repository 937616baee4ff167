// What symbols do to a walk: move, branch, draw, ask.
#include "espalier/turtle/walk.h"

#include "base/text.h"
#include "geometry/drawn/bounds.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <cstring>
#include <tuple>
#include <utility>

namespace espalier::turtle {
namespace {

bool finite(const glm::dvec3& vector) {
    return std::isfinite(vector.x + vector.y + vector.z);
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

template <class Vectors>
bool same_bits(const Vectors& a, const Vectors& b) {
    return std::memcmp(&a, &b, sizeof(Vectors)) == 0;
}

bool same(const TurtleState& a, const TurtleState& b) {
    const auto numbers = [](const TurtleState& t) { return std::array{t.width, t.scale, t.node_radius, t.elasticity}; };
    const auto integers = [](const TurtleState& t) {
        return std::tuple(t.colour, t.back_colour, t.order, t.on_axis, t.branches_off, t.has_width, t.texture, t.brush,
                          t.systems, t.cylinder);
    };
    const auto first = numbers(a), second = numbers(b);
    return integers(a) == integers(b) && same_bits(a.pose, b.pose) && same_bits(first, second);
}

}  // namespace

void TurtleStack::make_room() {
    const std::size_t at = depth();
    states_.resize(std::max<std::size_t>(16, states_.size() * 2));
    stand_at(at);
}

void WalkState::clear() {
    turtles.clear();
    elasticities.clear();
    stopped = false;
    elasticity_stack.clear();
    drawn_frame = {};
    frame_stack.clear();
    systems.clear();
    brushes.clear();
    polygons.clear();
    cylinders.clear();
    patches.clear();
    nets.clear();
    deformations.clear();
    is_deformed = false;
}

bool WalkState::is_between_drawings() const {
    return !stopped && brushes.size() == 1 && polygons.empty() && cylinders.empty() && patches.empty() &&
           nets.empty() && deformations.empty() && !is_deformed;
}

bool WalkState::stands_like(const WalkState& other) const {
    const auto same_scale = [](const SystemScale& a, const SystemScale& b) {
        return std::array{a.scale, a.width} == std::array{b.scale, b.width} && a.has_width == b.has_width;
    };
    return same(elasticities, other.elasticities) && same(elasticity_stack, other.elasticity_stack) &&
           same_bits(drawn_frame, other.drawn_frame) &&
           std::equal(frame_stack.begin(), frame_stack.end(), other.frame_stack.begin(), other.frame_stack.end(),
                      same_bits<DrawnFrame>) &&
           std::equal(turtles.begin(), turtles.end(), other.turtles.begin(), other.turtles.end(),
                      [](const TurtleState& a, const TurtleState& b) { return same(a, b); }) &&
           std::equal(systems.begin(), systems.end(), other.systems.begin(), other.systems.end(), same_scale);
}

void Walk::begin(const Model& model, const ModuleString& string, const TurtleSettings& settings, std::uint32_t plant,
                 Interpretation& result, const Room* room) {
    WalkState::clear();
    model_ = &model;
    string_ = &string;
    settings_ = &settings;
    geometry_ = &result.geometry;
    directions_ = &result.directions;
    plant_ = plant;
    acting_ = {};
    if (room) {
        internodes_.open(room->internodes);
        queries_.open(room->queries);
        answers_.open(room->answers);
    } else {
        internodes_.open(result.geometry.internodes);
        queries_.open(result.queries);
        answers_.open(result.answers);
    }
    radius_of_width_ = settings.line_style == LineStyle::pixel ? 0 : 0.5;
    rotations_.set_default(settings.angle);
    TurtleState& turtle = turtles.top();
    turtle.pose = settings.pose;
    turtle.width = settings.line_width.value_or(1);
    turtle.has_width = settings.line_width.has_value();
    turtle.scale = settings.scale;
    turtle.colour = settings.colour;
    turtle.back_colour = settings.back_colour.value_or(-1);
    turtle.elasticity = settings.initial_elasticity;
    for (const Tropism& tropism : settings.tropisms) elasticities.push_back(tropism.elasticity);
    is_as_cpfg_ = model.arithmetic == Arithmetic::cpfg;
    pushes_more_ = !elasticities.empty() || is_as_cpfg_;
    keep_frame();
    Brush& brush = brushes.emplace_back();
    brush.sides = std::max(settings.contour_sides, 3);
    brush.follows_roll = settings.twist_of_cylinders;
    // Plants share their shapes, and threads would wait for each other to count them.
    if (geometry_->shapes != settings.shapes) geometry_->shapes = settings.shapes;
    geometry_->in_pixels = settings.line_style == LineStyle::pixel;
}

void Walk::end() {
    internodes_.close();
    queries_.close();
    answers_.close();
    if (is_deformed) geometry_->bounds = drawn_bounds(*geometry_);
}

void Walk::move(double distance, bool draws, bool records_vertex) {
    TurtleState& turtle = turtles.top();
    if (!elasticities.empty()) {
        const bool bent = bend_by_tropisms(turtle.pose, settings_->tropisms, elasticities);
        if (bent) lose_rolls();
        roll_by_torques(turtle.pose, settings_->tropisms, elasticities);
    }
    const glm::dvec3 base = turtle.pose.position;
    turtle.pose.position += turtle.pose.heading * (distance * turtle.scale);
    if (turtle.elasticity != 0) {
        apply_older_tropism(turtle.pose, glm::normalize(settings_->tropism_direction), turtle.elasticity);
    }
    if (!finite(turtle.pose.position)) fail("the turtle's position is not a number any more");
    if (records_vertex) polygons.end_step(*this);
    if (turtle.cylinder >= 0 && draws && records_vertex) cylinders.end_step(*this);
    if (!draws) {
        turtle.on_axis = false;
        return;
    }
    draw_segment(turtle, base, turtle.pose.position, geometry_->bounds);
    if (turtle.texture != 0) {
        geometry_->textures.resize(internodes_.size());
        geometry_->textures.back() = turtle.texture;
    }
}

void Walk::jump(const glm::dvec3& position) {
    turtle().pose.position = position;
    turtle().on_axis = false;
    if (!finite(position)) fail("the turtle's position is not a number");
}

void Walk::set_heading(glm::dvec3 heading) {
    Pose& pose = turtle().pose;
    if (is_as_cpfg_) {
        pose.heading = drawn_frame.heading;
        pose.left = drawn_frame.left;
        pose.up = glm::cross(pose.left, pose.heading);
    }
    head_towards(pose, heading);
}

void Walk::set_scale(double scale) {
    if (!std::isfinite(scale)) fail("the turtle's scale is not a number");
    turtle().scale = scale;
}

const Rotation& KnownRotations::learn(Known& known, double degrees) {
    known = {degrees, rotation_of_degrees(degrees)};
    return known.rotation;
}

void Walk::push_more() {
    if (is_as_cpfg_) frame_stack.push_back(drawn_frame);
    elasticity_stack.insert(elasticity_stack.end(), elasticities.begin(), elasticities.end());
}

void Walk::pop_more() {
    if (is_as_cpfg_) {
        drawn_frame = frame_stack.back();
        frame_stack.pop_back();
    }
    const auto first = elasticity_stack.end() - std::ptrdiff_t(elasticities.size());
    std::copy(first, elasticity_stack.end(), elasticities.begin());
    elasticity_stack.erase(first, elasticity_stack.end());
}

double* Walk::elasticity(double id) {
    return id >= 1 && id < double(elasticities.size()) + 1 ? &elasticities[std::size_t(id) - 1] : nullptr;
}

void Walk::place(Organ::Shape shape, const Pose& pose, double diameter) {
    if (!std::isfinite(diameter)) fail("the size of an organ is not a number");
    add_organ({acting_.module, shape, turtle().order, std::uint16_t(turtle().colour), 0, pose, glm::dvec3(diameter),
               look(), std::uint16_t(brush().sides)});
    add_ball(pose.position, std::abs(diameter) / 2, geometry_->bounds);
}

void Walk::add_organ(const Organ& organ) {
    std::vector<Organ>& organs = geometry_->organs;
    if (organs.size() == organs.capacity()) organs.reserve(room_after(organs.size()));
    organs.push_back(organ);
}

Look Walk::look() const {
    return {std::uint16_t(turtle().back_colour < 0 ? turtle().colour : turtle().back_colour), turtle().texture};
}

void Walk::require_room() const {
    constexpr std::size_t most_vertices = std::size_t{1} << 27;
    if (geometry_->mesh.vertices.size() > most_vertices)
        fail("the plant's surfaces have more than 134 million vertices");
}

void Walk::finish() {
    cylinders.draw_all(*this);
    while (!nets.empty()) nets.draw(*this);
    while (!deformations.empty()) end_deformation();
}

void Walk::enter_system(double scale) {
    const bool has_width = turtle().has_width;
    systems.push_back({turtle().scale, turtle().width, has_width});
    turtle().systems = std::uint32_t(systems.size());
    set_scale(turtle().scale * scale);
    set_width(turtle().width * scale);
    turtle().has_width = has_width;
}

void Walk::leave_system() {
    if (systems.empty()) return;
    turtle().scale = systems.back().scale;
    turtle().width = systems.back().width;
    turtle().has_width = systems.back().has_width;
    systems.pop_back();
    turtle().systems = std::uint32_t(systems.size());
}

void Walk::ask() {
    const std::size_t arity = model_->alphabet.arity(acting_.letter);
    if (acting_.in_picture || arity == 0) return;
    const std::size_t next = std::size_t(acting_.module) + 1;
    const bool last = next >= string_->size(), known = string_->has_lineage();
    const double* const values = string_->parameters.data() + acting_.parameters_at;
    Query& query = queries_.add();  // unwritten: every member is set
    query.process = processes_ ? (*processes_)[acting_.letter] : std::int16_t(-1);
    query.following = last ? no_letter : string_->letters[next];
    query.plant = plant_;
    query.module = acting_.module;
    query.parameters_at = acting_.parameters_at;
    query.parameters = {values, arity};
    query.following_parameters = {};
    if (!last) query.following_parameters = {values + arity, std::size_t(model_->alphabet.arity(query.following))};
    query.identity = known ? string_->identity(acting_.module) : 0;
    query.following_identity = known && !last ? string_->identity(next) : 0;
    query.pose = turtle().pose;
    query.width = turtle().width;
    query.scale = turtle().scale;
}

void Walk::answer_with(const std::array<double, 4>& values, std::size_t count) {
    if (acting_.in_picture) return;
    answer(0);
    directions_->push_back({acting_.parameters_at, count, values});
}

void Walk::ignore(Ignored what) const {
    const auto bit = static_cast<unsigned>(what);
    if (ignored_ && !(ignored_->load(std::memory_order_relaxed) & bit)) ignored_->fetch_or(bit);
}

const std::string& Walk::symbol() const {
    return model_->alphabet.name(acting_.letter);
}

void Walk::fail(const char* what) const {
    fail(std::string(what));
}

void Walk::fail(const std::string& what) const {
    constexpr std::size_t before = 12, after = 4;
    const std::size_t first = acting_.module > before ? acting_.module - before : 0;
    const std::size_t last = std::min(string_->size(), std::size_t(acting_.module) + after);
    std::size_t at = acting_.parameters_at;
    for (std::size_t i = first; i < acting_.module; ++i) at -= std::size_t(model_->alphabet.arity(string_->letters[i]));
    ModuleString context;
    for (std::size_t i = first; i < last; ++i) {
        const auto arity = std::size_t(model_->alphabet.arity(string_->letters[i]));
        context.append(string_->letters[i], {string_->parameters.data() + at, arity});
        at += arity;
    }
    throw RunError(fmt::format("{}: {}, at module {} of plant {}{}: {}{}{}", model_->name, what, acting_.module, plant_,
                               acting_.in_picture ? " (in its picture)" : "", first > 0 ? "..." : "",
                               to_text(context, model_->alphabet), last < string_->size() ? "..." : ""));
}

}  // namespace espalier::turtle
