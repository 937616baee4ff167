#include "language/rsml/document.h"

#include "base/number.h"
#include "base/text.h"
#include "base/xml_reader.h"
#include "language/measured/joining.h"
#include "language/measured/notes.h"
#include "language/measured/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace espalier::language::rsml {
namespace {

constexpr std::size_t most_orders = 60;
constexpr double diameter_if_unknown = 0.0005;  ///< m

using measured::LooseAxis;

/// A root as the file has it.
struct RawRoot {
    LooseAxis root;
    std::vector<glm::dvec3> points;
    std::map<std::string, std::vector<double>> functions;
    std::optional<double> diameter;
};

class Reader final : public XmlReader {
public:
    Reader(const std::string& name, const MeasuredOptions& options)
        : XmlReader(name), options_(options), notes_(name) {}

    MeasuredPlants read(const std::string& text) {
        parse(text);
        if (!is_rsml_) fail("this is no RSML file: its outermost element is not <rsml>");
        if (roots_.empty()) fail("this file has no roots");
        return finished();
    }

private:
    double number(const std::string& text, const std::string& what) const {
        const std::vector<std::string> words = words_of(text, " \t\r\n");
        const std::optional<double> value = words.size() == 1 ? finite_number(words[0]) : std::nullopt;
        if (!value || std::abs(*value) > 1e12) fail(fmt::format("{} is a number, not '{}'", what, text));
        return *value;
    }

    void begin(const std::string& element, const XmlAttributes& attributes) override {
        if (element == "rsml") is_rsml_ = true;
        if (element == "plant") plants_.push_back({attributes.value("label")});
        if (element == "root") return begin_root(attributes);
        if (open_.empty()) return;
        RawRoot& root = roots_[open_.back()];
        if (element == "point") {
            const std::string z = attributes.value("z");
            flat_ = flat_ && z.empty();
            root.points.emplace_back(number(attributes.value("x"), "x"), number(attributes.value("y"), "y"),
                                     z.empty() ? 0 : number(z, "z"));
        } else if (element == "function") {
            function_ = attributes.value("name");
        } else if (element == "sample") {
            sample_ = attributes.value("value");
        } else if (element == "parent-node") {
            const double node = number(attributes.value("value"), "parent-node");
            if (node >= 0) root.root.on_node = static_cast<std::size_t>(node);
        } else if (element == "diameter") {
            const std::string value = attributes.value("value");
            if (!value.empty()) root.diameter = number(value, "diameter");
        }
    }

    void begin_root(const XmlAttributes& attributes) {
        RawRoot root;
        root.root.place = here();
        root.root.label = attributes.value("label");
        root.root.plant = plants_.empty() ? 0 : plants_.size() - 1;
        if (!open_.empty()) {
            root.root.bearer = open_.back();
            if (open_.size() > most_orders) fail(fmt::format("roots are nested deeper than {}", most_orders));
        }
        open_.push_back(roots_.size());
        roots_.push_back(std::move(root));
    }

    void end(const std::string& element) override {
        if (element == "unit" && open_.empty() && !unit_) unit_ = trimmed_text();
        if (element == "resolution" && open_.empty()) resolution_ = number(text(), "resolution");
        if (element == "up" && open_.empty()) up_ = trimmed_text();
        if (open_.empty()) return;
        if (element == "sample") {
            roots_[open_.back()].functions[function_].push_back(number(sample_.empty() ? text() : sample_, function_));
        }
        if (element == "root") {
            if (roots_[open_.back()].points.empty()) fail("this root has no points");
            open_.pop_back();
        }
    }

    std::string trimmed_text() const {
        const std::vector<std::string> words = words_of(text(), " \t\r\n");
        return words.empty() ? "" : words[0];
    }

    double metres() const {
        if (options_.pixel) return *options_.pixel;
        const std::optional<double> metres =
            options_.unit.empty() ? measured::metres_of(unit_.value_or("cm")) : measured::metres_of_unit(options_.unit);
        if (metres) return *metres / (resolution_ > 0 ? resolution_ : 1);
        throw UserError(Place{here().file, 1, 1},
                        fmt::format("the unit '{}' is no length: write m, cm, mm, um or inch as "
                                    "<unit>, and pixels per unit as <resolution>",
                                    *unit_));
    }

    /// Which of the file's axes points upwards.
    std::string up() const {
        if (!options_.up.empty()) return options_.up;
        if (up_ == "y" || up_ == "z") return up_;
        if (flat_) return "-y";
        const RawRoot& first = roots_[0];
        return first.points.back().z > first.points.front().z ? "-z" : "z";
    }

    /// The samples of a function for every node; empty if there are none.
    static std::vector<double> samples(const RawRoot& root, std::initializer_list<const char*> names) {
        for (const char* const name : names) {
            const auto found = root.functions.find(name);
            if (found == root.functions.end() || found->second.empty()) continue;
            std::vector<double> values = found->second;
            values.resize(root.points.size(), values.back());
            return values;
        }
        return {};
    }

    MeasuredPlants finished() {
        MeasuredPlants plants;
        const double scale = metres();
        const glm::dmat3 axes = scale * measured::upright(up());
        std::vector<LooseAxis> loose;
        for (RawRoot& raw : roots_) {
            const std::vector<double> diameters = samples(raw, {"diameter"});
            const std::vector<double> times = samples(raw, {"node_creation_time", "emergence_time", "time"});
            plants.has_times = plants.has_times || !times.empty();
            for (std::size_t i = 0; i < raw.points.size(); ++i) {
                double diameter = raw.diameter ? scale * *raw.diameter : diameter_if_unknown;
                if (!diameters.empty()) diameter = scale * diameters[i];
                raw.root.nodes.push_back({axes * raw.points[i], std::max(diameter, 0.0), times.empty() ? 0 : times[i]});
            }
            loose.push_back(std::move(raw.root));
        }
        plants.axes = measured::joined(std::move(loose));
        plants.plants = std::move(plants_);
        if (plants.plants.empty()) plants.plants.emplace_back();
        plants.unit = unit_.value_or("cm");
        plants.up = up();
        plants.warnings = notes_.warnings();
        return plants;
    }

    const MeasuredOptions& options_;
    measured::Notes notes_;
    std::vector<MeasuredPlant> plants_;
    std::vector<RawRoot> roots_;
    std::vector<std::size_t> open_;
    std::string function_, sample_, up_;
    std::optional<std::string> unit_;
    double resolution_ = 1;
    bool is_rsml_ = false, flat_ = true;
};

}  // namespace

MeasuredPlants read(const std::string& text, const std::string& name, const MeasuredOptions& options) {
    return Reader(name, options).read(text);
}

}  // namespace espalier::language::rsml
