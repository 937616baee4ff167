// What symbols do to a walk: move, branch, draw, ask.
#include "espalier/base/text.h"
#include "espalier/turtle/symbol.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace espalier {
namespace {

/// cpfg's smallest line width.
constexpr double thinnest = 1e-7;

Rotation rotation_of_degrees(double degrees) {
    return Rotation(degrees * (std::numbers::pi / 180));
}

void add_ball(Box& bounds, const glm::dvec3& centre, double radius) {
    bounds.lower = glm::min(bounds.lower, centre - radius);
    bounds.upper = glm::max(bounds.upper, centre + radius);
}

bool finite(const glm::dvec3& vector) {
    return std::isfinite(vector.x + vector.y + vector.z);
}

}  // namespace

Walk::Walk(const Model& model, const ModuleString& string, const TurtleSettings& settings_, std::uint32_t plant,
           Interpretation& result)
    : settings(settings_),
      model_(model),
      string_(string),
      geometry_(result.geometry),
      queries_(result.queries),
      plant_(plant),
      radius_of_width_(settings_.line_style == LineStyle::pixel ? 0 : 0.5),
      default_rotation_(settings_.angle),
      older_tropism_(glm::normalize(settings_.tropism_direction)) {
    turtle.pose = settings.pose;
    turtle.width = turtle.node_width = settings.line_width;
    turtle.scale = settings.scale;
    turtle.colour = settings.colour;
    turtle.back_colour = settings.back_colour.value_or(-1);
    turtle.elasticity = settings.initial_elasticity;
    for (const Tropism& tropism : settings.tropisms) elasticities.push_back(tropism.elasticity);
    known_rotations_.fill({0, Rotation()});
    Brush brush;
    brush.sides = std::max(settings.contour_sides, 3);
    brush.follows_roll = settings.twist_of_cylinders;
    brushes_.push_back(brush);
    geometry_.shapes = settings.shapes;
}

void Walk::move(double distance, bool draws, bool records_vertex) {
    if (!elasticities.empty()) apply_tropisms(turtle.pose, settings.tropisms, elasticities);
    const glm::dvec3 base = turtle.pose.position;
    turtle.pose.position += turtle.pose.heading * (distance * turtle.scale);
    if (turtle.elasticity != 0) apply_older_tropism(turtle.pose, older_tropism_, turtle.elasticity);
    if (!finite(turtle.pose.position)) fail("the turtle's position is not a number any more");
    if (records_vertex) record_vertex();
    if (turtle.cylinder >= 0 && draws && records_vertex) record_control_point({}, false);
    if (!draws) {
        turtle.on_axis = false;
        return;
    }
    if (!turtle.on_axis) begin_axis();
    if (!settings.tapered_lines) turtle.node_width = turtle.width;
    const double base_radius = radius(turtle.node_width), tip_radius = radius(turtle.width);
    geometry_.internodes.push_back({module_, turtle.axis, turtle.order, std::uint16_t(turtle.colour), base,
                                    turtle.pose.position, base_radius, tip_radius});
    turtle.node_width = turtle.width;
    if (turtle.texture != 0) {
        geometry_.textures.resize(geometry_.internodes.size());
        geometry_.textures.back() = turtle.texture;
    }
    add_ball(geometry_.bounds, base, base_radius);
    add_ball(geometry_.bounds, turtle.pose.position, tip_radius);
}

void Walk::jump(const glm::dvec3& position) {
    turtle.pose.position = position;
    turtle.on_axis = false;
    if (!finite(position)) fail("the turtle's position is not a number");
}

void Walk::begin_axis() {
    turtle.axis = geometry_.axes++;
    turtle.on_axis = true;
    turtle.node_width = turtle.width;
}

Rotation Walk::rotation(std::span<const double> parameters) {
    if (parameters.empty()) return default_rotation_;
    const double degrees = parameters[0];
    const std::uint64_t bits = std::bit_cast<std::uint64_t>(degrees);
    KnownRotation& known = known_rotations_[(bits * 0x9E3779B97F4A7C15u) >> 60];
    if (known.degrees != degrees) known = {degrees, rotation_of_degrees(degrees)};
    return known.rotation;
}

void Walk::push() {
    stack_.push_back(turtle);
    elasticity_stack_.insert(elasticity_stack_.end(), elasticities.begin(), elasticities.end());
    turtle.on_axis = false;
    turtle.branches_off = true;
    if (turtle.order < std::numeric_limits<std::uint16_t>::max()) ++turtle.order;
}

void Walk::pop() {
    // Strings of old models may end more branches than they began; `check` warns of the productions.
    if (stack_.empty()) return;
    turtle = stack_.back();
    stack_.pop_back();
    if (systems_.size() > turtle.systems) systems_.resize(turtle.systems);
    const auto first = elasticity_stack_.end() - std::ptrdiff_t(elasticities.size());
    std::copy(first, elasticity_stack_.end(), elasticities.begin());
    elasticity_stack_.erase(first, elasticity_stack_.end());
}

