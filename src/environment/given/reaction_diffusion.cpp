// reaction-diffusion: substances that make organs around a growing stem, or veins in a sheet.
// Gierer & Meinhardt 1972; Meinhardt 1982, Models of Biological Pattern Formation (organs); Bernasconi 1994 (a second
// inhibitor in time); Meinhardt 1976, Morphogenesis of lines and nets. Lattice, rates and noise are ours.
#include "espalier/base/math.h"
#include "espalier/base/stop.h"
#include "espalier/environment/environment_process.h"

#include "base/bytes.h"
#include "geometry/grids/voxel_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::environment {
namespace {

using Substance = std::vector<double>;  ///< a value per cell, row by row

struct Sheet {
    int columns = 0, rows = 0;
    bool round = false;  ///< the last column is beside the first

    std::size_t cells() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
    std::size_t cell(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
    }
    int around(int column) const { return (column % columns + columns) % columns; }

    /// Some cells of a row: indices of the first of them and of its four neighbours.
    struct Stretch {
        std::size_t cells, first, up, down, left, right;
    };

    /// Calls react for stretches that loops over vectors can take; a cell at a border is its own neighbour there.
    template <class React>
    void each_stretch(React react) const {
        for (int row = 0; row < rows; ++row) {
            const std::size_t here = cell(0, row), up = cell(0, std::max(row - 1, 0));
            const std::size_t down = cell(0, std::min(row + 1, rows - 1));
            const auto last = static_cast<std::size_t>(columns - 1);
            react(Stretch{1, here, up, down, here + (round ? last : 0), here + 1});
            react(Stretch{last - 1, here + 1, up + 1, down + 1, here, here + 2});
            react(Stretch{1, here + last, up + last, down + last, here + last - 1, here + (round ? 0 : last)});
        }
    }
};

/// A source for each cell: 1, more or less by up to `noise`.
void draw_sources(const RandomKey& key, std::uint64_t row, double noise, std::span<double> sources) {
    RandomSamples samples(key, row, 0);
    for (double& source : sources) source = 1 + noise * (2 * samples.uniform() - 1);
}

/// A pattern that the process below runs and shows.
class Pattern {
public:
    explicit Pattern(Sheet sheet) : sheet_(sheet) {}
    virtual ~Pattern() = default;
    virtual void run() = 0;  ///< one derivation step
    virtual void answer(const Query& query, Answer answer) const = 0;
    virtual const Substance& shown() const = 0;
    virtual std::size_t count() const = 0;
    virtual void save(std::ostream& out) const = 0;
    virtual void restore(std::istream& in) = 0;
    const Sheet& sheet() const { return sheet_; }

protected:
    Sheet sheet_;
};

/// Where an activator became greatest: column, and rows above the base.
struct Maximum {
    double column = 0, height = 0;
};

/// The unrolled stem. Row 0 is its tip; each step adds a row there, and the oldest row leaves.
class Stem final : public Pattern {
public:
    Stem(const Settings& settings, RandomKey key, double cell)
        : Pattern({static_cast<int>(settings.integer_or("columns", 34, Range::between(8, 400))),
                   static_cast<int>(settings.integer_or("rows", 20, Range::between(10, 400))), true}),
          key_(key),
          cell_(cell),
          rounds_(settings.integer_or("rounds", 400, Range::between(1, 100'000))),
          noise_(settings.number_or("noise", 0.01, Range::between(0, 1))),
          strength_(settings.number_or("second_inhibitor", 0, Range::between(0, 10))),
          memory_(settings.number_or("memory", 0.003, Range::between(0, 1))),
          second_spread_(settings.number_or("second_spread", 0, Range::between(0, 0.2))),
          activator_(sheet_.cells(), 0),
          inhibitor_(sheet_.cells(), 0.1),
          second_(sheet_.cells(), 0),
          source_(sheet_.cells(), 0),
          production_(sheet_.cells(), production) {
        std::fill_n(production_.begin(), sheet_.cell(0, barren_rows), 0);
        activator_[sheet_.cell(0, barren_rows + 2)] = 1;
        for (int row = sheet_.rows - 1; row >= 0; --row) add_sources(row);
    }

    void run() override {
        for (std::int64_t round = 0; round < rounds_; ++round) {
            end_if_asked();
            react();
        }
        grow();
        find_maxima();
    }

    /// The query's first parameter is the number of a maximum; the others become its azimuth and height.
    void answer(const Query& query, Answer answer) const override {
        const double number = query.parameters[0];
        const bool found = number >= 1 && number <= static_cast<double>(maxima_.size());
        answer[0] = found ? std::floor(number) : 0;
        if (!found) return;
        const Maximum& maximum = maxima_[static_cast<std::size_t>(number) - 1];
        answer[1] = 360 * maximum.column / sheet_.columns;
        answer[2] = maximum.height * cell_;
    }

    const Substance& shown() const override { return activator_; }
    std::size_t count() const override { return maxima_.size(); }

    void save(std::ostream& out) const override {
        for (const Substance* values : {&activator_, &inhibitor_, &second_, &source_}) put_values(out, *values);
        put(out, grown_);
        put(out, drawn_);
        put(out, static_cast<std::uint64_t>(maxima_.size()));
        for (const Maximum& maximum : maxima_) put(out, maximum);
    }
    void restore(std::istream& in) override {
        for (Substance* values : {&activator_, &inhibitor_, &second_, &source_}) get_values(in, *values);
        grown_ = get<int>(in);
        drawn_ = get<std::uint64_t>(in);
        maxima_.clear();
        for (auto left = get<std::uint64_t>(in); left > 0; --left) maxima_.push_back(get<Maximum>(in));
    }

private:
    static constexpr int barren_rows = 3;  ///< at the tip, where nothing is produced
    static constexpr double production = 0.02, basic = 0.001;
    static constexpr double decay = 0.02, spread = 0.01;                     // both of the activator
    static constexpr double inhibitor_decay = 0.03, inhibitor_spread = 0.2;  // it reaches further

    void add_sources(int row) {
        draw_sources(key_, drawn_++, noise_,
                     {source_.data() + sheet_.cell(0, row), static_cast<std::size_t>(sheet_.columns)});
    }

    void react() {
        next_activator_.resize(sheet_.cells());
        next_inhibitor_.resize(sheet_.cells());
        next_second_.resize(sheet_.cells());
        sheet_.each_stretch([this](const Sheet::Stretch& at) { react(at); });
        activator_.swap(next_activator_);
        inhibitor_.swap(next_inhibitor_);
        second_.swap(next_second_);
    }

    // A loop for each substance, with copies of the numbers: as one, the compiler makes none over vectors of it.
    void react(const Sheet::Stretch& at) {
        const std::size_t cells = at.cells, first = at.first;
        const double *a = activator_.data(), *h = inhibitor_.data(), *second = second_.data();
        const double *rate = production_.data() + first, *source = source_.data() + first;
        const auto flow = [=](const double* of, std::size_t i) {
            return of[at.up + i] + of[at.down + i] + of[at.left + i] + of[at.right + i] - 4 * of[first + i];
        };
        const double strength = strength_, memory = memory_, second_spread = second_spread_;
        double* next = next_activator_.data() + first;
        for (std::size_t i = 0; i < cells; ++i) {
            const double here = a[first + i], made = rate[i] * source[i];
            next[i] = here + made * (here * here + basic) / (h[first + i] + strength * second[first + i] + 1e-6) -
                      decay * here + spread * flow(a, i);
        }
        next = next_inhibitor_.data() + first;
        for (std::size_t i = 0; i < cells; ++i) {
            const double here = h[first + i], made = rate[i] * source[i];
            next[i] =
                here + made * (a[first + i] * a[first + i]) - inhibitor_decay * here + inhibitor_spread * flow(h, i);
        }
        next = next_second_.data() + first;
        for (std::size_t i = 0; i < cells; ++i) {
            const double here = second[first + i];
            next[i] = here + memory * (a[first + i] - here) + second_spread * flow(second, i);
        }
    }

    // The new row at the tip is like the one that was there.
    void grow() {
        for (Substance* values : {&activator_, &inhibitor_, &second_, &source_}) {
            std::copy_backward(values->begin(), values->end() - sheet_.columns, values->end());
        }
        add_sources(0);
        ++grown_;
    }

    bool is_maximum(int column, int row) const {
        const double value = activator_[sheet_.cell(column, row)];
        if (value < 1) return false;
        for (int down = -1; down <= 1; ++down) {
            for (int right = -1; right <= 1; ++right) {
                if (down == 0 && right == 0) continue;
                const double other = activator_[sheet_.cell(sheet_.around(column + right), row + down)];
                const bool first = down < 0 || (down == 0 && right < 0);  // one of equal cells is the maximum
                if (other > value || (other == value && first)) return false;
            }
        }
        return true;
    }

    /// The centre of the activator around a cell.
    Maximum centre_at(int column, int row) const {
        Maximum sum;
        double weight = 0;
        for (int down = -1; down <= 1; ++down) {
            for (int right = -2; right <= 2; ++right) {
                const double value = activator_[sheet_.cell(sheet_.around(column + right), row + down)];
                weight += value;
                sum.column += value * right;
                sum.height -= value * down;
            }
        }
        const double in_the_middle = column + sum.column / weight;
        return {in_the_middle - sheet_.columns * std::floor(in_the_middle / sheet_.columns),
                grown_ + sheet_.rows - row + sum.height / weight};
    }

    // A maximum within two cells of one known is that one, which has moved.
    void find_maxima() {
        for (int row = 1; row < sheet_.rows - 1; ++row) {
            for (int column = 0; column < sheet_.columns; ++column) {
                if (!is_maximum(column, row)) continue;
                const Maximum found = centre_at(column, row);
                const auto known = std::find_if(maxima_.rbegin(), maxima_.rend(), [&](const Maximum& maximum) {
                    const double apart = std::remainder(maximum.column - found.column, sheet_.columns);
                    return math::hypot(apart, maximum.height - found.height) < 2;
                });
                if (known == maxima_.rend()) {
                    maxima_.push_back(found);
                } else {
                    *known = found;
                }
            }
        }
    }

    RandomKey key_;
    double cell_;
    std::int64_t rounds_;
    double noise_, strength_, memory_, second_spread_;
    Substance activator_, inhibitor_, second_, source_, next_activator_, next_inhibitor_, next_second_;
    Substance production_;  ///< of activator and inhibitor, by a source of 1
    std::vector<Maximum> maxima_;
    int grown_ = 0;
    std::uint64_t drawn_ = 0;  ///< rows of sources
};

/// A sheet of tissue whose cells become veins where the activator passes. Veins take up a substance that the activator
/// needs, so that it moves on to cells that have more, and divides.
class Net final : public Pattern {
public:
    Net(const Settings& settings, RandomKey key, double cell)
        : Pattern({static_cast<int>(settings.integer_or("columns", 56, Range::between(8, 1000))),
                   static_cast<int>(settings.integer_or("rows", 40, Range::between(8, 1000)))}),
          cell_(cell),
          rounds_(settings.integer_or("rounds", 100, Range::between(1, 100'000))),
          uptake_(settings.number_or("uptake", 0.2, Range::between(0, 1))),
          activator_(sheet_.cells(), 0.001),
          inhibitor_(sheet_.cells(), 0.01),
          substrate_(sheet_.cells(), 1),
          vein_(sheet_.cells(), 0),
          source_(sheet_.cells(), 1) {
        draw_sources(key, 0, settings.number_or("noise", 0.1, Range::between(0, 1)), source_);
        const std::size_t first = sheet_.cell(sheet_.columns / 2, 2);
        activator_[first] = vein_[first] = 1;
    }

    void run() override {
        for (std::int64_t round = 0; round < rounds_; ++round) {
            end_if_asked();
            react();
        }
    }

    /// How much of a vein the cell at the query's place is.
    void answer(const Query& query, Answer answer) const override {
        const double column = std::floor(query.pose.position.x / cell_),
                     row = std::floor(query.pose.position.y / cell_);
        const bool inside = column >= 0 && column < sheet_.columns && row >= 0 && row < sheet_.rows;
        answer[0] = inside ? vein_[sheet_.cell(static_cast<int>(column), static_cast<int>(row))] : 0;
    }

    const Substance& shown() const override { return vein_; }
    std::size_t count() const override {
        return static_cast<std::size_t>(std::count_if(vein_.begin(), vein_.end(), [](double v) { return v > 0.5; }));
    }

    void save(std::ostream& out) const override {
        for (const Substance* values : {&activator_, &inhibitor_, &substrate_, &vein_}) put_values(out, *values);
    }
    void restore(std::istream& in) override {
        for (Substance* values : {&activator_, &inhibitor_, &substrate_, &vein_}) get_values(in, *values);
    }

private:
    void react() {
        Substance& a = activator_;
        Substance& h = inhibitor_;
        Substance& s = substrate_;
        Substance& v = vein_;
        next_a_.resize(a.size());
        next_h_.resize(a.size());
        next_s_.resize(a.size());
        sheet_.each_stretch([&](const Sheet::Stretch& at) {
            for (std::size_t k = 0; k < at.cells; ++k) {
                const std::size_t i = at.first + k;
                const auto flow = [&](const Substance& of) {
                    return of[at.up + k] + of[at.down + k] + of[at.left + k] + of[at.right + k] - 4 * of[i];
                };
                const double made = 0.002 * source_[i] * a[i] * a[i] * s[i];
                next_a_[i] = a[i] + made / h[i] + 0.03 * source_[i] * v[i] - 0.16 * a[i] + 0.03 * flow(a);
                next_h_[i] = h[i] + made + 0.00005 * v[i] - 0.04 * h[i] + 0.18 * flow(h);
                next_s_[i] = s[i] + 0.02 - 0.02 * s[i] - uptake_ * s[i] * v[i] + 0.06 * flow(s);
                v[i] += 0.0035 * a[i] - 0.1 * v[i] + v[i] * v[i] / (1 + 10 * v[i] * v[i]);
            }
        });
        a.swap(next_a_);
        h.swap(next_h_);
        s.swap(next_s_);
    }

    double cell_;
    std::int64_t rounds_;
    double uptake_;
    Substance activator_, inhibitor_, substrate_, vein_, source_, next_a_, next_h_, next_s_;
};

class ReactionDiffusion final : public EnvironmentProcess {
public:
    ReactionDiffusion(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : name_(context.name), cell_(settings.number_or("cell", 1, Range::positive())) {
        const RandomKey key(context.seed, 0, Stream::process);
        if (settings.choice_or("pattern", "organs", {"organs", "net"}) == "organs") {
            pattern_ = std::make_unique<Stem>(settings, key, cell_);
            arity_ = {3, 20};
        } else {
            pattern_ = std::make_unique<Net>(settings, key, cell_);
        }
        fields.provide(
            {name_, "1", "activator around the unrolled stem, or veins", nullptr, true, [this] { return grid(); }});
    }

    void advance(const WorldView& world, Queries, Fields&) override {
        if (world.step > 0) pattern_->run();
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for (std::size_t i = 0; i < queries.size(); ++i) pattern_->answer(queries[i], answers[i]);
    }

    std::vector<Quantity> statistics(std::uint32_t) const override {
        return {{"count", static_cast<double>(pattern_->count())}};
    }

    std::pair<int, int> query_arity() const override { return arity_; }
    Spreading spreading() const override { return Spreading::queries; }
    void save(std::ostream& out) const override { pattern_->save(out); }
    void restore(std::istream& in) override { pattern_->restore(in); }

private:
    // One layer in the x-y plane. The tip of a stem is above.
    std::shared_ptr<const FieldGrid> grid() const {
        const Sheet& sheet = pattern_->sheet();
        VoxelValues values(cell_, {0, 0, -cell_ / 2});
        for (int row = 0; row < sheet.rows; ++row) {
            for (int column = 0; column < sheet.columns; ++column) {
                values.set({column, sheet.round ? sheet.rows - 1 - row : row, 0},
                           static_cast<float>(pattern_->shown()[sheet.cell(column, row)]));
            }
        }
        return values.grid();
    }

    std::string name_;
    double cell_;
    std::unique_ptr<Pattern> pattern_;
    std::pair<int, int> arity_{1, 20};
};

const Registered<ProcessType> entry{{"reaction-diffusion",
                                     "organs around a growing stem, or veins in a sheet (Meinhardt 1982)",
                                     R"(An activator makes more of itself and of an inhibitor, which spreads further.

pattern          "organs", or "net"; organs: on a stem that grows by a row of cells in each step;
                 net: on a sheet, where veins grow towards a substance that they take up
cell             1 m, > 0; size of a cell
columns          34 cells, 8 to 400; cells around the stem; of a net 56, 8 to 1000
rows             20 cells, 10 to 400; cells along the stem; of a net 40, 8 to 1000
rounds           400, 1 to 100000; rounds of reaction and diffusion in a step; of a net 100
noise            0.01, 0 to 1; cells produce more or less by up to this part; of a net 0.1

Queries and parameters of organs:

?name(k, a, h) -> k: the number of an organ, from 1; it stays if the organ has arisen, else it becomes 0.
                  a: its azimuth in degrees; h: its height above the base in metres

second_inhibitor  0, 0 to 10; strength of a second inhibitor
memory            0.003, 0 to 1; how fast it follows the activator, part of the difference per round
second_spread     0, 0 to 0.2; 0: it stays in its cell (Bernasconi 1994); above: it spreads too (Meinhardt 1982), by this
                  part of the difference to each neighbouring cell per round

Queries and parameters of a net:

?name(v) -> how much of a vein this place is: 0, or about 0.9; the sheet begins at the origin of x and y

uptake            0.2, 0 to 1; how fast veins take up the substance; with 0.1 they branch but close no meshes

Field: the activator around the unrolled stem, or the veins. Statistics: count, of organs or of cells of veins.
Further parameters of a query keep their values.
)",
                                     construct<ReactionDiffusion>}};

}  // namespace
}  // namespace espalier::environment
