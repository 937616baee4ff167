#include "environment/soil/solutes/transport.h"

#include "espalier/base/math.h"

#include <algorithm>
#include <cmath>

namespace espalier::environment {
namespace {

constexpr std::size_t nowhere = std::size_t(-1);
constexpr double least_water = 1e-4;  ///< m3/m3: drier soil holds its solute as if it had so much

/// van Leer (1974): half the harmonic mean of two differences, 0 at an extremum.
double limited_half(double behind, double ahead) {
    const double product = behind * ahead;
    return product > 0 ? product / (behind + ahead) : 0;
}

double harmonic(double a, double b) {
    return a > 0 && b > 0 ? 2 * a * b / (a + b) : 0;
}

}  // namespace

/// The cells along an axis.
struct SoluteTransport::Line {
    const SoilLayout& layout;
    int along, count;
    bool joined;
    std::ptrdiff_t stride;

    Line(const SoilLayout& soil, int axis)
        : layout(soil),
          along(axis),
          count(soil.grid().size()[axis]),
          joined(axis == 0 ? soil.joined_x() : axis == 2 && soil.joined_z()),
          stride(axis == 0
                     ? 1
                     : static_cast<std::ptrdiff_t>(soil.grid().stride()) * (axis == 1 ? 1 : soil.grid().size().y)) {}

    bool vertical() const { return along == 1; }

    /// The free cell so many places on, or `nowhere`.
    std::size_t beyond(std::size_t cell, int place, int steps) const {
        int to = place + steps;
        if (to < 0 || to >= count) {
            if (!joined) return nowhere;
            to = (to + 2 * count) % count;
        }
        if (to == place) return nowhere;
        const auto found = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) + (to - place) * stride);
        return layout.free(found) ? found : nowhere;
    }
};

template <class Work>
void SoluteTransport::for_cells(Work work) const {
    layout_.for_rows([&](std::size_t row) {
        const std::size_t begin = grid_.row_begin(row);
        for (std::size_t c = begin; c < begin + grid_.size().x; ++c) {
            if (layout_.free(c)) work(c, row);
        }
    });
}

SoluteTransport::SoluteTransport(const SoilLayout& layout, const SoluteProperties& properties)
    : layout_(layout), grid_(layout.grid()), properties_(properties), edge_(layout.edge()), row_rate_(grid_.rows()) {
    for (WaterBrick* brick : {&amount, &concentration, &content_, &start_, &speed_, &spread_[0], &spread_[1],
                              &spread_[2], &flux_[0], &flux_[1], &flux_[2]}) {
        brick->assign(grid_.cells(), 0.0);
    }
    const std::size_t columns = std::size_t(grid_.size().x) * grid_.size().z;
    for (std::vector<double>* side : {&top_, &bottom_, &top_spread_, &bottom_spread_}) side->assign(columns, 0.0);
}

void SoluteTransport::set_content(const WaterBrick& contents) {
    for_cells([&](std::size_t c, std::size_t) { content_[c] = std::max(contents[c], least_water); });
}

void SoluteTransport::find_concentrations() {
    for_cells([&](std::size_t c, std::size_t) {
        concentration[c] = properties_.sorption.concentration(content_[c], amount[c]);
    });
}

double SoluteTransport::diffusivity(std::size_t cell) const {
    const double content = content_[cell], full = layout_.kind(cell).soil().saturated;
    return content * math::any_power(content, 7.0 / 3) / (full * full) * properties_.diffusion;
}

