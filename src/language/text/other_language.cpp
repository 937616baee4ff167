#include "language/text/other_language.h"

#include "base/characters.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace espalier::language {
namespace {

/// Calls visit(line) for each, without blanks around it, until it returns true; true if it did.
template <class Visit>
bool any_line(std::string_view text, const Visit& visit) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view line = text.substr(begin, end - begin);
        while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
        while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
        if (visit(line)) return true;
        begin = end + 1;
    }
    return false;
}

/// True if a line begins with the words in small letters, however it writes them.
bool begins_line(std::string_view text, std::string_view words) {
    const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return any_line(text, [&](std::string_view line) {
        return line.size() >= words.size() && std::equal(words.begin(), words.end(), line.begin(),
                                                         [&](char word, char c) { return word == small(c); });
    });
}

bool begin_lines(std::string_view text, std::initializer_list<std::string_view> all) {
    return std::all_of(all.begin(), all.end(), [&](std::string_view words) { return begins_line(text, words); });
}

bool has(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

bool begins(std::string_view text, std::string_view beginning) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && text.substr(first).starts_with(beginning);
}

bool has_in_small(std::string_view text, std::string_view part) {
    const auto equal = [](char a, char b) {
        return a == (b >= 'A' && b <= 'Z' ? static_cast<char>(b - 'A' + 'a') : b);
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(),
                       [&](char c, char of_part) { return equal(of_part, c); }) != text.end();
}

/// An object or an array of texts, objects or arrays.
bool is_json(std::string_view text) {
    const char* const blanks = " \t\r\n";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return false;
    const std::size_t second = text.find_first_not_of(blanks, first + 1);
    if (second == std::string_view::npos) return false;
    if (text[first] == '{') return text[second] == '"' || text[second] == '}';
    return text[first] == '[' && (text[second] == '{' || text[second] == '"' || text[second] == '[');
}

bool has_extension(const std::filesystem::path& path, std::initializer_list<const char*> extensions) {
    return std::any_of(extensions.begin(), extensions.end(),
                       [&](const char* each) { return path.extension() == each; });
}

struct Notation {
    bool (*fits)(std::string_view text, const std::filesystem::path& path);
    const char* sentence;
};

