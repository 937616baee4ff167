#include "language/sdl/translation.h"

#include "base/text.h"
#include "language/sdl/fibre_text.h"
#include "language/sdl/formula.h"
#include "language/text/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace espalier::language::sdl {
namespace {

constexpr const char* mutated = "#define MUTATED(middle, deviation) ((middle) - (deviation) + ran(2 * (deviation)))\n";
constexpr const char* turn =
    "/* away from the vertical by the horizontal angle, in the direction of the vertical one */\n"
    "#define TURN(vertical, horizontal) @R( \\\n"
    "\tsin(horizontal) * cos(vertical), cos(horizontal), sin(horizontal) * sin(vertical), \\\n"
    "\t-cos(horizontal) * cos(vertical), sin(horizontal), -cos(horizontal) * sin(vertical))\n";
constexpr const char* part = "#define PART(parts, k) clamp(begin * parts - k, 0, 1)\n";
constexpr const char* rough = "#define ROUGH(amplitude, x, y, z) amplitude * noise(x + 0.5, y + 0.5, z + grain)\n";

/// Names of the model that no component may have: symbols of the turtle, macros and words of the language.
bool is_taken(const std::string& name) {
    static const std::set<std::string> taken{"Gs",           "Gc",          "Ge",
                                             "Gt",           "Gm",          "Gf",
                                             "Tx",           "MUTATED",     "TURN",
                                             "PART",         "ROUGH",       "GENERATIONS",
                                             "length",       "vertical",    "horizontal",
                                             "waits",        "generation",  "width",
                                             "ratio",        "grain",       "begin",
                                             "lsystem",      "ring",        "seed",
                                             "derivation",   "ignore",      "consider",
                                             "define",       "start",       "Start",
                                             "end",          "End",         "axiom",
                                             "module",       "environment", "const",
                                             "field",        "maximum",     "decomposition",
                                             "homomorphism", "warnings",    "no",
                                             "endlsystem"};
    return name.size() == 1 || taken.count(name) > 0;
}

class Translation {
public:
    Translation(const Skeleton& skeleton, const std::string& file) : skeleton_(skeleton), file_(file) {
        name_components();
        name_fibres();
        for (const Rule& rule : skeleton.rules) {
            waiting_.insert(rule.master);
            for (const RightSide& side : rule.right_sides) number_branches(side.slaves, 1);
        }
        forget_unused_moves();
    }

    std::string text() const {
        std::string productions;
        for (const Rule& rule : skeleton_.rules) productions += production(rule);
        std::string decomposed;
        for (const auto& [slave, number] : branches_) decomposed += decomposition(*slave, number);
        const std::string body =
            fmt::format("axiom: {}\n\n{}{}\n{}endlsystem\n", axiom(), productions,
                        decomposed.empty() ? "" : "\ndecomposition\n" + depth() + decomposed, homomorphism());
        return head(body) + body;
    }

private:
    // --- names ------------------------------------------------------------------------------------------------------

    void name_components() {
        for (const Component& component : skeleton_.components) {
            names_[component.name] = unused(is_taken(component.name) ? component.name + "_" : component.name);
        }
    }

    void name_fibres() {
        for (const Fibre& fibre : skeleton_.fibres) {
            const std::string type = fibre.type == Fibre::Type::leaf ? "leaf" : "wooden";
            const std::string which = fibre.components.empty() ? type : type + "_" + fibre.components.front();
            fibres_.push_back({&fibre, unused(which + "_fibre"), ""});
            if (!fibre.contour.empty()) fibres_.back().along = unused("along_" + which);
        }
    }

    /// Fibres that bear nothing need no moves along their axes.
    void forget_unused_moves() {
        std::string births;
        for (const Rule& rule : skeleton_.rules) births += production(rule);
        for (const auto& [slave, number] : branches_) births += decomposition(*slave, number);
        for (FibreModules& fibre : fibres_) {
            if (births.find(fibre.along + "(") == std::string::npos) fibre.along.clear();
        }
    }

    /// The name, with as many lines behind it as make it new.
    std::string unused(std::string name) {
        while (!used_.insert(name).second) name += "_";
        return name;
    }

    const std::string& module(const std::string& component) const { return names_.at(component); }

    const FibreModules* fibre_of(const Fibre* fibre) const {
        const auto found =
            std::find_if(fibres_.begin(), fibres_.end(), [&](const auto& m) { return m.fibre == fibre; });
        return found == fibres_.end() ? nullptr : &*found;
    }

    /// Slaves with slaves of their own get numbers from 2; deeper ones are decomposed later.
    void number_branches(const std::vector<Slave>& slaves, int depth) {
        for (const Slave& slave : slaves) {
            if (slave.slaves.empty()) continue;
            branches_.push_back({&slave, int(branches_.size()) + 2});
            waiting_.insert(slave.component);
            deepest_ = std::max(deepest_, depth);
            number_branches(slave.slaves, depth + 1);
        }
    }

