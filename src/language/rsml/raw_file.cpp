#include "language/rsml/raw_file.h"

#include "base/number.h"
#include "base/text.h"
#include "base/xml_reader.h"
#include "language/measured/notes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>

namespace espalier::language::rsml {
namespace {

std::optional<double> property_of(const RawRoot& root, Quantity quantity) {
    for (const RawProperty& property : root.properties) {
        if (property.term.quantity == quantity) return property.value;
    }
    return std::nullopt;
}

/// One for each point; NaN where there are none.
void pad(std::vector<double>& samples, std::size_t points) {
    samples.resize(points, std::numeric_limits<double>::quiet_NaN());
}

void append_functions(RawRoot& root, const RawRoot& piece, std::size_t before, measured::Notes& notes) {
    for (const RawFunction& further : piece.functions) {
        auto known = std::find_if(root.functions.begin(), root.functions.end(),
                                  [&](const RawFunction& each) { return each.name == further.name; });
        if (known == root.functions.end()) {
            root.functions.push_back(further);
            known = std::prev(root.functions.end());
            known->samples.clear();
        }
        if (known->domain != Domain::polyline || further.domain != Domain::polyline) {
            notes.unused("a function along the length of a root that continues another", further.place);
            continue;
        }
        pad(known->samples, before);
        known->samples.insert(known->samples.end(), further.samples.begin(), further.samples.end());
    }
    for (RawFunction& function : root.functions) {
        if (function.domain == Domain::polyline) pad(function.samples, root.points.size());
    }
}

void append(RawRoot& root, const RawRoot& piece, measured::Notes& notes) {
    const std::size_t before = root.points.size();
    if (before > 0 && !piece.points.empty()) root.breaks.push_back(before);
    for (const std::size_t at : piece.breaks) root.breaks.push_back(before + at);
    root.points.insert(root.points.end(), piece.points.begin(), piece.points.end());
    append_functions(root, piece, before, notes);
    for (RawProperty& property : root.properties) {
        if (property.term.quantity == Quantity::length)
            property.value += property_of(piece, Quantity::length).value_or(0);
    }
}

/// Where the pieces of roots are now.
struct Piece {
    std::size_t root;        ///< that it is a piece of
    std::size_t before = 0;  ///< so many points of that come before its own
};

void hang_on_whole(RawRoot& lateral, const std::vector<Piece>& pieces) {
    if (!lateral.axis.bearer) return;
    const Piece& bearer = pieces[*lateral.axis.bearer];
    lateral.axis.bearer = bearer.root;
    for (RawProperty& property : lateral.properties) {
        if (property.term.quantity == Quantity::parent_node) property.value += static_cast<double>(bearer.before);
    }
}

/// A root with a property `continues` is a further piece of the root of that ID, which stands before it: both become
/// one, with a gap between their points.
void join_continued(RawFile& file, const std::map<double, std::size_t>& root_of_id, measured::Notes& notes) {
    std::vector<Piece> pieces;
    std::vector<std::size_t> place;  // of roots among those that are left
    std::vector<RawRoot> whole;
    for (RawRoot& root : file.roots) {
        const std::size_t number = pieces.size();
        place.push_back(whole.size());
        pieces.push_back({number});
        if (const std::optional<double> id = property_of(root, Quantity::continues)) {
            const auto found = root_of_id.find(*id);
            if (found != root_of_id.end() && found->second < number) {
                const std::size_t before = pieces[found->second].root;
                pieces.back() = {before, whole[place[before]].points.size()};
                append(whole[place[before]], root, notes);
                continue;
            }
            notes.warn("a root continues none that stands before it: it is one of its own", root.axis.place);
        }
        hang_on_whole(root, pieces);
        if (root.axis.bearer) root.axis.bearer = place[*root.axis.bearer];
        whole.push_back(std::move(root));
    }
    file.roots = std::move(whole);
}

constexpr std::size_t most_orders = 60;
constexpr double largest_number = 1e12;
constexpr std::string_view blanks = " \t\r\n";

class RawReader final : public XmlReader {
public:
    RawReader(const std::string& name, measured::Notes& notes) : XmlReader(name), notes_(notes) {}

    RawFile read(std::string text) {
        parse(std::move(text));
        if (!is_rsml_) fail("this is no RSML file: its outermost element is not <rsml>");
        if (!bookkeeping_.empty()) notes_.unused("metadata " + bookkeeping_, bookkeeping_place_);
        if (has_continued_) join_continued(file_, root_of_id_, notes_);
        return std::move(file_);
    }

private:
    // -- numbers

    double number(std::string_view text, const std::string& what) const {
        const std::optional<double> value = finite_number(trimmed(text, blanks));
        if (!value || std::abs(*value) > largest_number) fail(fmt::format("{} is a number, not '{}'", what, text));
        return *value;
    }

