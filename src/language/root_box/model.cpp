// The model of a root system: axes that approach their final lengths, and bear laterals at given places.
#include "base/text.h"
#include "language/root_box/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>

namespace espalier::language::root_box {
namespace {

constexpr double days_if_unknown = 30;
constexpr double endless = 1e9;        ///< days
constexpr double most_branches = 1e6;  ///< of one root

constexpr int gravitropism = 1, linear_growth = 2;

/// What the growth of all types shares; a type is a row of the arrays.
constexpr const char* rules = R"(
#define VARIED(mean, deviation) max(nran(mean, VARIATION * (deviation)), 0)
#define FINAL(n, lb, la, ln, m) ((n) > 0 ? (lb) + (la) + ((n) - 1) * (ln) : (m))
#define LENGTH(o, t, k, r) ((k) <= 0 ? 0 : LINEAR[o] ? min(k, (r) * (t)) : (k) * (1 - exp(-(r) * (t) / (k))))
#define GROWN(o, t, k, r, q) ((t) > 0 ? LENGTH(o, min(t, q), k, r) : 0)
#define AGE(o, l, k, r) ((l) >= (k) * (1 - 0.000000001) ? 1000000000 : LINEAR[o] ? (l) / (r) : -(k) / (r) * log(1 - (l) / (k)))
#define NODE(o, l) ((floor((l) / DX[o] + 0.000001) + 1) * DX[o])
#define BRANCH(i, n, lb, ln) ((i) < (n) ? (lb) + (i) * (ln) : 1000000000)

lsystem: 1
derivation length: @DAYS@ / DT
@ARRAYS@axiom: ^(180) @AXIOM@

S(o, w) : w > DT --> S(o, w - DT)
S(o, w) --> B(o, DT - w)
@NEXT BASAL@P(o, t, l, i, lb, la, ln, n, k, r, q) -->
	G(o, t + DT, l, GROWN(o, t + DT, k, r, q), i, lb, la, ln, n, k, r, q)

decomposition
maximum depth: 100000
@BASAL@B(o, t) --> /(ran(360)) +(VARIED(THETA[o], THETA_DEVIATION[o])) ;(o) !(VARIED(WIDTH[o], WIDTH_DEVIATION[o]))
	I(o, t, VARIED(LB[o], LB_DEVIATION[o]), VARIED(LA[o], LA_DEVIATION[o]), VARIED(LN[o], LN_DEVIATION[o]),
	SUCCESSORS[o] > 0 ? max(floor(VARIED(NOB[o], NOB_DEVIATION[o]) + 0.5), 1) : 0,
	VARIED(LMAX[o], LMAX_DEVIATION[o]), VARIED(R[o], R_DEVIATION[o]), VARIED(LIFE[o], LIFE_DEVIATION[o]))
I(o, t, lb, la, ln, n, m, r, q) -->
	G(o, t, 0, GROWN(o, t, FINAL(n, lb, la, ln, m), r, q), 0, lb, la, ln, n, FINAL(n, lb, la, ln, m), r, q)
G(o, t, l, to, i, lb, la, ln, n, k, r, q) : BRANCH(i, n, lb, ln) <= to && BRANCH(i, n, lb, ln) <= l + 0.000001 -->
	[C(o, ran(1), AGE(o, BRANCH(i, n, lb, ln) + la, k, r) - t)] G(o, t, l, to, i + 1, lb, la, ln, n, k, r, q)
G(o, t, l, to, i, lb, la, ln, n, k, r, q) : BRANCH(i, n, lb, ln) <= to && BRANCH(i, n, lb, ln) < NODE(o, l) -->
	F(CM * (BRANCH(i, n, lb, ln) - l)) G(o, t, BRANCH(i, n, lb, ln), to, i, lb, la, ln, n, k, r, q)
G(o, t, l, to, i, lb, la, ln, n, k, r, q) : NODE(o, l) <= to -->
	F(CM * (NODE(o, l) - l)) /(ran(360)) +(nran(0, WIGGLE * SIGMA[o])) @Th(0, -1, 0, WIGGLE * PULL[o])
	G(o, t, NODE(o, l), to, i, lb, la, ln, n, k, r, q)
G(o, t, l, to, i, lb, la, ln, n, k, r, q) : to > l --> F(CM * (to - l)) P(o, t, to, i, lb, la, ln, n, k, r, q)
G(o, t, l, to, i, lb, la, ln, n, k, r, q) --> P(o, t, l, i, lb, la, ln, n, k, r, q)
C(o, u, w) --> L(CHOSEN(o, u), w)
L(o, w) : o == 0 --> *
L(o, w) : w <= 0 --> B(o, -w)
L(o, w) --> S(o, w)
endlsystem
)";

/// The largest of some numbers from a normal distribution, in its deviations: between whole numbers the chances are
/// shared, as CRootBox does.
double best_of(double trials) {
    static constexpr double expected[] = {0, 0, 0.564190, 0.846284, 1.029375, 1.162964, 1.267206, 1.352178, 1.423600};
    constexpr int most = static_cast<int>(std::size(expected)) - 1;
    const double at = std::clamp(trials, 0.0, static_cast<double>(most));
    const int below = std::min(static_cast<int>(at), most - 1);
    return expected[below] + (at - below) * (expected[below + 1] - expected[below]);
}

class Writing {
public:
    Writing(const RootParameters& parameters, const std::string& name, measured::Notes& notes)
        : parameters_(parameters), name_(name), notes_(notes), size_(parameters.types.rbegin()->first + 1) {}

