// The parameters of the environment programs of cpfg's virtual laboratory: from their plain parameter files, or as keys
// of a scene.
//
//   radius: 0.5            radius = 0.5
//   grid size: 32x32x32    grid_size = [32, 32, 32]
//   3d case: on            3d_case = true
#pragma once

#include "espalier/environment/environment_process.h"

#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace espalier::environment {

/// A line is `key: values`; the key ends at the first tab or colon and is taken letter by letter. Lines that are not
/// understood are ignored with a warning. Where file and scene give the same key, the scene wins.
/// Every key is read exactly once by the process, through one of the look-ups; they throw UserError.
class ParameterFile {
public:
    /// How the programs differ in what they make of a line.
    struct Dialect {
        bool any_case = false;     ///< keys are small letters, in files of any case
        bool has_slashes = false;  ///< lines that begin with // are comments
        bool goes_on = false;      ///< lines that begin with : go on with the values of the line before
    };

    /// Reads the file that the key `parameters` names, if it does. `keys` are all that the process knows.
    ParameterFile(const Settings& table, const EnvironmentContext& context, std::vector<std::string> keys);
    ParameterFile(const Settings& table, const EnvironmentContext& context, std::vector<std::string> keys,
                  Dialect dialect);

    /// Whether file or scene give it.
    bool has(const std::string& key) const;
    /// The whole value, without the blanks around it.
    std::string text(const std::string& key, const std::string& fallback);

    double number(const std::string& key, double fallback, Range range = Range::any());
    /// The fraction is cut off, as the programs do.
    std::int64_t whole(const std::string& key, std::int64_t fallback, Range range);
    /// As many numbers as `fallback` has; those the file does not give keep their defaults. Split at the letter x too.
    std::vector<double> numbers(const std::string& key, std::vector<double> fallback, Range range = Range::any());
    bool flag(const std::string& key, bool fallback, std::initializer_list<const char*> on = {"on"},
              std::initializer_list<const char*> off = {"off"});
    /// A file, relative to the one that says it.
    std::optional<std::filesystem::path> file(const std::string& key);
    /// A key that may come again: `fewest` to `most` numbers each time. A scene gives one text a line.
    std::vector<std::vector<double>> repeated(const std::string& key, std::size_t fewest, std::size_t most);

    bool has_file() const { return !path_.empty(); }
    /// Whether to answer what cpfg's program answers: the key `numbers`, "cpfg" or "exact". With a file it is "cpfg".
    bool has_numbers_of_cpfg() const;
    Place place(const std::string& key) const;

private:
    struct Line {
        std::string key, value;
        Place place;
    };

    void read();
    const Line* last(const std::string& key) const;
    double number_of(const std::string& word, const Line& line, Range range);
    std::vector<double> numbers_of(const Line& line, bool split_at_x, Range range);
    void warn(const Line& line, const std::string& message);

    Settings table_;
    Dialect dialect_;
    std::vector<Diagnostic>* warnings_;
    std::vector<std::string> keys_;
    std::filesystem::path path_;
    std::vector<Line> lines_;
};

/// The key as scenes write it: "use CIE formula" is use_cie_formula.
std::string scene_key(const std::string& key);

}  // namespace espalier::environment