    /// A value that was not measured is NaN.
    double measured_number(std::string_view text, const std::string& what) const {
        const std::string word = plain_name(trimmed(text, blanks));
        if (word.empty() || word == "nan" || word == "na" || word == "null") {
            return std::numeric_limits<double>::quiet_NaN();
        }
        return number(text, what);
    }

    // -- elements

    void begin(const std::string& element, const XmlAttributes& attributes) override {
        const Scope around = open_.empty() ? Scope::outside : open_.back();
        if (around == Scope::point || around == Scope::sample) {
            unused("element <" + element + ">");
            return open_.push_back(Scope::unused);
        }
        const std::string name = plain_name(element);
        const Scope scope = scope_of(around, name).value_or(Scope::unused);
        open_.push_back(scope);
        switch (scope) {
            case Scope::document:
                is_rsml_ = true;
                break;
            case Scope::plant:
                return begin_plant(attributes);
            case Scope::root:
                return begin_root(attributes);
            case Scope::polyline:
                return begin_polyline();
            case Scope::point:
                return add_point(attributes);
            case Scope::functions:
            case Scope::function:
                return begin_function(name, attributes);
            case Scope::sample:
                return begin_sample(attributes);
            case Scope::property:
                return begin_property(element, attributes);
            case Scope::definition:
                defined_name_.clear();
                break;
            case Scope::bookkeeping:
                note_bookkeeping(name, around);
                break;
            case Scope::unused:
                if (around != Scope::unused) unused("element <" + element + ">");
                break;
            default:
                break;
        }
    }

    void end(const std::string& /*element*/) override {
        const Scope scope = open_.back();
        open_.pop_back();
        switch (scope) {
            case Scope::unit:
                file_.unit = trimmed(text(), blanks);
                break;
            case Scope::up:
                file_.up = plain_name(trimmed(text(), blanks));
                break;
            case Scope::software:
                file_.software = trimmed(text(), blanks);
                break;
            case Scope::resolution:
                end_resolution();
                break;
            case Scope::defined_name:
                defined_name_ = plain_name(trimmed(text(), blanks));
                break;
            case Scope::defined_unit:
                file_.defined_unit[defined_name_] = trimmed(text(), blanks);
                break;
            case Scope::plant:
                plant_.reset();
                break;
            case Scope::root:
                open_roots_.pop_back();
                break;
            case Scope::functions:
            case Scope::function:
                end_function();
                break;
            case Scope::sample:
                end_sample();
                break;
            case Scope::property:
                end_property();
                break;
            default:
                break;
        }
    }

    void unused(const std::string& what) { notes_.unused(what, here()); }

    void note_bookkeeping(const std::string& name, Scope around) {
        if (around != Scope::metadata || name == "version") return;
        if (bookkeeping_.empty()) bookkeeping_place_ = here();
        bookkeeping_ += (bookkeeping_.empty() ? "<" : ", <") + name + ">";
    }

    void end_resolution() {
        if (trimmed(text(), blanks).empty()) return;
        const double resolution = number(text(), "the resolution");
        if (resolution > 0) {
            file_.resolution = resolution;
        } else {
            notes_.warn(fmt::format("a resolution of {} is none: it is not used", resolution), here());
        }
    }

    // -- plants and roots

    RawRoot& root() { return file_.roots[open_roots_.back()]; }

    void begin_plant(const XmlAttributes& attributes) {
        std::string label, id;
        attributes.each([&](std::string_view name, std::string_view value) {
            const std::string plain = plain_name(name);
            if (plain == "label")
                label = value;
            else if (plain == "id")
                id = value;
            else
                unused(fmt::format("attribute '{}' of <plant>", name));
        });
        plant_ = file_.plants.size();
        file_.plants.push_back(label.empty() ? id : label);
    }

    void begin_root(const XmlAttributes& attributes) {
        if (open_roots_.size() > most_orders) fail(fmt::format("roots are nested deeper than {}", most_orders));
        if (!plant_) begin_plant(XmlAttributes(no_attributes.data()));
        RawRoot& root = file_.roots.emplace_back();
        root.axis.place = here();
        root.axis.plant = *plant_;
        if (!open_roots_.empty()) root.axis.bearer = open_roots_.back();
        open_roots_.push_back(file_.roots.size() - 1);
        attributes.each([&](std::string_view name, std::string_view value) {
            const std::string plain = plain_name(name);
            if (plain == "label")
                root.axis.label = value;
            else if (plain == "id")
                note_id(value);
            else if (term_of(plain))
                add_property(std::string(name), value);
            else
                unused(fmt::format("attribute '{}' of <root>", name));
        });
    }

    void note_id(std::string_view id) {
        const std::optional<double> number = finite_number(id);
        if (number) root_of_id_.emplace(*number, open_roots_.back());
    }