    std::string text() {
        for (const auto& [type, root] : parameters_.types) review(root);
        std::string text = head();
        text +=
            "#define VARIATION 1  /* 0: every root is as the mean of its type; 0..1 */\n"
            "#define WIGGLE 1     /* turns at random and towards gravity, of those of the file; 0..3 */\n"
            "#define DT 1         /* days in a step; 0.01..10; days */\n\n"
            "#define CM (0.01)    /* the parameters are in cm */\n";
        text += chosen();
        std::string body = rules;
        const Seed& seed = parameters_.seed;
        put(body, "@DAYS@", format_exact(seed.days.value_or(days_if_unknown)));
        put(body, "@ARRAYS@", arrays());
        put(body, "@AXIOM@", axiom());
        put(body, "@NEXT BASAL@", has_basal() ? "D(n, w) --> E(n, w - DT)\n" : "");
        put(body, "@BASAL@", has_basal() ? basal_rules() : "");
        return text + body;
    }

private:
    static constexpr int tap_type = 1, basal_type = 4, shoot_borne_type = 5;

    static void put(std::string& text, std::string_view word, const std::string& by) {
        text.replace(text.find(word), word.size(), by);
    }

    std::string head() const {
        std::string types;
        for (const auto& [type, root] : parameters_.types) {
            types += fmt::format("     {}  {}\n", type, escaped(root.name));
        }
        // Nothing in a name ends the comment.
        for (std::size_t at = 0; (at = types.find("*/", at)) != std::string::npos;) types.replace(at, 2, "* ");
        return fmt::format(
            "/* A root system with the parameters of {}\n\n"
            "   An axis of type o is LENGTH(o, t) = k (1 - exp(-r t / k)) long after t days. Laterals stand ln apart "
            "behind the first\n   lb, and emerge when the tip is la ahead. Types:\n{}\n"
            "   Source: D. Leitner et al.: A dynamic root system growth model based on L-systems. Plant and Soil 332, "
            "2010;\n   A. Schnepf et al.: CRootBox: a structural-functional modelling framework for root systems. "
            "Annals of Botany 121, 2018.\n\n"
            "   Modules\n"
            "     S(o,w)      a root of type o that is to emerge in w days\n"
            "     P(o,t,l,i,...)  tip of a root, t days old and l cm from its base, with i laterals passed; then what\n"
            "                 it was born with: lb, la, ln, the number of laterals, final length k, rate r, life time  "
            "*/\n\n",
            escaped(std::filesystem::path(name_).filename().string()), types);
    }

