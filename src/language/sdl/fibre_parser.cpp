#include "language/sdl/formula.h"
#include "language/sdl/parser.h"

#include <fmt/format.h>

#include <array>

namespace espalier::language::sdl {
namespace {

constexpr int most_sections = 1000, most_magnets = 256;
const std::array<std::string, 3> cut_names{"length", "vertical", "horizontal"};

class FibreParser {
public:
    FibreParser(TokenReader& in, Mistakes& mistakes) : in_(in), mistakes_(mistakes) {}

    // wooden { ... }  leaf petal, sepal { ... }
    Fibre fibre() {
        const std::array<std::string, 2> types{"wooden", "leaf"};
        fibre_.at = in_.next().at;
        if (!in_.looking_at(types[0]) && !in_.looking_at(types[1]))
            in_.fail("'wooden', 'leaf' or the '}' of the fibres", types);
        fibre_.type = in_.take().text == "leaf" ? Fibre::Type::leaf : Fibre::Type::wooden;
        fibre_.is_flat = fibre_.type == Fibre::Type::leaf;
        if (!in_.looking_at("{")) {
            do {
                fibre_.components.push_back(in_.expect_name("a component of these fibres").text);
            } while (in_.accept(","));
        }
        in_.expect("{", "before the settings of these fibres, or ',' and another component");
        while (!in_.accept("}")) {
            if (in_.at_end()) in_.fail("'}' after the settings of these fibres");
            try {
                setting();
            } catch (const SyntaxError& mistake) {
                mistakes_.error(mistake);
                in_.skip_statement();
            }
        }
        return std::move(fibre_);
    }

private:
    void setting() {
        const std::vector<std::string>& known = fibre_settings();
        const bool is_known = std::find(known.begin(), known.end(), in_.next().text) != known.end();
        if (!is_known)
            in_.fail("a setting of fibres: flat, solid, cut, ring, contour, correction, quality or material", known);
        const std::string name = in_.take().text;
        if (name == "flat" || name == "solid") {
            fibre_.is_flat = name == "flat";
        } else {
            in_.expect("[", fmt::format("after '{}'", name));
            values(name);
            in_.expect("]", fmt::format("after the values of '{}'", name));
        }
        in_.expect(";", fmt::format("after '{}'", name));
    }

    void values(const std::string& name) {
        if (name == "cut") cut();
        if (name == "ring") fibre_.rings.push_back(strengths());
        if (name == "contour") fibre_.contour = numbers("the bending of a part of the fibre, in degrees,", -360, 360);
        if (name == "correction") correction();
        if (name == "quality") quality();
        if (name == "material") material();
    }

    void cut() {
        fibre_.width = fibre_.thickness = diameter("the width of the cut");
        if (in_.accept(",")) fibre_.thickness = diameter("the thickness of the cut");
    }

    Formula diameter(const char* what) {
        const Location at = in_.next().at;
        const Formula formula = parse_formula(in_, cut_names, what);
        if (formula.number.value_or(0) >= 0) return formula;
        throw SyntaxError{at, fmt::format("{} is 0 or more, not {}", what, formula.text)};
    }

    std::vector<double> strengths() {
        const Location at = in_.next().at;
        std::vector<double> list = numbers("the strength of a magnet", -1, 100);
        if (list.size() > most_magnets) throw SyntaxError{at, "a ring has at most 256 magnets"};
        return list;
    }

    void correction() {
        Fibre::Correction correction;
        correction.amplitude = number("the amplitude of the correction, in half widths,", 0, 1);
        in_.expect(",", "and the number of bumps around the fibre");
        correction.bumps = number("the number of bumps around the fibre", 0, most_magnets);
        fibre_.correction = correction;
    }

    void quality() {
        fibre_.sections = in_.expect_whole("the number of rings along a fibre", 2, most_sections);
        in_.expect(",", "and the number of magnets in a ring");
        fibre_.magnets = in_.expect_whole("the number of magnets in a ring", 3, most_magnets);
    }

    void material() {
        fibre_.colour = in_.expect_whole("the index of a colour", 0, 255);
        if (in_.accept(",")) fibre_.texture = in_.expect_whole("the number of a texture", 0, 65535);
    }

    std::vector<double> numbers(const char* what, double least, double most) {
        std::vector<double> list{number(what, least, most)};
        while (in_.accept(",")) list.push_back(number(what, least, most));
        return list;
    }

    double number(const char* what, double least, double most) {
        const Location at = in_.next().at;
        const Formula formula = parse_formula(in_, {}, what);
        const double value = formula.number.value_or(least - 1);
        if (value >= least && value <= most) return value;
        throw SyntaxError{at, fmt::format("{} is from {} to {}, not {}", what, least, most, formula.text)};
    }

    TokenReader& in_;
    Mistakes& mistakes_;
    Fibre fibre_;
};

}  // namespace

std::vector<Fibre> parse_fibres(TokenReader& in, Mistakes& mistakes) {
    std::vector<Fibre> fibres;
    while (!in.accept("}")) fibres.push_back(FibreParser(in, mistakes).fibre());
    return fibres;
}

const std::vector<std::string>& fibre_settings() {
    static const std::vector<std::string> names{"flat",    "solid",      "cut",     "ring",
                                                "contour", "correction", "quality", "material"};
    return names;
}

}  // namespace espalier::language::sdl
