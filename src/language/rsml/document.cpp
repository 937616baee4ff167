#include "language/rsml/document.h"

#include "base/text.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/units.h"
#include "language/rsml/raw_file.h"
#include "language/rsml/sampling.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace espalier::language::rsml {
namespace {

constexpr double diameter_if_unknown = 0.0005;  ///< m
constexpr double dots_of_a_scan = 300;          ///< per inch: what root scanners are set to where nothing is said
constexpr double inch = 0.0254;                 ///< m
constexpr double thick = 0.1;                   ///< of a plant's extent: no root is thicker

/// What a file says in its own units becomes metres, days and a y that points upwards.
class Measuring {
public:
    Measuring(RawFile file, std::string name, const MeasuredOptions& options, measured::Notes& notes)
        : file_(std::move(file)), name_(std::move(name)), options_(options), notes_(notes) {}

    MeasuredPlants plants() {
        measure_lines();
        MeasuredPlants plants;
        scale_ = metres_of_a_coordinate();
        plants.unit = unit_in_words_;
        plants.up = up();
        axes_ = scale_ * measured::upright(plants.up);
        compare_lengths();
        set_nodes();
        set_diameters();
        plants.has_times = set_days();
        set_bearing_nodes();
        plants.axes = join();
        let_bearers_come_first(plants.axes);
        name_plants(plants);
        return plants;
    }

private:
    // -- lines

    void measure_lines() {
        std::size_t with_points = 0;
        for (const RawRoot& root : file_.roots) {
            const std::vector<double> lengths = arc_lengths(root);
            line_lengths_.push_back(lengths.empty() ? 0 : lengths.back());
            with_points += root.points.empty() ? 0 : 1;
            if (!root.points.empty()) continue;
            notes_.warn("a root has no points and is left out; what it bears is borne by its bearer", root.axis.place);
        }
        if (with_points == 0) throw UserError(file_place(), without_points());
    }

    std::string without_points() const {
        if (file_.roots.empty()) return "this file has no roots";
        const double length = sum_of_length_properties();
        return fmt::format("no root of this file has points in <geometry><polyline> ({} without){}", file_.roots.size(),
                           length > 0
                               ? fmt::format(": only properties are left of them, among which their lengths come "
                                             "to {} together",
                                             format_general(length))
                               : "");
    }

    /// Where the first root is, or else the file begins.
    Place file_place() const { return file_.roots.empty() ? Place{name_, 1, 1} : file_.roots.front().axis.place; }

    double sum_of_length_properties() const {
        double sum = 0;
        for (const RawRoot& root : file_.roots) sum += length_property(root).value_or(0);
        return sum;
    }

    static std::optional<double> length_property(const RawRoot& root) {
        for (const RawProperty& property : root.properties) {
            if (property.term.quantity == Quantity::length) return property.value;
        }
        return std::nullopt;
    }

    /// What the roots' own lengths are of their lines'; nothing where there are none.
    std::optional<double> said_per_drawn() const {
        double said = 0, drawn = 0;
        for (std::size_t i = 0; i < file_.roots.size(); ++i) {
            const std::optional<double> length = length_property(file_.roots[i]);
            if (!length || !(*length > 0) || !(line_lengths_[i] > 0)) continue;
            said += *length;
            drawn += line_lengths_[i];
        }
        return drawn > 0 ? std::optional(said / drawn) : std::nullopt;
    }

    std::optional<double> defined_metres(const std::string& property) const {
        const auto found = file_.defined_unit.find(property);
        return found == file_.defined_unit.end() ? std::nullopt : measured::metres_of(found->second);
    }

    void compare_lengths() {
        constexpr double tolerance = 0.05;
        const std::optional<double> ratio = said_per_drawn();
        if (!ratio) return;
        const double said = *ratio * defined_metres("length").value_or(scale_ * file_.resolution);
        if (std::abs(said - scale_) <= tolerance * scale_ || std::abs(*ratio - 1) <= tolerance) return;
        notes_.warn(fmt::format("the file's property 'length' says {} times what its lines measure",
                                format_general(said / scale_)));
    }

    // -- units

