#include "language/rsml/document.h"

#include "base/number.h"
#include "base/text.h"
#include "base/xml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace espalier::language::rsml {
namespace {

constexpr int most_orders = 60;
constexpr double diameter_if_unknown = 0.0005;  ///< m

/// A root as the file has it.
struct RawRoot {
    Root root;
    std::vector<glm::dvec3> points;
    std::map<std::string, std::vector<double>> functions;
    std::optional<double> diameter;
};

class Reader final : public XmlReader {
public:
    explicit Reader(const std::string& name) : XmlReader(name) {}

    Document read(const std::string& text) {
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
        if (!open_.empty()) {
            root.root.bearer = open_.back();
            root.root.order = roots_[open_.back()].root.order + 1;
            if (root.root.order > most_orders) fail(fmt::format("roots are nested deeper than {}", most_orders));
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
        static const std::map<std::string, double> units{{"m", 1},     {"cm", 0.01},     {"mm", 0.001},
                                                         {"um", 1e-6}, {"inch", 0.0254}, {"dm", 0.1}};
        const auto found = units.find(unit_.value_or("cm"));
        if (found == units.end()) {
            throw UserError(Place{here().file, 1, 1},
                            fmt::format("the unit '{}' is no length: write m, cm, mm, um or inch as "
                                        "<unit>, and pixels per unit as <resolution>",
                                        *unit_));
        }
        return found->second / (resolution_ > 0 ? resolution_ : 1);
    }

    /// The file's axes to x, upwards, and towards us.
    glm::dvec3 upright(const glm::dvec3& point) const {
        if (up_ == "y") return point;
        if (flat_) return {point.x, -point.y, 0};
        const RawRoot& first = roots_[0];
        const bool down = up_ != "z" && first.points.back().z > first.points.front().z;
        return down ? glm::dvec3(point.x, -point.z, point.y) : glm::dvec3(point.x, point.z, -point.y);
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

    Document finished() const {
        Document document;
        const double scale = metres();
        for (const RawRoot& raw : roots_) {
            Root root = raw.root;
            const std::vector<double> diameters = samples(raw, {"diameter"});
            const std::vector<double> times = samples(raw, {"node_creation_time", "emergence_time", "time"});
            document.has_times = document.has_times || !times.empty();
            for (std::size_t i = 0; i < raw.points.size(); ++i) {
                double diameter = raw.diameter ? scale * *raw.diameter : diameter_if_unknown;
                if (!diameters.empty()) diameter = scale * diameters[i];
                root.nodes.push_back(
                    {scale * upright(raw.points[i]), std::max(diameter, 0.0), times.empty() ? 0 : times[i]});
            }
            document.roots.push_back(std::move(root));
        }
        return document;
    }

    std::vector<RawRoot> roots_;
    std::vector<std::size_t> open_;
    std::string function_, sample_, up_;
    std::optional<std::string> unit_;
    double resolution_ = 1;
    bool is_rsml_ = false, flat_ = true;
};

}  // namespace

Document read(const std::string& text, const std::string& name) {
    return Reader(name).read(text);
}

}  // namespace espalier::language::rsml
