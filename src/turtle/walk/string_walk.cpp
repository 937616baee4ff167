// The loops of every walk. Functions of their own, so that what they count stays in registers.
#include "turtle/walk/string_walk.h"

#include "espalier/base/stop.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace espalier::turtle {
namespace {

std::vector<std::unique_ptr<StringWalk>>& spare_walks() {
    thread_local std::vector<std::unique_ptr<StringWalk>> spare;
    return spare;
}

}  // namespace

PooledWalk::PooledWalk(const WalkInput& input, Interpretation& result, const Walk::Room* room) {
    std::vector<std::unique_ptr<StringWalk>>& spare = spare_walks();
    if (spare.empty()) {
        walk_ = std::make_unique<StringWalk>();
    } else {
        walk_ = std::move(spare.back());
        spare.pop_back();
    }
    walk_->begin(input, result, room);
}

PooledWalk::~PooledWalk() {
    walk_->end();
    spare_walks().push_back(std::move(walk_));
}

void StringWalk::begin(const WalkInput& input, Interpretation& result, const Walk::Room* room) {
    string_ = &input.string;
    symbols_ = &input.symbols;
    derivation_ = input.derivation;
    model_ = &input.model;
    offsets_.clear();
    walk_.begin(input.model, input.string, input.settings, input.plant, result, room);
    walk_.processes_ = &input.symbols.processes;
    walk_.ignored_ = &input.symbols.ignored;
    walk_.fields_ = input.fields;
}

void StringWalk::end() {
    constexpr std::size_t most_kept = std::size_t{1} << 20;  // entries
    walk_.end();
    if (offsets_.capacity() > most_kept) {
        offsets_ = {};
        links_ = {};
    }
    if (picture_.parameters.capacity() + picture_.letters.capacity() > most_kept) picture_ = {};
}

void StringWalk::run(std::size_t begin, std::size_t end, std::size_t at) {
    constexpr std::size_t between_looks = 8192;
    for (std::size_t here = begin; here < end && !walk_.stopped;) {
        end_if_asked();
        const std::size_t next = here + std::min(end - here, between_looks);
        here = derivation_ ? run_along<true>(here, next, at) : run_along<false>(here, next, at);
    }
}

/// Where the next letter stands that needs an action, among so many.
std::size_t StringWalk::next_action(std::size_t begin, std::size_t end) const {
    const LetterMeaning* const meanings = symbols_->levels[0].data();
    for (std::size_t i = begin; i < end; ++i) {
        const Symbol::Step step = meanings[string_->letters[i]].step;
        const bool moves = step == Symbol::Step::draw || step == Symbol::Step::skip;
        if (step == Symbol::Step::by_action || (moves && !draws_plainly())) return i;
    }
    return end;
}

template <bool with_pictures>
std::size_t StringWalk::run_along(std::size_t begin, std::size_t end, std::size_t& parameters_at) {
    const LetterId* const letters = string_->letters.data();
    const LetterMeaning* const meanings = symbols_->levels[0].data();
    const char* const pictured = symbols_->pictured.data();
    constexpr std::size_t least_run = 8;  // for fewer, taking the turtle and putting it back would cost more
    std::size_t i = begin, at = parameters_at, acts_before = begin;
    while (i < end && !walk_.stopped) {
        assert(letters[i] < symbols_->levels[0].size());
        if (!with_pictures && i >= acts_before) {
            const std::size_t ahead = next_action(i, std::min(end, i + least_run));
            acts_before = ahead + least_run;  // short runs seldom stand alone
            if (ahead - i == least_run) i = go_ahead(i, end, at);
            if (i == end) break;
        }
        if constexpr (with_pictures) {
            if (const std::size_t replaced = pictured[letters[i]] ? draw_picture(i, at) : 0) {
                for (std::size_t k = 0; k < replaced; ++k) at += meanings[letters[i + k]].arity;
                i += replaced;
                continue;
            }
        }
        const LetterMeaning& meaning = meanings[letters[i]];
        if (meaning.level) {
            const SymbolMatch match = symbols_->match(*string_, i);
            i = match.module;
            if (match.meaning.action) act(i, letters[i], match.meaning, at);
            at += match.meaning.arity;
        } else {
            if (meaning.action) act(i, letters[i], meaning, at);
            at += meaning.arity;
        }
        ++i;
    }
    parameters_at = at;
    return i;
}

namespace {

/// Three numbers that a compiler keeps in registers, as it does not with a vector of glm.
struct Triple {
    double x, y, z;