    double metres_of_a_coordinate() {
        if (options_.pixel) {
            unit_in_words_ = fmt::format("pixels of {} mm", format_general(1000 * *options_.pixel));
            return *options_.pixel;
        }
        if (!options_.unit.empty()) {
            unit_in_words_ = options_.unit;
            if (file_.resolution != 1) {
                notes_.warn(fmt::format("the resolution {} is not used: the unit was given for the coordinates",
                                        format_general(file_.resolution)));
            }
            return measured::metres_of_unit(options_.unit);
        }
        if (file_.unit && is_pixel(*file_.unit)) return metres_of_a_pixel();
        if (!file_.unit || file_.unit->empty()) {
            notes_.warn("the file says no <unit>: taken as cm; give another as unit");
        }
        const std::string unit = file_.unit && !file_.unit->empty() ? *file_.unit : "cm";
        const std::optional<double> metres = measured::metres_of(unit);
        if (!metres) {
            throw UserError(Place{name_, 1, 1},
                            fmt::format("the unit '{}' is no length: write m, cm, mm, um, inch or pixel as "
                                        "<unit>, and pixels per unit as <resolution>; or give a unit",
                                        escaped(unit)));
        }
        unit_in_words_ = unit;
        if (file_.resolution == 1) return *metres;
        if (has_negative_coordinates() && *metres != inch) {
            notes_.warn(
                fmt::format("the resolution {} is not used: coordinates below 0 are no pixels, and are taken "
                            "as {}; give pixel if they are",
                            format_general(file_.resolution), unit));
            return *metres;
        }
        unit_in_words_ = fmt::format("pixels, {} per {}", format_general(file_.resolution), unit);
        return *metres / file_.resolution;
    }

    bool has_negative_coordinates() const {
        return std::any_of(file_.roots.begin(), file_.roots.end(), [](const RawRoot& root) {
            return std::any_of(root.points.begin(), root.points.end(), [](const glm::dvec3& point) {
                return std::min({point.x, point.y, point.z}) < 0;
            });
        });
    }

    double metres_of_a_pixel() {
        const std::optional<double> ratio = said_per_drawn(), metres = defined_metres("length");
        double pixel = inch / dots_of_a_scan;
        std::string reason = fmt::format("taken as {} per inch", dots_of_a_scan);
        if (ratio && metres) {
            pixel = *ratio * *metres;
            reason = "as wide as the property 'length' makes them";
        } else if (file_.resolution != 1) {
            pixel = inch / file_.resolution;
            reason = fmt::format("the resolution {} is taken as pixels per inch", format_general(file_.resolution));
        }
        unit_in_words_ = fmt::format("pixels of {} mm, guessed", format_general(1000 * pixel));
        notes_.warn(
            fmt::format("the file's unit is the pixel, and it does not say how wide one is: {}, {} mm; give "
                        "pixel, in mm",
                        reason, format_general(1000 * pixel)));
        return pixel;
    }

    // -- direction

    std::string up() {
        if (!options_.up.empty()) return options_.up;
        if (file_.up && !file_.up->empty()) {
            const std::string word = file_.up->starts_with('+') ? file_.up->substr(1) : *file_.up;
            for (const std::string& known : measured::upward_axes()) {
                if (word == known) return word;
            }
            notes_.warn(fmt::format("<up> is x, y, z, -x, -y or -z, not '{}': it is not used", escaped(*file_.up)));
        }
        const glm::dvec3 run = run_of_first_order();
        if (file_.is_flat) {
            if (run.y < 0) {
                notes_.warn(
                    "the file is flat, and y is taken to grow downwards as in a picture, but its roots of first "
                    "order run upwards then; give up = y if they do not");
            }
            return "-y";
        }
        if (const std::string habit = upwards_of(file_.software); !habit.empty()) {
            notes_.warn(fmt::format("the file does not say what points upwards: {}, as {} writes it", habit,
                                    escaped(file_.software)));
            return habit;
        }
        return against(run);
    }

    /// Where roots that no other bears run to, together.
    glm::dvec3 run_of_first_order() const {
        glm::dvec3 run(0);
        for (const RawRoot& root : file_.roots) {
            if (!root.axis.bearer && !root.points.empty()) run += root.points.back() - root.points.front();
        }
        return run;
    }

    std::string against(const glm::dvec3& run) {
        int axis = 2;
        for (const int other : {1, 0}) {
            if (std::abs(run[other]) > std::abs(run[axis])) axis = other;
        }
        const std::string up = std::string(run[axis] > 0 ? "-" : "") + "xyz"[axis];
        notes_.warn(
            fmt::format("the file does not say what points upwards: {}, because roots of first order run "
                        "furthest along {}; give up if it is another axis",
                        up, up.starts_with('-') ? up.substr(1) : "-" + up));
        return up;
    }

    // -- nodes

    void set_nodes() {
        for (RawRoot& root : file_.roots) {
            root.axis.nodes.reserve(root.points.size());
            for (const glm::dvec3& point : root.points) {
                root.axis.nodes.push_back({axes_ * point, diameter_if_unknown, 0, false});
            }
            for (const std::size_t first : root.breaks) root.axis.nodes[first].linked = true;
        }
    }

    /// The values of a quantity at the nodes of a root, and what it is called there; a function goes before a property.
    struct Found {
        const std::string* name = nullptr;
        std::vector<double> values;
    };

