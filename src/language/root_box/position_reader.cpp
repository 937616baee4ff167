// CRootBox reads its files by position: what the keys are called does not count, but for `nob` in place of `lmax`.
#include "base/number.h"
#include "base/text.h"
#include "language/root_box/parameters.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

namespace espalier::language::root_box {
namespace {

constexpr std::string_view blanks = " \t\r";
constexpr double largest_word = 1e12;

class Words {
public:
    Words(const std::string& text, std::string name) : name_(std::move(name)) {
        int line = 0;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            add_line(std::string_view(text).substr(begin, end - begin), ++line);
            begin = end + 1;
        }
    }

    bool has_more() const { return next_ < words_.size(); }

    Place place() const {
        const std::size_t at = std::min(next_, words_.size() - 1);
        return words_.empty() ? Place{name_, 1, 1} : Place{name_, words_[at].line, words_[at].column};
    }

    std::string word(const char* what) {
        if (!has_more()) throw UserError(place(), fmt::format("the file ends where {} should stand", what));
        return words_[next_++].text;
    }

    double number(const char* what) {
        const Place here = place();
        const std::string text = word(what);
        const std::optional<double> value = finite_number(text);
        if (!value || std::abs(*value) > largest_word) {
            throw UserError(here, fmt::format("{} is a number, not '{}'", what, escaped(text)));
        }
        return *value;
    }

    /// 0 to `most`.
    int whole(const char* what, int most) {
        const Place here = place();
        const double value = number(what);
        if (value != std::floor(value) || value < 0 || value > most) {
            throw UserError(here, fmt::format("{} is a whole number from 0 to {}, not {}", what, most, value));
        }
        return static_cast<int>(value);
    }

    Varied varied(const char* what) {
        const double mean = number(what), deviation = number(what);
        return {mean, deviation};
    }

private:
    struct Word {
        std::string text;
        int line, column;
    };

    void add_line(std::string_view line, int number) {
        const std::size_t first = line.find_first_not_of(blanks);
        if (first == std::string_view::npos || line[first] == '#') return;
        for (std::size_t at = first; at < line.size();) {
            const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
            words_.push_back({std::string(line.substr(at, end - at)), number, static_cast<int>(at) + 1});
            at = std::min(line.find_first_not_of(blanks, end), line.size());
        }
    }

    std::string name_;
    std::vector<Word> words_;
    std::size_t next_ = 0;
};

constexpr int most_types = 99;

void skip_key(Words& words) {
    words.word("the name of a parameter");
}

Varied keyed(Words& words, const char* what) {
    skip_key(words);
    return words.varied(what);
}

void read_tropism(Words& words, RootType& type) {
    skip_key(words);
    type.tropism = words.whole("the type of the tropism", 100);
    type.trials = words.number("N of the tropism");
    type.sigma = words.number("sigma of the tropism");
}

void read_successors(Words& words, RootType& type) {
    skip_key(words);
    const int count = words.whole("the number of successors", most_types);
    for (int i = 0; i < count; ++i) type.successors.push_back(words.whole("the type of a successor", most_types));
    skip_key(words);
    const Place place = words.place();
    if (words.whole("the number of chances", most_types) != count) {
        throw UserError(place, fmt::format("there are {} successors, and so as many chances", count));
    }
    for (int i = 0; i < count; ++i) type.chances.push_back(words.number("the chance of a successor"));
}

RootType read_type(Words& words) {
    RootType type;
    type.place = words.place();
    skip_key(words);
    type.type = words.whole("the type of the root", most_types);
    skip_key(words);
    type.name = words.word("the name of the root");
    type.basal_zone = keyed(words, "lb");
    type.apical_zone = keyed(words, "la");
    type.spacing = keyed(words, "ln");
    const bool says_branches = words.word("lmax") == "nob";
    (says_branches ? type.branches.emplace() : type.final_length) = words.varied("lmax");
    type.rate = keyed(words, "r");
    type.radius = keyed(words, "a");
    skip_key(words);
    for (int i = 0; i < 3; ++i) words.number("a colour");
    read_tropism(words, type);
    skip_key(words);
    type.resolution = words.number("dx");
    read_successors(words, type);
    type.angle = keyed(words, "theta");
    type.life_time = keyed(words, "rlt");
    skip_key(words);
    type.growth = words.whole("gf", 100);
    return type;
}

}  // namespace

RootParameters read_by_position(const std::string& text, const std::string& name, measured::Notes& notes) {
    Words words(text, name);
    RootParameters parameters;
    if (!words.has_more()) throw UserError(Place{name, 1, 1}, "this file has no types of roots");
    while (words.has_more()) {
        RootType type = read_type(words);
        if (parameters.types.contains(type.type)) {
            notes.warn(fmt::format("type {} stands twice: the second counts", type.type), type.place);
        }
        parameters.types[type.type] = std::move(type);
    }
    return parameters;
}

Seed read_seed_by_position(const std::string& text, const std::string& name, measured::Notes& notes) {
    Words words(text, name);
    const auto value = [&](const char* what) {
        skip_key(words);
        return words.number(what);
    };
    Seed seed;
    seed.depth = value("plantingdepth");
    seed.first_basal = value("firstB");
    seed.delay_basal = value("delayB");
    seed.most_basal = value("maxB");
    const double shoot_borne = value("nC");
    const double first_shoot_borne = value("firstSB");
    if (shoot_borne > 0 && first_shoot_borne < 1e9) notes.unused("crowns of shoot-borne roots (nC, firstSB ...)");
    for (const char* const what : {"delaySB", "delayRC", "nz"}) value(what);
    seed.days = value("simtime");
    return seed;
}

}  // namespace espalier::language::root_box