    // -- what has no equal

    void review(const RootType& root) {
        static constexpr const char* tropisms[] = {"plagiotropism", "gravitropism", "exotropism", "hydrotropism"};
        const std::string called = fmt::format("type {} ({})", root.type, escaped(root.name));
        if (root.tropism != gravitropism && root.sigma > 0) {
            notes_.warn(fmt::format("{} has {}, which has no equal here: its roots turn at random only", called,
                                    root.tropism < 4 ? tropisms[root.tropism] : "a tropism of another kind"),
                        root.place);
        } else if (root.sigma > 0 && root.trials > 1) {
            notes_.warn(fmt::format("{}: the best of N = {} directions is replaced by a turn at random and one towards "
                                    "gravity that is as large in the mean",
                                    called, root.trials),
                        root.place);
        }
        if (root.growth != 1 && root.growth != linear_growth) {
            notes_.warn(fmt::format("{} has the growth function {}, which has no equal here: that of 1 counts", called,
                                    root.growth),
                        root.place);
        }
        if (root.spacing.deviation > 0 && !root.successors.empty()) {
            notes_.warn(fmt::format("{}: ln varies from root to root, not from lateral to lateral", called),
                        root.place);
        }
        for (const int successor : root.successors) {
            if (parameters_.types.contains(successor)) continue;
            notes_.warn(
                fmt::format("{} bears type {}, which is not there: nothing grows in its place", called, successor),
                root.place);
        }
        notes_.warn("the colours of types have no equal: a type has the colour index of its number", root.place);
        review_begins(root, called);
    }

    void review_begins(const RootType& root, const std::string& called) {
        const bool is_borne = std::any_of(parameters_.types.begin(), parameters_.types.end(), [&](const auto& other) {
            const std::vector<int>& successors = other.second.successors;
            return std::find(successors.begin(), successors.end(), root.type) != successors.end();
        });
        if (is_borne || root.type == tap_type) return;
        if (root.type == basal_type && has_basal()) return;
        notes_.warn(fmt::format("{} is borne by no other{}: none of it grows", called,
                                root.type == basal_type         ? " and no seed says when it begins"
                                : root.type == shoot_borne_type ? ", and crowns of shoot-borne roots have no equal"
                                                                : ""),
                    root.place);
    }

    // -- numbers

    std::string array(const std::string& name, const std::function<double(const RootType&)>& value) const {
        std::vector<std::string> values(static_cast<std::size_t>(size_), "0");
        for (const auto& [type, root] : parameters_.types) {
            values[static_cast<std::size_t>(type)] = format_exact(value(root));
        }
        return fmt::format("\tarray {}[{}] = {{{}}};\n", name, size_, fmt::join(values, ", "));
    }

    std::string varied(const std::string& name, const std::function<Varied(const RootType&)>& value) const {
        return array(name, [&](const RootType& root) { return value(root).mean; }) +
               array(name + "_DEVIATION", [&](const RootType& root) { return std::abs(value(root).deviation); });
    }

    static Varied scaled(const Varied& of, double by) { return {of.mean * by, of.deviation * by}; }

    static Varied branches(const RootType& root) {
        Varied branches = root.branches.value_or(Varied{});
        if (!root.branches && root.spacing.mean > 0) {
            const double zone = root.final_length.mean - root.apical_zone.mean - root.basal_zone.mean;
            branches = {zone / root.spacing.mean + 1, root.final_length.deviation / root.spacing.mean};
        }
        return {std::clamp(branches.mean, 1.0, most_branches), branches.deviation};
    }

    /// Without successors: the number of laterals of such a type would have made its length.
    static Varied final_length(const RootType& root) {
        if (!root.branches || root.final_length.mean > 0) return root.final_length;
        const double intervals = std::max(root.branches->mean - 1, 0.0);
        return {root.basal_zone.mean + root.apical_zone.mean + intervals * root.spacing.mean,
                root.branches->deviation * root.spacing.mean};
    }