    int number_of(const Slave& slave) const {
        for (const auto& [known, number] : branches_) {
            if (known == &slave) return number;
        }
        return skeleton_.rule_of(slave.component) ? 1 : 0;
    }

    bool waits(const std::string& component) const { return waiting_.count(component) > 0; }

    std::string formals(const std::string& component) const {
        return std::string("(length, vertical, horizontal") + (waits(component) ? ", waits)" : ")");
    }

    // --- values -----------------------------------------------------------------------------------------------------

    static std::string value(const std::string& base, const Attribute& attribute) {
        if (!attribute.deviation) return sum(base, attribute.middle);
        const std::string draw = fmt::format("MUTATED({}, {})", attribute.middle.text, attribute.deviation->text);
        return base == "0" ? draw : base + " + " + draw;
    }

    /// A length that a component with this attribute may have is never negative.
    static std::string length(const std::string& base, const Attribute& attribute) {
        const std::string text = value(base, attribute);
        const double deviation = !attribute.deviation ? 0 : attribute.deviation->number.value_or(-1);
        const bool grows = attribute.middle.number && deviation >= 0 && *attribute.middle.number >= deviation;
        return grows ? text : "max(0, " + text + ")";
    }

    static std::string values(const Component& component, const std::array<std::string, 3>& master) {
        const std::string vertical = component.constant_ver ? "0" : master[1];
        const std::string horizontal = component.constant_hor ? "0" : master[2];
        if (component.is_null) return fmt::format("{}, {}, {}", master[0], vertical, horizontal);
        const auto& features = component.features;
        return fmt::format(
            "{}, {}, {}", marked(length(master[0], features[Component::length]), features[Component::length].at),
            marked(value(vertical, features[Component::vertical]), features[Component::vertical].at),
            marked(value(horizontal, features[Component::horizontal]), features[Component::horizontal].at));
    }

    /// Moves to where a component begins on its master.
    std::string place(const std::string& master, const Component& component) const {
        const Attribute& attribute = component.features[Component::beginning];
        std::string begin = value("0", attribute);
        if (component.is_null || begin == "0") return "";
        const bool is_known = attribute.middle.number && (!attribute.deviation || attribute.deviation->number);
        if (!is_known) begin = marked("clamp(" + begin + ", 0, 1)", attribute.at);
        const FibreModules* fibre = fibre_of(bearers(skeleton_, master).front());
        if (fibre && !fibre->along.empty()) return fmt::format("{}(length, {}) ", fibre->along, begin);
        return begin == "1" ? "f(length) " : fmt::format("f(length * {}) ", begin);
    }

    // --- productions ------------------------------------------------------------------------------------------------

    std::string axiom() const {
        if (skeleton_.components.empty()) return "*";
        const Component& start = skeleton_.start();
        std::string text = values(start, {"0", "0", "0"});
        for (const char* name : {"length", "vertical", "horizontal", "i"}) text = with_value(text, name, "0");
        const char* state = skeleton_.rule_of(start.name) ? ", 1" : ", 0";
        const std::string parameters = with_value(text, "generation", "Q");
        return marked(fmt::format("{}({}{})", module(start.name), parameters, waits(start.name) ? state : ""),
                      start.at);
    }

    std::string production(const Rule& rule) const {
        std::string text;
        for (const RightSide& side : rule.right_sides) {
            text += fmt::format("{0}{1} : waits == 1 -->\n\t{0}(length, vertical, horizontal, 0){2}",
                                module(rule.master), formals(rule.master), births(rule.master, side.slaves));
            if (side.weight && rule.right_sides.size() > 1)
                text += " : " + with_value(side.weight->text, "generation", "Q");
            text += "\n";
        }
        return marked(text, rule.at);
    }

    std::string decomposition(const Slave& slave, int number) const {
        const std::string text =
            fmt::format("{0}{1} : waits == {2} -->\n\t{0}(length, vertical, horizontal, {3}){4}\n",
                        module(slave.component), formals(slave.component), number,
                        skeleton_.rule_of(slave.component) ? 1 : 0, births(slave.component, slave.slaves));
        return marked(text, slave.at);
    }

    std::string births(const std::string& master, const std::vector<Slave>& slaves) const {
        std::string text;
        for (const Slave& slave : slaves) {
            for (int i = 0; i < slave.count; ++i) text += "\n\t" + birth(master, slave, i);
        }
        return text;
    }

    std::string birth(const std::string& master, const Slave& slave, int i) const {
        const Component& component = *skeleton_.component(slave.component);
        std::string text = fmt::format("[{}{}({}", place(master, component), module(slave.component),
                                       values(component, {"length", "vertical", "horizontal"}));
        text = with_value(with_value(text, "i", std::to_string(i)), "generation", "Q");
        text += waits(slave.component) ? fmt::format(", {})]", number_of(slave)) : ")]";
        return marked(text, slave.at);
    }