void Walk::set_width(double width) {
    if (!std::isfinite(width)) fail("the line width is not a number");
    turtle.width = std::max(width, thinnest);
}

void Walk::set_scale(double scale) {
    if (!std::isfinite(scale)) fail("the turtle's scale is not a number");
    turtle.scale = scale;
}

double* Walk::elasticity(double id) {
    return id >= 1 && id < double(elasticities.size()) + 1 ? &elasticities[std::size_t(id) - 1] : nullptr;
}

void Walk::open_polygon(bool filled) {
    open_polygons_.push_back({open_vertices_.size(), module_, filled});
}

void Walk::close_polygon() {
    // A cut may have taken the `{` away: then there is nothing to fill.
    if (open_polygons_.empty()) return;
    const OpenPolygon polygon = open_polygons_.back();
    open_polygons_.pop_back();
    const std::size_t count = open_vertices_.size() - polygon.first;
    if (polygon.filled && count >= 3) {
        geometry_.polygons.push_back({polygon.module, std::uint32_t(geometry_.vertices.size()), std::uint32_t(count),
                                      turtle.order, std::uint16_t(turtle.colour), look()});
        for (std::size_t i = polygon.first; i < open_vertices_.size(); ++i) {
            geometry_.vertices.push_back(open_vertices_[i]);
            geometry_.bounds.add(open_vertices_[i]);
        }
    }
    open_vertices_.resize(polygon.first);
}

void Walk::record_vertex() {
    if (!open_polygons_.empty()) open_vertices_.push_back(turtle.pose.position);
}

void Walk::place(Organ::Shape shape, const Pose& pose, double diameter) {
    if (!std::isfinite(diameter)) fail("the size of an organ is not a number");
    geometry_.organs.push_back({module_, shape, turtle.order, std::uint16_t(turtle.colour), 0, pose,
                                glm::dvec3(diameter), look(), std::uint16_t(brush().sides)});
    add_ball(geometry_.bounds, pose.position, std::abs(diameter) / 2);
}

Look Walk::look() const {
    return {std::uint16_t(turtle.back_colour < 0 ? turtle.colour : turtle.back_colour), turtle.texture};
}

void Walk::enter_system(double scale) {
    systems_.push_back({turtle.scale, turtle.width});
    turtle.systems = std::uint32_t(systems_.size());
    set_scale(turtle.scale * scale);
    set_width(turtle.width * scale);
}

void Walk::leave_system() {
    if (systems_.empty()) return;
    turtle.scale = systems_.back().scale;
    turtle.width = systems_.back().width;
    systems_.pop_back();
    turtle.systems = std::uint32_t(systems_.size());
}

void Walk::ask(QueryKind kind) {
    const std::size_t arity = model_.alphabet.arity(letter_);
    if (in_picture_ || arity == 0) return;
    const std::size_t next = std::size_t(module_) + 1;
    Query& query = queries_.emplace_back();
    query.kind = kind;
    if (kind == QueryKind::communication && processes_) query.process = (*processes_)[letter_];
    query.plant = plant_;
    query.module = module_;
    query.parameters_at = parameters_at_;
    query.parameters = {string_.parameters.data() + parameters_at_, arity};
    if (next < string_.size()) {
        query.following = string_.letters[next];
        query.following_parameters = {query.parameters.data() + arity,
                                      std::size_t(model_.alphabet.arity(query.following))};
    }
    if (string_.has_lineage()) {
        query.identity = string_.identities[module_];
        if (next < string_.size()) query.following_identity = string_.identities[next];
    }
    query.pose = turtle.pose;
    query.width = turtle.width;
    query.scale = turtle.scale;
}

const std::string& Walk::symbol() const {
    return model_.alphabet.name(letter_);
}

void Walk::fail(const std::string& what) const {
    constexpr std::size_t before = 12, after = 4;
    const std::size_t first = module_ > before ? module_ - before : 0;
    const std::size_t last = std::min(string_.size(), std::size_t(module_) + after);
    std::size_t at = parameters_at_;
    for (std::size_t i = first; i < module_; ++i) at -= std::size_t(model_.alphabet.arity(string_.letters[i]));
    ModuleString context;
    for (std::size_t i = first; i < last; ++i) {
        const auto arity = std::size_t(model_.alphabet.arity(string_.letters[i]));
        context.append(string_.letters[i], {string_.parameters.data() + at, arity});
        at += arity;
    }
    throw RunError(fmt::format("{}: {}, at module {} of plant {}{}: {}{}{}", model_.name, what, module_, plant_,
                               in_picture_ ? " (in its picture)" : "", first > 0 ? "..." : "",
                               to_text(context, model_.alphabet), last < string_.size() ? "..." : ""));
}

}  // namespace espalier