    Found found(const RawRoot& root, Quantity quantity) {
        Found found;
        if (root.points.empty()) return found;
        for (const RawFunction& function : root.functions) {
            if (function.term.quantity != quantity) continue;
            if (found.name) {
                notes_.unused("function '" + function.name + "'", function.place);
                continue;
            }
            found = {&function.name, values_at_nodes(root, function, notes_)};
            if (found.values.empty()) found.name = nullptr;
        }
        for (const RawProperty& property : root.properties) {
            if (property.term.quantity != quantity) continue;
            if (found.name) {
                notes_.unused("property '" + property.name + "'", root.axis.place);
                continue;
            }
            found = {&property.name, std::vector<double>(root.points.size(), property.term.factor * property.value)};
        }
        return found;
    }

    // -- diameters

    void set_diameters() {
        std::vector<Found> diameters;
        double thickest_said = 0, thickest_drawn = 0;
        for (const RawRoot& root : file_.roots) {
            diameters.push_back(found(root, Quantity::diameter));
            const Found& each = diameters.back();
            if (!each.name) {
                if (root.points.empty()) continue;
                notes_.warn(fmt::format("a root has no diameter: taken as {} mm", 1000 * diameter_if_unknown),
                            root.axis.place);
                continue;
            }
            const double largest = *std::max_element(each.values.begin(), each.values.end());
            thickest_said = std::max(thickest_said, largest * defined_metres(*each.name).value_or(scale_));
            thickest_drawn = std::max(thickest_drawn, largest * scale_);
        }
        const bool in_coordinates = coordinates_measure_diameters(thickest_said, thickest_drawn);
        for (std::size_t i = 0; i < diameters.size(); ++i) {
            if (!diameters[i].name) continue;
            const double metres = in_coordinates ? scale_ : defined_metres(*diameters[i].name).value_or(scale_);
            for (std::size_t k = 0; k < diameters[i].values.size(); ++k) {
                file_.roots[i].axis.nodes[k].diameter = std::max(0.0, metres * diameters[i].values[k]);
            }
        }
    }

    /// Some programs say that diameters are cm and write pixels.
    bool coordinates_measure_diameters(double thickest_said, double thickest_drawn) {
        const double most = thick * largest_plant();
        const bool is_more_likely = thickest_said > most && thickest_drawn < thickest_said;
        if (is_more_likely) {
            notes_.warn(
                fmt::format("diameters as the file labels them, up to {} m, would be larger than a tenth of the "
                            "plant: they are taken in the unit of the coordinates, up to {} m",
                            format_general(thickest_said), format_general(thickest_drawn)));
        }
        const double thickest = is_more_likely ? thickest_drawn : thickest_said;
        if (thickest > most && most > 0) {
            notes_.warn(
                fmt::format("diameters up to {} m are larger than a tenth of the plant", format_general(thickest)));
        }
        return is_more_likely;
    }

    /// Its largest side, m.
    double largest_plant() const {
        std::vector<std::pair<glm::dvec3, glm::dvec3>> boxes(file_.plants.size(),
                                                             std::pair(glm::dvec3(INFINITY), glm::dvec3(-INFINITY)));
        for (const RawRoot& root : file_.roots) {
            auto& [lower, upper] = boxes[root.axis.plant];
            for (const MeasuredNode& node : root.axis.nodes) {
                lower = glm::min(lower, node.at);
                upper = glm::max(upper, node.at);
            }
        }
        double largest = 0;
        for (const auto& [lower, upper] : boxes) {
            for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, upper[axis] - lower[axis]);
        }
        return largest;
    }

    // -- times

    bool set_days() {
        std::vector<Found> births, ages;
        for (const RawRoot& root : file_.roots) {
            births.push_back(found(root, Quantity::birth));
            ages.push_back(found(root, Quantity::age));
        }
        const auto is_known = [](const Found& each) { return each.name != nullptr; };
        const bool has_births = std::any_of(births.begin(), births.end(), is_known);
        for (std::size_t i = 0; has_births && i < ages.size(); ++i) {
            if (ages[i].name) notes_.unused("'" + *ages[i].name + "' beside times of birth", file_.roots[i].axis.place);
        }
        const std::vector<Found>& times = has_births ? births : ages;
        if (std::none_of(times.begin(), times.end(), is_known)) return false;
        const std::optional<double> last_age = has_births ? std::nullopt : last_if_they_are_ages(ages);
        bool has_days = false;
        for (std::size_t i = 0; i < times.size(); ++i) {
            for (std::size_t k = 0; k < times[i].values.size(); ++k) {
                const double value = times[i].values[k];
                const double day = days_of_a_unit(*times[i].name) * (last_age ? *last_age - value : value);
                file_.roots[i].axis.nodes[k].day = std::max(day, 0.0);
                has_days = has_days || day > 0;
            }
        }
        return has_days;
    }