    Triple() = default;
    Triple(double all) : Triple(all, all, all) {}
    Triple(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
    Triple(const glm::dvec3& vector) : Triple(vector.x, vector.y, vector.z) {}
    void put(glm::dvec3& to) const {
        to.x = x;
        to.y = y;
        to.z = z;
    }
    friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Triple operator-(const Triple& a, const Triple& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Triple operator*(const Triple& a, double b) { return {a.x * b, a.y * b, a.z * b}; }
};

Triple least(const Triple& a, const Triple& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}

Triple most(const Triple& a, const Triple& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

}  // namespace

/// The turtle that walks as long as it is a variable of a loop: where it is, how it stands and how wide it draws stay
/// in registers.
class StringWalk::Ahead {
public:
    Ahead(Walk& walk, bool draws_plainly)
        : walk_(walk), draws_plainly_(draws_plainly), tapers_(walk.settings_->tapered_lines) {
        take_turtle();
    }

    /// False, and nothing has changed, if that takes the symbol's action.
    [[gnu::always_inline]] bool step(Symbol::Step step, std::size_t module, std::span<const double> parameters) {
        using enum Symbol::Step;
        switch (step) {
            case by_action:
                return false;
            case none:
                return true;
            case draw:
                return draw_segment(module, parameters.empty() ? 1 : parameters[0]);
            case skip:
                return skip_segment(parameters.empty() ? 1 : parameters[0]);
            case left:
                rotate_pair(heading_, left_, walk_.rotation(parameters));
                return true;
            case right:
                rotate_pair(heading_, left_, walk_.rotation(parameters).inverse());
                return true;
            case down:
                rotate_pair(heading_, up_, walk_.rotation(parameters));
                return true;
            case up:
                rotate_pair(heading_, up_, walk_.rotation(parameters).inverse());
                return true;
            case roll:
                rotate_pair(left_, up_, walk_.rotation(parameters));
                return true;
            case roll_back:
                rotate_pair(left_, up_, walk_.rotation(parameters).inverse());
                return true;
            case width:
                return set_width(parameters[0] * scale_);
            case open:
                open_branch();
                return true;
            case close:
                close_branch();
                return true;
        }
        __builtin_unreachable();
    }

    /// Where actions find it.
    [[gnu::always_inline]] void put_back() {
        put_turtle(walk_.turtle());
        Box& bounds = walk_.geometry_->bounds;
        least(bounds.lower, lower_).put(bounds.lower);
        most(bounds.upper, upper_).put(bounds.upper);
    }

private:
    [[gnu::always_inline]] void take_turtle() {
        const TurtleState& turtle = walk_.turtle();
        position_ = turtle.pose.position;
        heading_ = turtle.pose.heading;
        left_ = turtle.pose.left;
        up_ = turtle.pose.up;
        width_ = turtle.width;
        node_radius_ = turtle.node_radius;
        scale_ = turtle.scale;
        axis_ = turtle.axis;
        order_ = turtle.order;
        on_axis_ = turtle.on_axis;
        branches_off_ = turtle.branches_off;
        has_width_ = turtle.has_width;
    }
    [[gnu::always_inline]] void put_turtle(TurtleState& turtle) const {
        position_.put(turtle.pose.position);
        heading_.put(turtle.pose.heading);
        left_.put(turtle.pose.left);
        up_.put(turtle.pose.up);
        turtle.width = width_;
        turtle.node_radius = node_radius_;
        turtle.axis = axis_;
        turtle.order = order_;
        turtle.on_axis = on_axis_;
        turtle.branches_off = branches_off_;
        turtle.has_width = has_width_;
    }
    [[gnu::always_inline]] bool move(double length) {
        if (!draws_plainly_ || walk_.turtle().elasticity != 0) return false;
        const Triple tip = position_ + heading_ * (length * scale_);
        if (!std::isfinite(tip.x + tip.y + tip.z)) return false;
        position_ = tip;
        return true;
    }
    [[gnu::always_inline]] bool skip_segment(double length) {
        if (!move(length)) return false;
        on_axis_ = false;
        return true;
    }
    [[gnu::always_inline]] bool draw_segment(std::size_t module, double length) {
        const TurtleState& rest = walk_.turtle();
        if (rest.cylinder >= 0 || rest.texture != 0 || walk_.internodes_.full()) return false;
        const Triple base = position_;
        if (!move(length)) return false;
        const Triple tip = position_;
        const bool continues = on_axis_ && tapers_;
        const double tip_radius = has_width_ ? walk_.radius_of_width_ * width_ : 0;
        const double base_radius = continues ? node_radius_ : tip_radius;
        if (!on_axis_) axis_ = walk_.geometry_->axes++;
        on_axis_ = true;
        node_radius_ = tip_radius;
        if (walk_.is_as_cpfg_) {
            heading_.put(walk_.drawn_frame.heading);
            left_.put(walk_.drawn_frame.left);
        }
        Internode& row = walk_.internodes_.add();
        row.module = std::uint32_t(module);
        row.axis = axis_;
        row.order = order_;
        row.colour = std::uint16_t(rest.colour);
        row.pixels = tip_radius > 0 ? 0 : float(width_);
        base.put(row.base);
        tip.put(row.tip);
        row.base_radius = base_radius;
        row.tip_radius = tip_radius;
        if (!continues) add_ball(base, base_radius);
        add_ball(tip, tip_radius);
        return true;
    }
    [[gnu::always_inline]] void add_ball(const Triple& centre, double radius) {
        lower_ = least(lower_, centre - radius);
        upper_ = most(upper_, centre + radius);
    }
    [[gnu::always_inline]] bool set_width(double width) {
        if (!std::isfinite(width)) return false;
        width_ = std::max(width, Walk::thinnest_line);
        has_width_ = true;
        return true;
    }
    [[gnu::always_inline]] void open_branch() {
        put_turtle(walk_.turtle());
        walk_.turtles.push_rest();
        if (walk_.pushes_more_) walk_.push_more();
        order_ = TurtleStack::deeper(order_);
        on_axis_ = false;
        branches_off_ = true;
        node_radius_ = 0;
    }
    [[gnu::always_inline]] void close_branch() {
        if (walk_.turtles.depth() == 0) return;
        walk_.turtles.pop();
        walk_.pop_rest();
        take_turtle();
    }

    Walk& walk_;
    const bool draws_plainly_, tapers_;
    Triple position_, heading_, left_, up_;
    double width_, node_radius_, scale_;
    std::uint32_t axis_;
    std::uint16_t order_;
    bool on_axis_, branches_off_, has_width_;
    Triple lower_{std::numeric_limits<double>::infinity()}, upper_{-std::numeric_limits<double>::infinity()};
};

std::size_t StringWalk::go_ahead(std::size_t begin, std::size_t end, std::size_t& parameters_at) {
    const LetterId* const letters = string_->letters.data();
    const LetterMeaning* const meanings = symbols_->levels[0].data();
    const double* values = string_->parameters.data() + parameters_at;
    std::size_t i = begin;
    Ahead ahead(walk_, draws_plainly());
    for (; i < end; ++i) {
        const LetterMeaning& meaning = meanings[letters[i]];
        if (!ahead.step(meaning.step, i, {values, meaning.arity})) break;
        values += meaning.arity;
    }
    ahead.put_back();
    parameters_at = std::size_t(values - string_->parameters.data());
    return i;
}

std::size_t StringWalk::draw_picture(std::size_t module, std::size_t at) {
    const ModuleString& string = *string_;
    const bool looks_around = symbols_->pictures_look_around;
    if (looks_around && offsets_.empty()) {
        link_branches(string, links_);
        offsets_ = parameter_offsets(string, model_->alphabet);
    }
    picture_.clear();
    const std::size_t replaced =
        derivation_->picture(string, looks_around ? &offsets_ : nullptr, links_, module, at, picture_);
    if (replaced == 0) return 0;

    walk_.acting_.module = std::uint32_t(module);
    walk_.acting_.parameters_at = at;
    walk_.acting_.in_picture = true;
    const double* values = picture_.parameters.data();
    constexpr std::size_t between_looks = 8192;
    for (std::size_t i = 0; i < picture_.size() && !walk_.stopped; ++i) {
        if (i % between_looks == between_looks - 1) end_if_asked();
        const LetterMeaning* meaning = &symbols_->levels[0][picture_.letters[i]];
        SymbolMatch match;
        if (meaning->level) {
            match = symbols_->match(picture_, i);
            i = match.module;
            meaning = &match.meaning;
        }
        walk_.acting_.letter = picture_.letters[i];
        if (meaning->action) meaning->action(walk_, {values, meaning->arity});
        values += meaning->arity;
    }
    walk_.acting_.in_picture = false;
    return replaced;
}

}  // namespace espalier::turtle
