// CPlantBox writes an element for each organ, with an element for each parameter.
#include "base/number.h"
#include "base/text.h"
#include "base/xml_reader.h"
#include "language/root_box/parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace espalier::language::root_box {
namespace {

constexpr double largest_number = 1e12;

/// Parameters that are a mean with a deviation.
/// A parameter's name, and where its value goes.
template <class Owner, class Value>
struct Row {
    std::string_view name;
    Value Owner::*member;
};

using VariedRow = Row<RootType, Varied>;
constexpr std::array varied_rows{
    VariedRow{"lb", &RootType::basal_zone}, VariedRow{"la", &RootType::apical_zone},
    VariedRow{"ln", &RootType::spacing},    VariedRow{"lmax", &RootType::final_length},
    VariedRow{"r", &RootType::rate},        VariedRow{"a", &RootType::radius},
    VariedRow{"theta", &RootType::angle},   VariedRow{"rlt", &RootType::life_time},
};

using NumberRow = Row<RootType, double>;
constexpr std::array number_rows{
    NumberRow{"tropismN", &RootType::trials},
    NumberRow{"tropismS", &RootType::sigma},
    NumberRow{"dx", &RootType::resolution},
};

using WholeRow = Row<RootType, int>;
constexpr std::array whole_rows{
    WholeRow{"gf", &RootType::growth},
    WholeRow{"tropismT", &RootType::tropism},
    WholeRow{"subType", &RootType::type},
};

using SeedRow = Row<Seed, double>;
constexpr std::array seed_rows{
    SeedRow{"firstB", &Seed::first_basal},
    SeedRow{"delayB", &Seed::delay_basal},
    SeedRow{"maxB", &Seed::most_basal},
};

/// What says nothing that a model needs.
constexpr std::array silent{"organType", "colorR", "colorG", "colorB", "RotBeta", "BetaDev", "InitBeta"};

class ElementReader final : public XmlReader {
public:
    ElementReader(const std::string& name, measured::Notes& notes) : XmlReader(name), notes_(notes) {}

    RootParameters read(const std::string& text) {
        parse(text);
        if (parameters_.types.empty()) {
            throw UserError(Place{here().file, 1, 1}, "this file has no <organ type=\"root\"> of CPlantBox");
        }
        return std::move(parameters_);
    }

private:
    enum class Organ { none, root, seed, other };

    double number(std::string_view text, std::string_view what) const {
        const std::optional<double> value = finite_number(text);
        if (!value || std::abs(*value) > largest_number) {
            fail(fmt::format("{} is a number, not '{}'", what, escaped(text)));
        }
        return *value;
    }

    void begin(const std::string& element, const XmlAttributes& attributes) override {
        ++depth_;
        if (element == "parameter" && organ_ != Organ::none) return begin_parameter(attributes);
        const std::string kind = element == "organ" ? attributes.value("type") : element;
        if (organ_ == Organ::none && (kind == "root" || kind == "seed" || kind == "stem" || kind == "leaf")) {
            return begin_organ(kind, attributes);
        }
        if (depth_ > 1) notes_.unused("element <" + element + ">", here());
    }

    void end(const std::string& /*element*/) override {
        if (--depth_ >= organ_depth_) return;
        if (organ_ == Organ::root) end_root();
        organ_ = Organ::none;
        organ_depth_ = 0;
    }

    void begin_organ(const std::string& kind, const XmlAttributes& attributes) {
        organ_depth_ = depth_;
        organ_ = kind == "root" ? Organ::root : kind == "seed" ? Organ::seed : Organ::other;
        if (organ_ == Organ::other) notes_.unused(fmt::format("organ '{}'", kind), here());
        if (organ_ != Organ::root) return;
        root_ = {};
        root_.place = here();
        root_.name = attributes.value("name");
        const std::string type = attributes.value("subType");
        if (!type.empty()) root_.type = whole(type, "subType");
        said_.clear();
    }

    int whole(std::string_view text, std::string_view what) const {
        const double value = number(text, what);
        if (value != std::floor(value) || value < -1 || value > 99) {
            fail(fmt::format("{} is a whole number up to 99, not '{}'", what, escaped(text)));
        }
        return static_cast<int>(value);
    }

    void begin_parameter(const XmlAttributes& attributes) {
        const std::string name = attributes.value("name"), value = attributes.value("value");
        if (organ_ == Organ::seed) return seed_parameter(name, value);
        if (organ_ != Organ::root) return;
        if (name == "successor") return add_successor(attributes);
        for (const VariedRow& row : varied_rows) {
            if (row.name != name) continue;
            const std::string deviation = attributes.value("dev");
            root_.*row.member = {number(value, name), deviation.empty() ? 0 : number(deviation, name)};
            said_.insert(name);
            return;
        }
        for (const NumberRow& row : number_rows) {
            if (row.name == name) return void(root_.*row.member = number(value, name));
        }
        for (const WholeRow& row : whole_rows) {
            if (row.name == name) return void(root_.*row.member = whole(value, name));
        }
        if (std::find(silent.begin(), silent.end(), name) == silent.end()) {
            notes_.unused(fmt::format("parameter '{}'", name), here());
        }
    }

    void add_successor(const XmlAttributes& attributes) {
        const std::string type = attributes.value(attributes.has("subType") ? "subType" : "type");
        const std::string chance = attributes.value("percentage");
        const std::string organ = attributes.value("organType"), count = attributes.value("numLat");
        if (!organ.empty() && organ != "2") return notes_.unused("a successor that is no root", here());
        if (!count.empty() && count != "1") notes_.unused("'numLat' of a successor", here());
        root_.successors.push_back(whole(type, "the type of a successor"));
        root_.chances.push_back(chance.empty() ? 1 : number(chance, "the percentage of a successor"));
    }

    void seed_parameter(const std::string& name, const std::string& value) {
        Seed& seed = parameters_.seed;
        for (const SeedRow& row : seed_rows) {
            if (row.name == name) return void(seed.*row.member = number(value, name));
        }
        if (name == "seedPos.z") return void(seed.depth = -number(value, name));
        if (name == "simtime" || name == "simulationTime") return void(seed.days = number(value, name));
        const bool is_silent = std::find(silent.begin(), silent.end(), name) != silent.end() || name == "subType";
        if (!is_silent) notes_.unused(fmt::format("parameter '{}' of the seed", name), here());
    }

    void end_root() {
        for (const char* const name : {"lmax", "r", "a", "theta"}) {
            if (said_.contains(name)) continue;
            notes_.warn(fmt::format("a type of roots does not say its '{}': that of CPlantBox counts", name),
                        root_.place);
        }
        if (root_.type < 0 || root_.type > 99) fail("subType of a root is a whole number from 0 to 99");
        // CPlantBox keeps defaults of organs as subType 0.
        if (root_.type == 0) return;
        parameters_.types[root_.type] = root_;
    }

    measured::Notes& notes_;
    RootParameters parameters_;
    RootType root_;
    std::set<std::string> said_;
    Organ organ_ = Organ::none;
    int depth_ = 0, organ_depth_ = 0;
};

}  // namespace

RootParameters read_elements(const std::string& text, const std::string& name, measured::Notes& notes) {
    return ElementReader(name, notes).read(text);
}

}  // namespace espalier::language::root_box