void SoluteTransport::find_dispersion(const SoilMovement& movement) {
    WaterBrick& still = start_;  // not in use between parts
    for_cells([&](std::size_t c, std::size_t row) {
        still[c] = diffusivity(c);
        const glm::ivec3 at = grid_.voxel_of(c);
        const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x + at.x;
        double square = 0;
        for (int axis = 0; axis < (grid_.flat() ? 2 : 3); ++axis) {
            const std::size_t before = Line(layout_, axis).beyond(c, at[axis], -1);
            double back = before == nowhere ? 0 : movement.flux[axis][before], front = movement.flux[axis][c];
            if (axis == 1 && at.y == 0) back = movement.floor[column];
            if (axis == 1 && at.y == grid_.size().y - 1) front = -movement.surface[column];
            square += 0.25 * (back + front) * (back + front);
        }
        speed_[c] = properties_.dispersivity * std::sqrt(square);
    });
    for_cells([&](std::size_t c, std::size_t row) {
        const glm::ivec3 at = grid_.voxel_of(c);
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t next = Line(layout_, axis).beyond(c, at[axis], 1);
            spread_[axis][c] = next == nowhere ? 0 : harmonic(still[c], still[next]) + 0.5 * (speed_[c] + speed_[next]);
        }
        const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x + at.x;
        if (at.y == 0) bottom_spread_[column] = still[c] + speed_[c];
        if (at.y == grid_.size().y - 1) top_spread_[column] = still[c] + speed_[c];
    });
}

int SoluteTransport::parts(const SoilMovement& movement, const WaterBrick& contents) {
    find_dispersion(movement);
    std::fill(row_rate_.begin(), row_rate_.end(), 0);
    for_cells([&](std::size_t c, std::size_t row) {
        const glm::ivec3 at = grid_.voxel_of(c);
        const std::size_t column = std::size_t(grid_.z_of(row)) * grid_.size().x + at.x;
        double leaving = 0, spreading = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t before = Line(layout_, axis).beyond(c, at[axis], -1);
            leaving += std::max(movement.flux[axis][c], 0.0);
            spreading += spread_[axis][c];
            if (before == nowhere) continue;
            leaving += std::max(-movement.flux[axis][before], 0.0);
            spreading += spread_[axis][before];
        }
        // A held concentration is half a voxel away.
        if (at.y == 0) leaving += std::max(-movement.floor[column], 0.0);
        if (!movement.sides.empty()) leaving += std::max(-movement.sides[c], 0.0);
        if (at.y == 0) spreading += 2 * bottom_spread_[column];
        if (at.y == grid_.size().y - 1) spreading += 2 * top_spread_[column];
        const double water = std::max(std::min(contents[c], content_[c]), least_water);
        row_rate_[row] = std::max(row_rate_[row], (2 * leaving / edge_ + spreading / (edge_ * edge_)) /
                                                      properties_.sorption.least_capacity(water));
    });
    const double fastest = *std::max_element(row_rate_.begin(), row_rate_.end());
    return std::max(1, static_cast<int>(std::ceil(std::min(movement.days * fastest / 0.9, 1e9))));
}

double SoluteTransport::face_concentration(const Line& line, std::size_t cell, std::size_t next, int place,
                                           double water, const SoluteSides& sides) const {
    const bool onward = water > 0;
    const std::size_t from = onward ? cell : next, to = onward ? next : cell;
    const std::size_t behind = onward ? line.beyond(cell, place, -1) : line.beyond(cell, place, 2);
    const bool at_side = line.vertical() && (onward ? place == 0 : place + 2 == line.count);
    if (behind == nowhere && !at_side) return concentration[from];
    // What comes in at a side is known on its face, half a voxel behind.
    const double beyond_side =
        onward ? sides.held_bottom.value_or(sides.entering_bottom) : sides.held_top.value_or(sides.entering_top);
    const double difference =
        behind == nowhere ? 2 * (concentration[from] - beyond_side) : concentration[from] - concentration[behind];
    const double ahead = concentration[to] - concentration[from];
    return concentration[from] + std::min(limited_half(difference, ahead), concentration[from]);
}

