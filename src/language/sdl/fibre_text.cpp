#include "language/sdl/fibre_text.h"

#include "espalier/base/math.h"

#include "base/monotone_curve.h"
#include "base/text.h"
#include "language/sdl/formula.h"
#include "language/text/marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace espalier::language::sdl {
namespace {

constexpr double pi = std::numbers::pi;

/// Short enough to be read, long enough for a picture.
std::string rounded(double value) {
    const double result = std::round(value * 1e6) / 1e6;
    return format_exact(result == 0 ? 0 : result);
}

/// Magnets of the ring with the most of them.
std::size_t given_magnets(const Fibre& fibre) {
    std::size_t most = 0;
    for (const std::vector<double>& ring : fibre.rings) most = std::max(most, ring.size());
    return most;
}

/// The strength of a ring in the direction of magnet k of so many.
double strength(const std::vector<double>& ring, std::size_t k, std::size_t magnets) {
    return monotone_curve(ring, double(k) * double(ring.size()) / double(magnets), true);
}

std::string magnet(const Fibre& fibre, double strength, double along, double angle) {
    if (!fibre.correction) return rounded(strength);
    const double reach = fibre.correction->bumps / 2;
    return fmt::format("{} + ROUGH({}, {}, {}, {})", rounded(strength),
                       rounded(fibre.correction->amplitude * (1 + strength)), rounded(reach * math::cos(angle)),
                       rounded(reach * math::sin(angle)), rounded(2 * reach * along));
}

/// "@Gm(ratio, 0.1, 0, 0.1, 0)"
std::string cut(const Fibre& fibre, double along) {
    std::string text = fibre.is_flat ? "@Gf(ratio" : "@Gm(ratio";
    const std::vector<double> strengths = strengths_at(fibre, along);
    for (std::size_t k = 0; k < strengths.size(); ++k) {
        text += ", " + magnet(fibre, strengths[k], along, 2 * pi * double(k) / double(strengths.size()));
    }
    return text + ")";
}

/// Degrees that stretch k of the axis bends by.
double bend(const Fibre& fibre, int stretch) {
    if (fibre.contour.empty()) return 0;
    const int parts = int(fibre.contour.size()), in_part = stretches_of(fibre) / parts;
    return fibre.contour[std::size_t(stretch / in_part)] / in_part;
}

/// A circular arc of 1/`pieces` of the length: half the turn, the chord, half the turn.
std::string arc(double degrees, int pieces) {
    if (degrees == 0) return fmt::format("f(length * {})", format_exact(1.0 / pieces));
    const double half = degrees / 2 * pi / 180;
    const std::string turn = fmt::format("^({})", rounded(degrees / 2));
    return fmt::format("{} f(length * {}) {}", turn, format_exact(math::sin(half) / half / pieces), turn);
}

/// The part of the arc of part k of the contour that comes before `begin`.
std::string arc_before(const Fibre& fibre, std::size_t k) {
    const auto parts = double(fibre.contour.size());
    const double half = fibre.contour[k] / 2;
    const std::string share = fmt::format("PART({}, {})", fibre.contour.size(), k);
    if (half == 0) return fmt::format("f(length * {} * {})", format_exact(1 / parts), share);
    const std::string turn = fmt::format("^({} * {})", rounded(half), share);
    return fmt::format("{} f(length * {} * sin({} * {})) {}", turn, format_exact(1 / (half * pi / 180 * parts)),
                       rounded(half), share, turn);
}

std::string along_production(const FibreModules& modules) {
    std::string text = fmt::format("{}(length, begin) -->\n", modules.along);
    for (std::size_t k = 0; k < modules.fibre->contour.size(); ++k) {
        text += fmt::format("\t{}\n", arc_before(*modules.fibre, k));
    }
    return text;
}

std::string material(const Fibre& fibre) {
    std::string text;
    if (fibre.colour) text += fmt::format(";({}) ", *fibre.colour);
    if (fibre.texture) text += fmt::format("@Tx({}) ", *fibre.texture);
    return text;
}

}  // namespace

int stretches_of(const Fibre& fibre) {
    const int parts = std::max(1, int(fibre.contour.size()));
    return parts * ((fibre.sections - 1 + parts - 1) / parts);
}

std::vector<double> strengths_at(const Fibre& fibre, double at) {
    const std::size_t magnets = fibre.correction ? std::size_t(fibre.magnets) : given_magnets(fibre);
    std::vector<double> strengths;
    for (std::size_t k = 0; k < magnets; ++k) {
        std::vector<double> along;
        for (const std::vector<double>& ring : fibre.rings) along.push_back(strength(ring, k, magnets));
        strengths.push_back(monotone_curve(along, at * double(along.size() - 1), false));
    }
    return strengths;
}

std::string fibre_call(const FibreModules& modules) {
    const std::string &width = modules.fibre->width.text, &thickness = modules.fibre->thickness.text;
    const std::string ratio = without_marks(width) == without_marks(thickness)
                                  ? "1"
                                  : fmt::format("{} / max({}, 0.000001)", factor(modules.fibre->thickness), width);
    return fmt::format("{}(length, {}, {}, length + vertical + horizontal)", modules.drawn, width, ratio);
}

std::string fibre_productions(const FibreModules& modules) {
    const Fibre& fibre = *modules.fibre;
    const int stretches = stretches_of(fibre);
    std::string text = fmt::format("{}(length, width, ratio, grain) -->\n\t{}@!({}) @Gt(1) !(width) {} @Gs\n",
                                   modules.drawn, material(fibre), fibre.magnets, cut(fibre, 0));
    for (int k = 1; k <= stretches; ++k) {
        text += fmt::format("\t{} {} {}\n", arc(bend(fibre, k - 1), stretches), cut(fibre, double(k) / stretches),
                            k < stretches ? "@Gc(1)" : "@Ge(1)");
    }
    return marked(modules.along.empty() ? text : text + along_production(modules), fibre.at);
}

}  // namespace espalier::language::sdl