    std::string depth() const { return deepest_ > 1 ? fmt::format("maximum depth: {}\n", deepest_) : ""; }

    std::string homomorphism() const {
        std::string text = fmt::format("homomorphism\n{}", fibres_.empty() ? "" : "maximum depth: 2\n");
        for (const Component& component : skeleton_.components) {
            if (component.is_null) continue;
            const FibreModules* fibre = fibre_of(skeleton_.fibre_of(component.name));
            const std::string drawn = fmt::format("{}{} --> TURN(vertical, horizontal) [{}]\n", module(component.name),
                                                  formals(component.name), fibre ? fibre_call(*fibre) : "F(length)");
            text += marked(drawn, component.at);
        }
        for (const FibreModules& fibre : fibres_) text += fibre_productions(fibre);
        return text;
    }

    // --- the lines before the axiom ---------------------------------------------------------------------------------

    std::string declarations() const {
        std::string text;
        if (skeleton_.components.empty()) return text;
        for (const Component& component : skeleton_.components) {
            text += (text.empty() ? "module " : ", ") + module(component.name) + formals(component.name);
        }
        for (const FibreModules& fibre : fibres_) {
            text += ", " + fibre.drawn + "(length, width, ratio, grain)";
            if (!fibre.along.empty()) text += ", " + fibre.along + "(length, begin)";
        }
        return text + ";\n";
    }

    std::string head(const std::string& body) const {
        const auto uses = [&](const char* macro) { return body.find(std::string(macro) + "(") != std::string::npos; };
        const bool has_choices = std::any_of(skeleton_.rules.begin(), skeleton_.rules.end(),
                                             [](const Rule& rule) { return rule.right_sides.size() > 1; });
        std::string text = fmt::format(
            "/* Translated from {}, a skeleton description (Szemla 1999).\n   A component has "
            "its own length and angles; waits: 1 until its rule is applied. */\n\n",
            file_);
        const std::string generations = fmt::format(
            "#define GENERATIONS {}  /* derivations of the skeleton; 0.. whole */\n", skeleton_.generations);
        text += skeleton_.says_generations ? marked(generations, skeleton_.generations_at) : generations;
        if (uses("MUTATED")) text += mutated;
        if (uses("TURN")) text += turn;
        if (uses("PART")) text += part;
        if (uses("ROUGH")) text += rough;
        return text + "\nlsystem: 1\n" + declarations() + (has_choices ? "seed: 1\n" : "") +
               "derivation length: GENERATIONS\n";
    }

    const Skeleton& skeleton_;
    const std::string file_;
    std::map<std::string, std::string> names_;
    std::set<std::string> used_, waiting_;
    std::vector<FibreModules> fibres_;
    std::vector<std::pair<const Slave*, int>> branches_;
    int deepest_ = 0;
};

/// Adds the fibres that a component stands for; `seen` are NULL components on the way.
void add_bearers(const Skeleton& skeleton, const std::string& name, std::set<std::string>& seen,
                 std::vector<const Fibre*>& found);

void add_masters(const Skeleton& skeleton, const std::string& name, const std::string& master,
                 const std::vector<Slave>& slaves, std::set<std::string>& seen, std::vector<const Fibre*>& found) {
    for (const Slave& slave : slaves) {
        if (slave.component == name) add_bearers(skeleton, master, seen, found);
        add_masters(skeleton, name, slave.component, slave.slaves, seen, found);
    }
}

void add_bearers(const Skeleton& skeleton, const std::string& name, std::set<std::string>& seen,
                 std::vector<const Fibre*>& found) {
    const Component* component = skeleton.component(name);
    if (!component || !component->is_null) return found.push_back(skeleton.fibre_of(name));
    if (!seen.insert(name).second) return;
    for (const Rule& rule : skeleton.rules) {
        for (const RightSide& side : rule.right_sides) {
            add_masters(skeleton, name, rule.master, side.slaves, seen, found);
        }
    }
}

}  // namespace

std::vector<const Fibre*> bearers(const Skeleton& skeleton, const std::string& component) {
    std::set<std::string> seen;
    std::vector<const Fibre*> found;
    add_bearers(skeleton, component, seen, found);
    if (found.empty()) found.push_back(nullptr);
    return found;
}

TranslatedText model_of(const Skeleton& skeleton, const std::string& file) {
    const std::string name = std::filesystem::path(file).filename().string();
    TranslatedText translated = unmarked(Translation(skeleton, name).text(), {file});
    if (skeleton.components.empty()) {
        translated.warnings.push_back(
            {Diagnostic::Severity::warning,
             {file, 1, 1},
             "this skeleton has no components, so nothing grows: define{ start[0, 1, 0, 0]; }"});
    }
    return translated;
}

}  // namespace espalier::language::sdl