void SoluteTransport::find_fluxes(const SoilMovement& movement, std::size_t row, const SoluteSides& sides) {
    const int y = grid_.y_of(row), z = grid_.z_of(row), n = grid_.size().x;
    for (int axis = 0; axis < 3; ++axis) {
        const Line line(layout_, axis);
        for (int x = 0; x < n; ++x) {
            const std::size_t c = grid_.row_begin(row) + x;
            const int place = axis == 0 ? x : axis == 1 ? y : z;
            const std::size_t next = layout_.free(c) ? line.beyond(c, place, 1) : nowhere;
            flux_[axis][c] = 0;
            if (next == nowhere) continue;
            const double water = movement.flux[axis][c];
            flux_[axis][c] = water * face_concentration(line, c, next, place, water, sides) -
                             spread_[axis][c] * (concentration[next] - concentration[c]) / edge_;
        }
    }
    for (int x = 0; x < n; ++x) {
        const std::size_t c = grid_.row_begin(row) + x, column = std::size_t(z) * n + x;
        if (!layout_.free(c)) continue;
        const auto side = [&](double water, double entering, const std::optional<double>& held, double spread,
                              bool leaves) {
            double flux = water > 0 ? water * held.value_or(entering) : leaves ? water * concentration[c] : 0;
            if (held) flux += spread * (*held - concentration[c]) / (0.5 * edge_);
            return flux;
        };
        // What the air takes leaves its solute behind.
        if (y + 1 == grid_.size().y)
            top_[column] =
                side(movement.surface[column], sides.entering_top, sides.held_top, top_spread_[column], false);
        if (y == 0)
            bottom_[column] =
                side(movement.floor[column], sides.entering_bottom, sides.held_bottom, bottom_spread_[column], true);
    }
}

void SoluteTransport::find_side_fluxes(const SoilMovement& movement, double entering) {
    if (movement.sides.empty()) return;
    sides_.resize(grid_.cells());
    for_cells([&](std::size_t c, std::size_t) {
        const double water = movement.sides[c];
        sides_[c] = water * (water > 0 ? entering : concentration[c]);
    });
}

/// Amount per volume and day that the faces take from a cell.
double SoluteTransport::outflow(std::size_t row, std::size_t cell) const {
    const int x = static_cast<int>(cell - grid_.row_begin(row)), y = grid_.y_of(row), z = grid_.z_of(row);
    const int places[] = {x, y, z};
    const std::size_t column = std::size_t(z) * grid_.size().x + x;
    double out = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::size_t before = Line(layout_, axis).beyond(cell, places[axis], -1);
        out += flux_[axis][cell] - (before == nowhere ? 0 : flux_[axis][before]);
    }
    if (y == 0) out -= bottom_[column];
    if (y + 1 == grid_.size().y) out -= top_[column];
    if (!sides_.empty()) out -= sides_[cell];
    return out / edge_;
}

void SoluteTransport::pass_sides(double days) {
    const double area = edge_ * edge_;
    for (std::size_t column = 0; column < top_.size(); ++column) {
        flown_.top += area * days * top_[column];
        flown_.bottom += area * days * bottom_[column];
        flown_.leached += area * days * std::max(-bottom_[column], 0.0);
    }
    for (const double into : sides_) flown_.sides += area * days * into;
}

/// Heun's method: the mean of the amounts before and after two steps of Euler's.
void SoluteTransport::advance(const SoilMovement& movement, const WaterBrick& contents, double days, double days_left,
                              const SoluteSides& sides) {
    start_ = amount;
    for (int stage = 0; stage < 2; ++stage) {
        layout_.for_rows([&](std::size_t row) { find_fluxes(movement, row, sides); });
        find_side_fluxes(movement, sides.entering_sides);
        pass_sides(0.5 * days);
        for_cells([&](std::size_t c, std::size_t row) {
            const double stepped = amount[c] - days * outflow(row, c);
            amount[c] = stage == 0 ? stepped : std::max(0.5 * (start_[c] + stepped), 0.0);
            if (stage > 0) return;
            content_[c] += (std::max(contents[c], least_water) - content_[c]) * days / days_left;
        });
        find_concentrations();
    }
}

}  // namespace espalier::environment
