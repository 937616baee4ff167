// The arrays of tree-gen: params = {'shape': 7, 'length': [1, 0.3, 0.6, 0], ...}, a dict of Python or an object of
// JSON.
#include "base/characters.h"
#include "base/number.h"
#include "base/text.h"
#include "language/weber_penn/species_builder.h"

#include <fmt/format.h>

#include <cctype>
#include <map>

namespace espalier::language::weber_penn {
namespace {

using At = SpeciesBuilder::At;

/// A key with its numbers; one, or one for each level.
struct Entry {
    std::string key;
    At at;
    std::vector<std::pair<double, At>> values;
    bool is_list = false;
};

/// Reads the text of a dict: keys in quotes, numbers, and lists of numbers.
class DictReader {
public:
    DictReader(const std::string& text, const std::string& file) : text_(text), file_(file) {}

    std::vector<Entry> read() {
        skip_blanks();
        if (!at_end() && next() != '{') read_name();
        need('{', "'{' before the parameters, as in params = {'shape': 7, ...}");
        std::vector<Entry> entries;
        while (!skip('}')) {
            entries.push_back(read_entry());
            if (!skip(',')) {
                need('}', "',' or '}' behind a parameter");
                break;
            }
        }
        skip_blanks();
        if (!at_end()) fail("expected nothing behind the '}' of the parameters");
        return entries;
    }

private:
    bool at_end() const { return place_ == text_.size(); }
    char next() const { return text_[place_]; }
    At at() const { return {line_, column_}; }
    [[noreturn]] void fail(const std::string& message) const { throw UserError(Place{file_, line_, column_}, message); }

    void advance() {
        if (text_[place_++] == '\n') {
            ++line_;
            column_ = 1;
        } else {
            ++column_;
        }
    }

    void skip_blanks() {
        while (!at_end() && (is_blank(next()) || next() == '\n' || next() == '#')) {
            if (next() == '#') {
                while (!at_end() && next() != '\n') advance();
            } else {
                advance();
            }
        }
    }

    bool skip(char sign) {
        skip_blanks();
        if (at_end() || next() != sign) return false;
        advance();
        return true;
    }

    void need(char sign, const std::string& expected) {
        if (!skip(sign)) fail("expected " + expected);
    }

    void read_name() {
        while (!at_end() && (std::isalnum(static_cast<unsigned char>(next())) || next() == '_')) advance();
        need('=', "'=' and '{', as in params = {'shape': 7, ...}");
        skip_blanks();
    }

    Entry read_entry() {
        skip_blanks();
        Entry entry;
        entry.at = at();
        const char quote = at_end() ? ' ' : next();
        if (quote != '\'' && quote != '"') fail("expected the name of a parameter in quotes");
        advance();
        while (!at_end() && next() != quote && next() != '\n') {
            entry.key += next();
            advance();
        }
        if (at_end() || next() != quote) fail("this name has no closing quote");
        advance();
        need(':', fmt::format("':' behind '{}'", entry.key));
        entry.is_list = skip('[');
        if (!entry.is_list) {
            entry.values.push_back(read_number(entry.key));
            return entry;
        }
        while (!skip(']')) {
            entry.values.push_back(read_number(entry.key));
            if (!skip(',')) {
                need(']', "',' or ']' behind a number");
                break;
            }
        }
        return entry;
    }

    std::pair<double, At> read_number(const std::string& key) {
        skip_blanks();
        const At begin = at();
        std::string word;
        while (!at_end() && (std::isalnum(static_cast<unsigned char>(next())) || next() == '.' || next() == '-' ||
                             next() == '+' || next() == '_')) {
            word += next();
            advance();
        }
        if (word == "True" || word == "true") return {1, begin};
        if (word == "False" || word == "false") return {0, begin};
        const std::optional<double> number = finite_number(word.starts_with('+') ? word.substr(1) : word);
        if (!number) throw UserError(Place{file_, begin.line, begin.column}, fmt::format("'{}' is a number", key));
        return {*number, begin};
    }

    const std::string& text_;
    std::string file_;
    std::size_t place_ = 0;
    int line_ = 1, column_ = 1;
};

/// The names of the paper by those of tree-gen.
const std::map<std::string, std::string>& names_of_tree() {
    static const std::map<std::string, std::string> names{
        {"shape", "Shape"},
        {"g_scale", "Scale"},
        {"g_scale_v", "ScaleV"},
        {"levels", "Levels"},
        {"ratio", "Ratio"},
        {"ratio_power", "RatioPower"},
        {"flare", "Flare"},
        {"base_splits", "0BaseSplits"},
        {"leaf_blos_num", "Leaves"},
        {"leaf_shape", "LeafShape"},
        {"leaf_scale", "LeafScale"},
        {"leaf_scale_x", "LeafScaleX"},
        {"leaf_bend", "LeafBend"},
        {"prune_ratio", "PruneRatio"},
        {"prune_width", "PruneWidth"},
        {"prune_width_peak", "PruneWidthPeak"},
        {"prune_power_low", "PrunePowerLow"},
        {"prune_power_high", "PrunePowerHigh"},
    };
    return names;
}

const std::map<std::string, std::string>& names_of_levels() {
    static const std::map<std::string, std::string> names{
        {"base_size", "BaseSize"},
        {"down_angle", "DownAngle"},
        {"down_angle_v", "DownAngleV"},
        {"rotate", "Rotate"},
        {"rotate_v", "RotateV"},
        {"branches", "Branches"},
        {"length", "Length"},
        {"length_v", "LengthV"},
        {"taper", "Taper"},
        {"seg_splits", "SegSplits"},
        {"split_angle", "SplitAngle"},
        {"split_angle_v", "SplitAngleV"},
        {"curve_res", "CurveRes"},
        {"curve", "Curve"},
        {"curve_back", "CurveBack"},
        {"curve_v", "CurveV"},
        {"bend_v", "BendV"},
        {"radius_mod", "Scale"},
    };
    return names;
}

/// What nothing reads here, and the value with which that changes no tree.
const std::map<std::string, std::pair<double, const char*>>& unread() {
    static const std::map<std::string, std::pair<double, const char*>> names{
        {"branch_dist", {0, "whorls of branches are not drawn"}},
        {"floor_splits", {0, "there is one trunk"}},
        {"blossom_rate", {0, "all are drawn as leaves"}},
    };
    return names;
}

class TreeGenReader {
public:
    TreeGenReader(const std::string& text, const std::string& file)
        : entries_(DictReader(text, file).read()), builder_(text, file, "species") {}