    /// The oldest age. Nothing where what is called age grows towards the tips: then it is a time of birth.
    std::optional<double> last_if_they_are_ages(const std::vector<Found>& ages) {
        double rise = 0, last = 0;
        for (const Found& each : ages) {
            if (!each.name) continue;
            rise += each.values.back() - each.values.front();
            last = std::max(last, *std::max_element(each.values.begin(), each.values.end()));
        }
        if (rise <= 0) return last;
        notes_.warn(
            "'age' grows from the bases of roots to their tips: it is taken as the day on which each node "
            "appeared");
        return std::nullopt;
    }

    double days_of_a_unit(const std::string& name) {
        const auto defined = file_.defined_unit.find(name);
        if (defined == file_.defined_unit.end() || defined->second.empty()) return 1;
        if (const std::optional<double> days = days_of(defined->second)) return *days;
        notes_.warn(
            fmt::format("the unit '{}' of '{}' is not known: taken as days", escaped(defined->second), escaped(name)));
        return 1;
    }

    /// Nothing is drawn before what bears it.
    void let_bearers_come_first(std::vector<MeasuredAxis>& axes) {
        for (MeasuredAxis& axis : axes) {
            double day = axis.bearer ? axes[*axis.bearer].nodes[axis.on_node].day : 0;
            for (MeasuredNode& node : axis.nodes) {
                if (node.day < day && &node != &axis.nodes.front()) {
                    notes_.warn("a node is said to appear before what bears it: it appears with that", axis.place);
                }
                day = node.day = std::max(node.day, day);
            }
        }
    }

    // -- bearers

    void set_bearing_nodes() {
        for (RawRoot& root : file_.roots) {
            for (const RawProperty& property : root.properties) {
                if (property.term.quantity != Quantity::parent_node) continue;
                if (!root.axis.bearer) {
                    if (property.value >= 0)
                        notes_.unused("the parent-node of a root that nothing bears", root.axis.place);
                    continue;
                }
                const RawRoot& bearer = file_.roots[*root.axis.bearer];
                if (property.value < 0 || bearer.points.empty()) continue;
                if (property.value >= static_cast<double>(bearer.points.size())) {
                    notes_.warn(
                        "a parent-node beyond the last point of the root that bears is not used: the nearest "
                        "point is taken",
                        root.axis.place);
                    continue;
                }
                root.axis.on_node = static_cast<std::size_t>(property.value);
                compare_with_first(root, bearer);
            }
        }
    }

    /// An index from 1, or of another list of nodes, is told by its distance.
    void compare_with_first(const RawRoot& root, const RawRoot& bearer) {
        if (root.points.empty()) return;
        const auto distance = [&](std::size_t node) { return glm::distance(bearer.points[node], root.points.front()); };
        const std::size_t said = *root.axis.on_node;
        for (const std::size_t other : {said - 1, said + 1}) {
            if (other < bearer.points.size() && distance(other) < 1e-3 * distance(said)) {
                notes_.warn(
                    "a root begins on the neighbour of its parent-node, which counts from 0: it stands where "
                    "it begins",
                    root.axis.place);
                return;
            }
        }
    }

    std::vector<MeasuredAxis> join() {
        std::vector<measured::LooseAxis> loose;
        loose.reserve(file_.roots.size());
        for (RawRoot& root : file_.roots) {
            root.points = {};
            loose.push_back(std::move(root.axis));
        }
        return measured::joined(std::move(loose));
    }

    // -- plants

    /// Those without roots are left out.
    void name_plants(MeasuredPlants& plants) {
        std::vector<std::optional<std::size_t>> place(file_.plants.size());
        for (MeasuredAxis& axis : plants.axes) {
            std::optional<std::size_t>& at = place[axis.plant];
            if (!at) {
                at = plants.plants.size();
                plants.plants.push_back({file_.plants[axis.plant]});
            }
            axis.plant = *at;
        }
        if (file_.plants.size() > plants.plants.size()) {
            notes_.warn(fmt::format("plants without points are left out: {} of {}",
                                    file_.plants.size() - plants.plants.size(), file_.plants.size()));
        }
    }

    RawFile file_;
    std::string name_;
    const MeasuredOptions& options_;
    measured::Notes& notes_;
    std::vector<double> line_lengths_;
    std::string unit_in_words_;
    double scale_ = 1;
    glm::dmat3 axes_{1};
};

}  // namespace

MeasuredPlants read(std::string text, const std::string& name, const MeasuredOptions& options) {
    measured::Notes notes(name);
    RawFile raw = read_raw(std::move(text), name, notes);
    MeasuredPlants plants = Measuring(std::move(raw), name, options, notes).plants();
    plants.warnings = notes.warnings();
    return plants;
}

}  // namespace espalier::language::rsml