    void begin_polyline() {
        if (!root().points.empty()) root().breaks.push_back(root().points.size());
    }

    void add_point(const XmlAttributes& attributes) {
        glm::dvec3 point(0);
        bool has_x = false, has_y = false;
        attributes.each([&](std::string_view name, std::string_view value) {
            const char letter = name.size() == 1 ? static_cast<char>(name[0] | 0x20) : '\0';
            if (letter == 'x')
                point.x = number(value, "x"), has_x = true;
            else if (letter == 'y')
                point.y = number(value, "y"), has_y = true;
            else if (letter == 'z')
                point.z = number(value.empty() ? "0" : value, "z");
            else
                unused(fmt::format("attribute '{}' of <point>", name));
        });
        if (!has_x || !has_y) fail(fmt::format("this point has no {}: x is a number, y, too", has_x ? "y" : "x"));
        if (point.z != 0) file_.is_flat = false;
        root().points.push_back(point);
    }

    // -- properties and functions

    void add_property(const std::string& name, std::string_view text) {
        const Term term = *term_of(name);
        const double value = measured_number(text, name);
        if (std::isnan(value)) return;
        root().properties.push_back({plain_name(name), term, value});
        if (term.quantity == Quantity::continues) has_continued_ = true;
    }

    void begin_property(const std::string& element, const XmlAttributes& attributes) {
        property_ = element;
        property_value_.reset();
        attributes.each([&](std::string_view name, std::string_view value) {
            const std::string plain = plain_name(name);
            if (plain == "name" || plain == "label")
                property_ = value;
            else if (plain == "value")
                property_value_ = std::string(value);
            else
                unused(fmt::format("attribute '{}' of a property", name));
        });
    }

    void end_property() {
        if (!term_of(property_)) return unused("property '" + property_ + "'");
        add_property(property_, property_value_ ? *property_value_ : text());
    }

    void begin_function(const std::string& element, const XmlAttributes& attributes) {
        RawFunction function;
        function.place = here();
        attributes.each([&](std::string_view name, std::string_view value) {
            const std::string plain = plain_name(name);
            if (plain == "name")
                function.name = value;
            else if (plain == "domain")
                function.domain = domain(value);
            else if (plain == "origin")
                function.origin = number(value, "origin");
            else if (plain == "step")
                function.step = number(value, "step");
            else
                unused(fmt::format("attribute '{}' of <{}>", name, element));
        });
        functions_.push_back(std::move(function));
    }

    Domain domain(std::string_view name) const {
        const std::string plain = plain_name(name);
        if (plain.empty() || plain == "polyline") return Domain::polyline;
        if (plain == "length") return Domain::length;
        if (plain == "uniform") return Domain::uniform;
        fail(fmt::format("the domain of a function is polyline, length or uniform, not '{}'", name));
    }

    void begin_sample(const XmlAttributes& attributes) {
        sample_.reset();
        attributes.each([&](std::string_view name, std::string_view value) {
            const std::string plain = plain_name(name);
            if (plain == "value")
                sample_ = std::string(value);
            else if (plain == "position")
                functions_.back().positions.push_back(number(value, "position"));
            else
                unused(fmt::format("attribute '{}' of <sample>", name));
        });
    }

    void end_sample() {
        RawFunction& function = functions_.back();
        if (!term_of(function.name)) return;
        function.samples.push_back(measured_number(sample_ ? *sample_ : text(), function.name));
    }

    /// <functions> without a name is a list of functions.
    void end_function() {
        RawFunction function = std::move(functions_.back());
        functions_.pop_back();
        const std::optional<Term> term = term_of(function.name);
        if (!term) {
            if (!function.name.empty()) notes_.unused("function '" + function.name + "'", function.place);
            return;
        }
        if (!function.positions.empty() && function.positions.size() != function.samples.size()) {
            fail(fmt::format("function '{}' has {} positions for {} samples", function.name, function.positions.size(),
                             function.samples.size()));
        }
        function.name = plain_name(function.name);
        function.term = *term;
        if (!function.samples.empty()) root().functions.push_back(std::move(function));
    }

    static constexpr std::array<const char*, 1> no_attributes{nullptr};

    measured::Notes& notes_;
    RawFile file_;
    std::vector<Scope> open_;
    std::vector<std::size_t> open_roots_;
    std::vector<RawFunction> functions_;  ///< that are open
    std::optional<std::size_t> plant_;
    std::string property_, defined_name_, bookkeeping_;
    std::optional<std::string> property_value_, sample_;
    Place bookkeeping_place_;
    std::map<double, std::size_t> root_of_id_;  ///< of IDs that are numbers
    bool is_rsml_ = false, has_continued_ = false;
};

}  // namespace

RawFile read_raw(std::string text, const std::string& name, measured::Notes& notes) {
    return RawReader(name, notes).read(std::move(text));
}

}  // namespace espalier::language::rsml