    Species read() {
        for (const Entry& entry : entries_) {
            if (entry.key == "levels" && !entry.is_list) levels_ = entry.values.front().first;
        }
        for (const Entry& entry : entries_) read(entry);
        return builder_.finished();
    }

private:
    void read(const Entry& entry) {
        if (entry.key == "tropism") return read_tropism(entry);
        if (entry.key == "blossom_shape" || entry.key == "blossom_scale")
            return;  // blossom_rate says whether there are any
        if (const auto found = unread().find(entry.key); found != unread().end())
            return read_unread(entry, found->second);
        if (const auto found = names_of_levels().find(entry.key); found != names_of_levels().end()) {
            return read_levels(entry, found->second);
        }
        const auto found = names_of_tree().find(entry.key);
        if (found == names_of_tree().end()) return refuse(entry);
        if (entry.is_list) return builder_.mistake(entry.at, fmt::format("'{}' is a number, not a list", entry.key));
        const auto& [value, at] = entry.values.front();
        builder_.set(found->second, entry.key == "leaf_shape" ? shape_of_leaf(value) : value, entry.at, at);
    }

    void refuse(const Entry& entry) {
        std::vector<std::string> names;
        for (const auto& [name, here] : names_of_tree()) names.push_back(name);
        for (const auto& [name, here] : names_of_levels()) names.push_back(name);
        builder_.mistake(entry.at,
                         fmt::format("there is no parameter '{}'{}; 'espalier list notations species' has them "
                                     "all",
                                     entry.key, did_you_mean(entry.key, names)));
    }

    /// Numbers of levels that the tree does not have may be anything, as they are in the published files.
    bool matters(const std::string& name, int level) const {
        const bool is_of_leaves = name == "DownAngle" || name == "DownAngleV" || name == "Rotate" || name == "RotateV";
        return level < levels_ + (is_of_leaves ? 1 : 0);
    }

    void read_levels(const Entry& entry, const std::string& name) {
        constexpr std::size_t most = highest_described_level + 1;
        if (!entry.is_list || entry.values.size() > most) {
            return builder_.mistake(
                entry.at, fmt::format("'{}' is a list of {} numbers at most, one for each level", entry.key, most));
        }
        for (std::size_t level = 0; level < entry.values.size(); ++level) {
            const auto& [value, at] = entry.values[level];
            const bool is_of_tree = level == 0 && name == "BaseSize";
            const std::string written = is_of_tree ? name : std::to_string(level) + name;
            if (!SpeciesBuilder::is_known(written)) {
                const double upright = name == "Branches" ? 1 : 0;
                if (value != upright) warn(entry, at, "there is one trunk, and it stands upright");
            } else if (matters(name, static_cast<int>(level))) {
                builder_.set(written, value, at, at);
            }
        }
    }

    void read_tropism(const Entry& entry) {
        if (!entry.is_list || entry.values.size() != 3) {
            return builder_.mistake(entry.at, "'tropism' is a list of three numbers");
        }
        builder_.set("AttractionUp", entry.values[2].first, entry.at, entry.values[2].second);
        for (std::size_t k = 0; k < 2; ++k) {
            const auto& [value, at] = entry.values[k];
            if (value != 0) warn(entry, at, "stems turn up or down alone");
        }
    }

    void read_unread(const Entry& entry, const std::pair<double, const char*>& neutral) {
        for (std::size_t level = 0; level < entry.values.size(); ++level) {
            const auto& [value, at] = entry.values[level];
            if (value != neutral.first && static_cast<double>(level) <= levels_) return warn(entry, at, neutral.second);
        }
    }

    void warn(const Entry& entry, At at, const std::string& why) {
        builder_.warn(at, fmt::format("this number of '{}' is not read: {}", entry.key, why));
    }

    /// Ours by the number of tree-gen; the others are ovals.
    static double shape_of_leaf(double shape) {
        static const std::map<double, double> shapes{{4, 4}, {5, 5}, {6, 2}, {7, 2}, {10, 1}};
        const auto found = shapes.find(shape);
        if (found != shapes.end()) return found->second;
        return shape >= 0 && shape <= 10 ? 0 : shape;
    }

    std::vector<Entry> entries_;
    SpeciesBuilder builder_;
    double levels_ = 3;
};

}  // namespace

Species parse_tree_gen(const std::string& text, const std::string& name) {
    return TreeGenReader(text, name).read();
}

}  // namespace espalier::language::weber_penn
