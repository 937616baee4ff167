// What grows computes with base/math.h alone, whose values do not depend on the processor.
#include "catch.h"
#include "sources.h"

#include <regex>

namespace {

using namespace layout;

const std::vector<fs::path> wrappers{"include/espalier/base/math.h", "src/base/math.cpp", "src/base/math_columns.h",
                                     "src/base/math_columns.cpp", "src/base/math_lanes.h"};

/// The line without what stands in strings and comments; `raw` is the end of a raw string that goes on in the next.
std::string code_in(const std::string& line, std::string& raw) {
    std::string code;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (!raw.empty()) {
            const std::size_t end = line.find(raw, i);
            if (end == std::string::npos) return code;
            i = end + raw.size() - 1;
            raw.clear();
        } else if (line.compare(i, 2, "R\"") == 0) {
            const std::size_t open = line.find('(', i);
            raw = ")" + line.substr(i + 2, open - i - 2) + "\"";
            i = open;
        } else if (line[i] == '"') {
            while (++i < line.size() && line[i] != '"') i += line[i] == '\\';
        } else if (line.compare(i, 2, "//") == 0) {
            return code;
        } else {
            code += line[i];
        }
    }
    return code;
}

/// What a line of code takes from a library whose values depend on the processor, or "".
std::string foreign_value_in(const std::string& code) {
    static const std::string names =
        "a?(?:sin|cos|tan)h?|atan2|sincos|exp|exp2|exp10|expm1|log|log2|log10|log1p|pow|hypot|cbrt|erfc?|[lt]gamma|fma";
    static const std::regex library(
        R"((?:^|[^\w:.>]|\bstd::|\bglm::|[^\w:]::)((?:)" + names +
        R"()[fl]?)\s*\(|)"
        R"(\b(long double|std::complex|std::polar|std::\w+_distribution|std::mt19937|std::random_device)\b|)"
        R"(\bglm::((?:rotate|angleAxis|slerp|angle|axis|orientedAngle|eulerAngle|perspective|\w+Rand)\w*)|)"
        R"(\b(Eigen::(?:AngleAxis|Rotation2D|Quaternion)|setRandom|\w+::Random\b|array\(\)\s*\.(?:)" +
        names +
        R"()\()|)"
        R"(\b(openvdb::math::(?:Rand|Quat|rotation|Pow|Exp|Sin|Cos|angle|slerp)\w*|(?:pre|post)Rotate|setToRotation))");
    std::smatch match;
    if (!std::regex_search(code, match, library)) return "";
    for (std::size_t i = 1; i < match.size(); ++i) {
        if (match[i].matched) return match[i];
    }
    return "";
}

std::string foreign_value_in_line(const std::string& line) {
    std::string raw;
    return foreign_value_in(code_in(line, raw));
}

std::vector<std::string> foreign_values(const fs::path& file) {
    std::vector<std::string> found;
    std::string raw;
    for (const std::string& line : lines_of(file)) {
        const std::string name = foreign_value_in(code_in(line, raw));
        if (!name.empty()) found.push_back(file.string() + " takes " + name + " from a library: use base/math.h");
    }
    return found;
}

}  // namespace

TEST_CASE("what grows takes sines, powers and chance from base alone", "[layout]") {
    std::vector<std::string> found;
    std::size_t files = 0;
    for (const std::string& station : growing) {
        for (const fs::path& folder : {fs::path("include/espalier") / station, fs::path("src") / station}) {
            for (const fs::path& file : sources_below(folder)) {
                if (std::find(wrappers.begin(), wrappers.end(), file) != wrappers.end()) continue;
                ++files;
                for (std::string& name : foreign_values(file)) found.push_back(std::move(name));
            }
        }
    }
    CHECK(files > 400);
    CHECK(found == std::vector<std::string>{});
}

TEST_CASE("the test of values that depend on the processor knows them", "[layout]") {
    CHECK(foreign_value_in_line("    return std::sin(x) + math::cos(x);") == "sin");
    CHECK(foreign_value_in_line("    const double x = ::powf (a, b);") == "powf");
    CHECK(foreign_value_in_line("    const double x = 2*log1p(a);") == "log1p");
    CHECK(foreign_value_in_line("    return glm::angleAxis(turn, up) * heading;") == "angleAxis");
    CHECK(foreign_value_in_line("    apply(glm::rotate(matrix, angle, axis));") == "rotate");
    CHECK(foreign_value_in_line("    std::normal_distribution<double> normal;") == "std::normal_distribution");
    CHECK(foreign_value_in_line("    const auto start = Eigen::VectorXd::Random(n);") == "VectorXd::Random");
    CHECK(foreign_value_in_line("    values = amounts.array().exp();") == "array().exp(");
    CHECK(foreign_value_in_line("    transform->postRotate(angle);") == "postRotate");
    CHECK(foreign_value_in_line("    long double sum = 0;") == "long double");
    CHECK(foreign_value_in_line("    return math::pow(x, 2) + std::sqrt(y) + std::atanh(z);") == "atanh");
    for (const char* fine :
         {"return math::sine_and_cosine(angle);", "std::filesystem::path log;", "glm::mat4_cast(turn)",
          "text += \"\\\"cos(x)\" + rest;  // as sin(x)", "table.log(x);", "using_log(x)"}) {
        INFO(fine);
        CHECK(foreign_value_in_line(fine).empty());
    }
    std::string raw;
    CHECK(code_in("f(R\"end(sin(x)", raw) == "f(");
    CHECK(code_in("cos(x))end\", 2);", raw) == ", 2);");
}