// The more particular stand before the more general.
constexpr std::array notations{
    Notation{[](std::string_view text, const std::filesystem::path&) { return text.starts_with("MATLAB"); },
             "this is a MATLAB file, as TreeQSM writes: write its cylinders as a table there, with "
             "writetable(struct2table(QSM.cylinder), 'tree.csv')"},
    Notation{[](std::string_view text, const std::filesystem::path& path) {
                 return has_extension(path, {".las", ".laz"}) || text.starts_with("LASF");
             },
             "this is LAS, which is not read: write it as .xyz or .ply, as CloudCompare and PDAL do; these are targets "
             "of `espalier fit` and points of the process `markers`"},
    Notation{
        [](std::string_view text, const std::filesystem::path& path) {
            return has_extension(path, {".ply", ".obj", ".stl", ".xyz", ".pts", ".asc"}) || text.starts_with("ply\n") ||
                   text.starts_with("ply\r");
        },
        "these are points or a mesh, not a plant: a target of `espalier fit`, points of the process `markers`, or a "
        "shape"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return has(text, "lpfgall.h") || begin_lines(text, {"produce ", "module "});
             },
             "this is a model in L+C, the language of lpfg, which is C++ and needs that program; Espalier reads models "
             "of cpfg, which begin with 'lsystem:'"},
    Notation{[](std::string_view text, const std::filesystem::path& path) {
                 return has_extension(path, {".lpy"}) || begins_line(text, "production:");
             },
             "this is a model of L-Py, which is Python and needs that program; Espalier reads models of cpfg, which "
             "begin with 'lsystem:'. The module of Python translates simple ones: espalier.from_lpy"},
    Notation{[](std::string_view text, const std::filesystem::path& path) {
                 return has_extension(path, {".rgg", ".xl"}) ||
                        (has(text, "==>") && (has(text, "void ") || has(text, "Axiom ==>")));
             },
             "this is a model in XL, the language of GroIMP, which is Java and needs that program; Espalier reads "
             "models of cpfg, which begin with 'lsystem:'"},
    Notation{[](std::string_view text, const std::filesystem::path& path) {
                 return has_extension(path, {".geom", ".bgeom", ".scne", ".smb"}) || has(text, "PlantGL") ||
                        (begins_line(text, "shape ") && begins_line(text, "geometry "));
             },
             "this is a scene of PlantGL: save it there as OBJ, which Espalier reads as a shape or as points"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return has_in_small(text, "axiom ") && has(text, "{") && has(text, "}") && has(text, "=") &&
                        (begins_line(text, "angle ") || has_in_small(text, "{ angle") || begins_line(text, "axiom "));
             },
             "this is an L-system of Fractint: NAME { Angle N, Axiom F, F=... }. Here, a model is 'lsystem: 1', "
             "'derivation length: 5', 'axiom: F', productions 'F --> ...' and 'endlsystem', a line each, and its turns "
             "are +(360 / N)"},
    Notation{[](std::string_view text, const std::filesystem::path& path) {
                 const auto is_end = [](std::string_view line) { return line == "@"; };
                 return has_extension(path, {".ls"}) || (any_line(text, is_end) && has(text, "="));
             },
             "this is an L-system of LParser: numbers, an axiom, rules F=... and '@'. Here, a model is 'lsystem: 1', "
             "'derivation length: 5', 'axiom: F', productions 'F --> ...' and 'endlsystem', a line each"},
    Notation{[](std::string_view text, const std::filesystem::path&) { return begins_line(text, "premise"); },
             "these are parameters of Houdini's L-systems. Here, a model is 'lsystem: 1', 'derivation length: 5', the "
             "premise as 'axiom: ...', rules as productions 'A --> ...' and 'endlsystem', a line each"},
    Notation{
        [](std::string_view text, const std::filesystem::path&) {
            return begins_line(text, "rules") &&
                   (begins_line(text, "variables") || begins_line(text, "start") || begins_line(text, "axiom"));
        },
        "this is the notation of encyclopedias: variables, constants, axiom, rules. Here, a model is 'lsystem: 1', "
        "'derivation length: 5', 'axiom: ...', productions 'A --> ...' and 'endlsystem', a line each; variables and "
        "constants need no declaration"},
    Notation{[](std::string_view text, const std::filesystem::path&) { return begins_line(text, "[[plant]]"); },
             "this is a scene: a file whose name ends in .toml"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return begins(text, "<") && has(text.substr(0, 2000), "<rsml");
             },
             "this is a root system in RSML: a file whose name ends in .rsml"},
    Notation{[](std::string_view text, const std::filesystem::path&) { return begins(text, "DGF"); },
             "this is a grid of Dune: a root system in it is a file whose name ends in .dgf"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return begins(text, "<!DOCTYPE html") || begins(text, "<!doctype html") || begins(text, "<html");
             },
             "this is a web page, not the model that it may show: download the file itself"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return begins(text, "<") && has_in_small(text.substr(0, 2000), "<arbaro");
             },
             "this is a tree of Arbaro: a file whose name ends in .xml"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return begins(text, "<") && has(text.substr(0, 2000), "<opf");
             },
             "this is a plant in the Open Plant Format: a file whose name ends in .opf"},
    Notation{[](std::string_view text, const std::filesystem::path&) { return begins(text, "<"); },
             "this is XML; Espalier reads models of cpfg, which begin with 'lsystem:'"},
    Notation{[](std::string_view text, const std::filesystem::path&) { return is_json(text); },
             "this is JSON, data of another program; Espalier reads models of cpfg, which begin with 'lsystem:'"},
    Notation{[](std::string_view text, const std::filesystem::path&) {
                 return begin_lines(text, {"code", "classes"});
             },
             "this is a measured plant, a multiscale tree graph: a file whose name ends in .mtg"},
    Notation{[](std::string_view text, const std::filesystem::path& path) {
                 return has_extension(path, {".py"}) || begins_line(text, "import ") || begins_line(text, "def ");
             },
             "this is a program in Python; Espalier reads models of cpfg, which begin with 'lsystem:'"},
};

}  // namespace

std::optional<std::string> other_language(std::string_view text, const std::filesystem::path& path) {
    // What has the head of a model is one, whatever its comments remind of.
    const bool is_model = begins_line(text, "lsystem") || begins_line(text, "l-system");
    for (const Notation& notation : notations) {
        if (notation.fits(text, path)) return notation.sentence;
        if (is_model) break;  // behind L+C, which may call itself an L-system
    }
    return std::nullopt;
}

}  // namespace espalier::language