    std::string arrays() const {
        constexpr double degrees = 180 / std::numbers::pi;
        const auto turn = [](const RootType& root) { return root.sigma * std::sqrt(resolution(root)); };
        return "define: {\n" + varied("LB", [](const RootType& root) { return root.basal_zone; }) +
               varied("LA", [](const RootType& root) { return root.apical_zone; }) +
               varied("LN", [](const RootType& root) { return root.spacing; }) + varied("NOB", branches) +
               varied("LMAX", final_length) + varied("R", [](const RootType& root) { return root.rate; }) +
               varied("WIDTH", [](const RootType& root) { return scaled(root.radius, 2 * 0.01); }) +
               varied("THETA", [&](const RootType& root) { return scaled(root.angle, degrees); }) +
               varied("LIFE", [](const RootType& root) { return root.life_time; }) +
               array("SUCCESSORS", [](const RootType& root) { return double(root.successors.size()); }) +
               array("LINEAR", [](const RootType& root) { return root.growth == linear_growth ? 1.0 : 0.0; }) +
               array("DX", resolution) + array("SIGMA", [&](const RootType& root) { return degrees * turn(root); }) +
               array("PULL",
                     [&](const RootType& root) {
                         // A turn in a plane at random is the deviation over the root of 2 towards any direction.
                         const bool falls = root.tropism == gravitropism;
                         return falls ? std::min(turn(root) * best_of(root.trials) / std::numbers::sqrt2, 1.0) : 0.0;
                     }) +
               "}\n";
    }

    /// No piece is shorter than a tenth of a millimetre.
    static double resolution(const RootType& root) { return std::max(root.resolution, 0.01); }

    /// The type of a lateral for a number at random between 0 and 1; 0: none.
    std::string chosen() const {
        std::string text = "#define CHOSEN(o, u) (";
        for (const auto& [type, root] : parameters_.types) {
            if (root.successors.empty()) continue;
            text += fmt::format("\\\n\t(o) == {} ? ", type);
            double sum = 0;
            for (std::size_t i = 0; i < root.successors.size(); ++i) {
                sum += std::max(root.chances[i], 0.0);
                const bool exists = parameters_.types.contains(root.successors[i]);
                text += fmt::format("(u) < {} ? {} : ", format_exact(sum > 1 - 1e-9 ? 1.0 : sum),
                                    exists ? root.successors[i] : 0);
            }
            text += "0 : ";
        }
        return text + "0)\n";
    }

    bool has_basal() const {
        const Seed& seed = parameters_.seed;
        return parameters_.types.contains(basal_type) && seed.most_basal > 0 && seed.first_basal < endless;
    }

    /// n basal roots are still to come, the next of them in w days.
    std::string basal_rules() const {
        return fmt::format("E(n, w) : n > 0 && w <= 0 --> [B({}, -w)] E(n - 1, w + {})\nE(n, w) --> D(n, w)\n",
                           basal_type, format_exact(std::max(parameters_.seed.delay_basal, 1e-6)));
    }

    std::string axiom() const {
        const Seed& seed = parameters_.seed;
        std::string text = seed.depth > 0 ? fmt::format("f(CM * {}) ", format_exact(seed.depth)) : "";
        const bool has_tap = parameters_.types.contains(tap_type);
        if (has_tap) text += fmt::format("[S({}, 0)] ", tap_type);
        if (has_basal()) {
            text += fmt::format("D({}, {})", format_exact(std::min(seed.most_basal, most_branches)),
                                format_exact(seed.first_basal));
        }
        return text.empty() ? "S(0, 1000000000)" : text;
    }

    const RootParameters& parameters_;
    std::string name_;
    measured::Notes& notes_;
    int size_;
};

}  // namespace

std::string model_text(const RootParameters& parameters, const std::string& name, measured::Notes& notes) {
    return Writing(parameters, name, notes).text();
}

}  // namespace espalier::language::root_box
