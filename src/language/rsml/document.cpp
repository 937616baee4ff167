#include "language/rsml/document.h"

#include "base/number.h"
#include "base/text.h"

#include <climits>
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <expat.h>
#include <map>
#include <memory>

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

class Reader {
public:
    Reader(const std::string& name) : name_(name), parser_(XML_ParserCreate(nullptr), XML_ParserFree) {
        XML_SetUserData(parser_.get(), this);
        XML_SetElementHandler(
            parser_.get(),
            [](void* self, const char* element, const char** attributes) {
                static_cast<Reader*>(self)->guarded([&](Reader& reader) { reader.begin(element, attributes); });
            },
            [](void* self, const char* element) {
                static_cast<Reader*>(self)->guarded([&](Reader& reader) { reader.end(element); });
            });
        XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* text, int length) {
            static_cast<Reader*>(self)->text_.append(text, static_cast<std::size_t>(length));
        });
        XML_SetEntityDeclHandler(parser_.get(), [](void* self, const char*, int, const char*, int, const char*,
                                                   const char*, const char*, const char*) {
            static_cast<Reader*>(self)->guarded([](Reader& reader) { reader.fail("entities are not read here"); });
        });
    }

    Document read(const std::string& text) {
        if (text.size() > INT_MAX) fail("this file is too long");
        const XML_Status status = XML_Parse(parser_.get(), text.data(), static_cast<int>(text.size()), 1);
        if (mistake_) std::rethrow_exception(mistake_);
        if (status != XML_STATUS_OK) fail(XML_ErrorString(XML_GetErrorCode(parser_.get())));
        if (!is_rsml_) fail("this is no RSML file: its outermost element is not <rsml>");
        if (roots_.empty()) fail("this file has no roots");
        return finished();
    }

private:
    /// No exception passes through expat.
    template <class Work>
    void guarded(Work work) {
        if (mistake_) return;
        try {
            work(*this);
        } catch (...) {
            mistake_ = std::current_exception();
            XML_StopParser(parser_.get(), XML_FALSE);
        }
    }

    Place here() const {
        return {name_, static_cast<int>(XML_GetCurrentLineNumber(parser_.get())),
                static_cast<int>(XML_GetCurrentColumnNumber(parser_.get())) + 1};
    }

    [[noreturn]] void fail(const std::string& message) const { throw UserError(here(), message); }

    static std::string attribute(const char** attributes, const std::string& name) {
        for (; *attributes; attributes += 2) {
            if (name == attributes[0]) return attributes[1];
        }
        return "";
    }

    double number(const std::string& text, const std::string& what) const {
        const std::vector<std::string> words = words_of(text, " \t\r\n");
        const std::optional<double> value = words.size() == 1 ? finite_number(words[0]) : std::nullopt;
        if (!value || std::abs(*value) > 1e12) fail(fmt::format("{} is a number, not '{}'", what, text));
        return *value;
    }

    void begin(const std::string& element, const char** attributes) {
        text_.clear();
        if (element == "rsml") is_rsml_ = true;
        if (element == "root") return begin_root(attributes);
        if (open_.empty()) return;
        RawRoot& root = roots_[open_.back()];
        if (element == "point") {
            const std::string z = attribute(attributes, "z");
            flat_ = flat_ && z.empty();
            root.points.emplace_back(number(attribute(attributes, "x"), "x"), number(attribute(attributes, "y"), "y"),
                                     z.empty() ? 0 : number(z, "z"));
        } else if (element == "function") {
            function_ = attribute(attributes, "name");
        } else if (element == "sample") {
            sample_ = attribute(attributes, "value");
        } else if (element == "parent-node") {
            const double node = number(attribute(attributes, "value"), "parent-node");
            if (node >= 0) root.root.on_node = static_cast<std::size_t>(node);
        } else if (element == "diameter") {
            const std::string value = attribute(attributes, "value");
            if (!value.empty()) root.diameter = number(value, "diameter");
        }
    }

    void begin_root(const char** attributes) {
        RawRoot root;
        root.root.place = here();
        root.root.label = attribute(attributes, "label");
        if (!open_.empty()) {
            root.root.bearer = open_.back();
            root.root.order = roots_[open_.back()].root.order + 1;
            if (root.root.order > most_orders) fail(fmt::format("roots are nested deeper than {}", most_orders));
        }
        open_.push_back(roots_.size());
        roots_.push_back(std::move(root));
    }

    void end(const std::string& element) {
        if (element == "unit" && open_.empty() && !unit_) unit_ = trimmed_text();
        if (element == "resolution" && open_.empty()) resolution_ = number(text_, "resolution");
        if (element == "up" && open_.empty()) up_ = trimmed_text();
        if (open_.empty()) return;
        if (element == "sample") {
            roots_[open_.back()].functions[function_].push_back(number(sample_.empty() ? text_ : sample_, function_));
        }
        if (element == "root") {
            if (roots_[open_.back()].points.empty()) fail("this root has no points");
            open_.pop_back();
        }
        text_.clear();
    }

    std::string trimmed_text() const {
        const std::vector<std::string> words = words_of(text_, " \t\r\n");
        return words.empty() ? "" : words[0];
    }

    double metres() const {
        static const std::map<std::string, double> units{{"m", 1},     {"cm", 0.01},     {"mm", 0.001},
                                                         {"um", 1e-6}, {"inch", 0.0254}, {"dm", 0.1}};
        const auto found = units.find(unit_.value_or("cm"));
        if (found == units.end()) {
            throw UserError(Place{name_, 1, 1},
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

    std::string name_;
    std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_;
    std::exception_ptr mistake_;
    std::vector<RawRoot> roots_;
    std::vector<std::size_t> open_;
    std::string text_, function_, sample_, up_;
    std::optional<std::string> unit_;
    double resolution_ = 1;
    bool is_rsml_ = false, flat_ = true;
};

}  // namespace

Document read(const std::string& text, const std::string& name) {
    return Reader(name).read(text);
}

}  // namespace espalier::language::rsml
