// Which files of a folder make its model.
#include "espalier/base/file.h"
#include "espalier/language/notation.h"
#include "espalier/simulation/object.h"

#include "simulation/object/plain_lines.h"
#include "simulation/object/specifications.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;

const char* const specifications_name = "specifications";

std::string program_of(const MenuCommand& command) {
    return fs::path(command.words[0]).filename().string();
}

Diagnostic warning(const fs::path& path, const std::string& message) {
    Diagnostic diagnostic;
    diagnostic.severity = Diagnostic::Severity::warning;
    diagnostic.place.file = path.string();
    diagnostic.message = message;
    return diagnostic;
}

// "dir/" and "dir" are the same object.
std::string folder_name(const fs::path& folder) {
    const fs::path whole = fs::absolute(folder).lexically_normal();
    const std::string name = whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
    return name.empty() ? "object" : name;
}

/// Reads the switches of a `cpfg` command: those that name files are kept, those of the window ignored.
class CommandReader {
public:
    CommandReader(const MenuCommand& command, const fs::path& folder, ObjectFiles& object)
        : command_(command), folder_(folder), object_(object) {}

    void read() {
        for (next_ = 1; next_ < command_.words.size();) {
            const std::string& word = command_.words[next_++];
            if (word.size() > 1 && word[0] == '-') {
                read_switch(word);
            } else {
                plain_.push_back(word);
            }
        }
        if (plain_.empty()) fail("this command names no model");
        object_.model = file(plain_[0]);
        if (plain_.size() > 1) object_.view = file(plain_[1]);
        if (plain_.size() > 2) object_.animation = file(plain_[2]);
        for (std::size_t i = 3; i < plain_.size(); ++i) note(fmt::format("'{}' is one file too many", plain_[i]));
        if (!environment_.empty()) object_.environment = file(environment_);
        // Either colours or materials: what stands later on the line decides.
        for (const auto& [set, name] : sets_) add_set(set, name);
    }

private:
    void read_switch(const std::string& word) {
        static const std::set<std::string> with_two{"-w", "-wp", "-wr", "-wpr"};
        static const std::set<std::string> with_one{"-wt",   "-rmode", "-P",  "-b",   "-str",
                                                    "-strb", "-gls",   "-ps", "-ray", "-vv"};
        static const std::set<std::string> with_none{"-wnb", "-a", "-v", "-V", "-d", "-mb", "-homo", "-g", "-h"};
        if (with_two.count(word)) return skip(2);
        if (with_none.count(word)) return;
        if (with_one.count(word)) {
            if (word == "-P") note("another preprocessor ('-P') is not used");
            return skip(1);
        }
        if (word == "-e") {
            const std::string name = value(word);
            if (environment_.empty()) environment_ = name;
            return;
        }
        if (word[1] == 'm' || word[1] == 'M') return read_set(word);
        if (word[1] == 'c' || word[1] == 's') return;  // colour set, window size
        note(fmt::format("the switch '{}' is ignored", word));
    }

    void read_set(const std::string& word) {
        const bool materials = word[1] == 'M';
        const std::optional<int> set = word.size() == 2 ? 1 : leading_integer(word.substr(2));
        if (!set || *set < 0) return note(fmt::format("the switch '{}' is ignored", word));
        if (materials != materials_) sets_.clear();
        materials_ = materials;
        sets_[*set] = value(word);
    }

    void add_set(int set, const std::string& name) {
        const fs::path path = inside(name);
        if (!fs::is_regular_file(path)) return note(fmt::format("there is no file '{}': colours are white", name));
        (materials_ ? object_.materials : object_.colour_maps)[set] = path;
    }

    std::string value(const std::string& word) {
        if (next_ == command_.words.size()) fail(fmt::format("'{}' names no file", word));
        return command_.words[next_++];
    }
    void skip(std::size_t words) { next_ = std::min(next_ + words, command_.words.size()); }

    fs::path inside(const std::string& name) const {
        const fs::path path = fs::path(name).lexically_normal();
        if (path.is_absolute() || path.begin() == path.end() || *path.begin() == "..") {
            fail(fmt::format("'{}' is not in the object's folder", name));
        }
        return folder_ / path;
    }

    fs::path file(const std::string& name) const {
        const fs::path path = inside(name);
        if (!fs::is_regular_file(path)) fail(fmt::format("there is no file '{}' in {}", name, folder_.string()));
        return path;
    }

    [[noreturn]] void fail(const std::string& message) const {
        throw UserError(command_.place, message, command_.line);
    }
    void note(const std::string& message) {
        object_.diagnostics.push_back({Diagnostic::Severity::warning, command_.place, message, command_.line});
    }

    const MenuCommand& command_;
    const fs::path& folder_;
    ObjectFiles& object_;
    std::size_t next_ = 1;
    std::vector<std::string> plain_;
    std::string environment_;
    std::map<int, std::string> sets_;
    bool materials_ = false;
};

std::vector<fs::path> files_with(const fs::path& folder, const std::vector<std::string>& extensions) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string(), extension = entry.path().extension().string();
        const bool is_meant = std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
        if (is_meant && !name.starts_with('.') && entry.is_regular_file()) files.push_back(folder / name);
    }
    std::sort(files.begin(), files.end());
    return files;
}

std::string names_of(const std::vector<fs::path>& files) {
    std::vector<std::string> names;
    for (const fs::path& file : files) names.push_back(file.filename().string());
    return fmt::format("{}", fmt::join(names, ", "));
}

fs::path only_file(const fs::path& folder, const std::vector<std::string>& extensions, const std::string& option) {
    const std::vector<fs::path> files = files_with(folder, extensions);
    if (files.size() <= 1) return files.empty() ? fs::path() : files.front();
    throw UserError(fmt::format("{} has no '{}', and several files could be meant: {}. Say which{}", folder.string(),
                                specifications_name, names_of(files), option));
}

// Colours change nothing that grows, so several files are no mistake.
void take_colours(const fs::path& folder, ObjectFiles& object) {
    const std::vector<fs::path> maps = files_with(folder, {".map"}), materials = files_with(folder, {".mat"});
    if (maps.size() == 1) {
        object.colour_maps[1] = maps.front();
    } else if (maps.empty() && materials.size() == 1) {
        object.materials[1] = materials.front();
    } else if (maps.size() + materials.size() > 1) {
        object.diagnostics.push_back(
            warning(folder, fmt::format("none of {} is taken: --colour-map or --materials says which",
                                        names_of(maps.empty() ? materials : maps))));
    }
}

void take_by_extension(const fs::path& folder, ObjectFiles& object) {
    std::vector<std::string> extensions{".l"};
    for (const auto& [name, notation] : registered<NotationType>()) {
        if (notation->recognises) continue;  // a README.txt beside a model is no cylinder model
        const bool is_known = std::find(extensions.begin(), extensions.end(), notation->extension) != extensions.end();
        if (!is_known) extensions.push_back(notation->extension);
    }
    object.model = only_file(folder, extensions, fmt::format(": espalier run {}/MODEL", folder.string()));
    if (object.model.empty()) {
        throw UserError(fmt::format("{} holds no model: neither a file '{}' nor one that ends in {}", folder.string(),
                                    specifications_name, fmt::join(extensions, ", ")));
    }
    object.view = only_file(folder, {".v"}, " with --view");
    object.animation = only_file(folder, {".a"}, " with --animate");
    object.environment = only_file(folder, {".e"}, " with --environment");
    take_colours(folder, object);
}

void take_by_specifications(const fs::path& folder, ObjectFiles& object) {
    const fs::path path = folder / specifications_name;
    const Specifications specifications = read_specifications(path);
    object.listed = specifications.files;
    object.diagnostics = specifications.diagnostics;
    const auto starts = [&](const char* program) {
        return std::find_if(specifications.commands.begin(), specifications.commands.end(),
                            [&](const MenuCommand& command) { return program_of(command) == program; });
    };
    if (const auto command = starts("cpfg"); command != specifications.commands.end()) {
        CommandReader(*command, folder, object).read();
        return;
    }
    if (const auto command = starts("lpfg"); command != specifications.commands.end()) {
        throw UserError(command->place,
                        "this object is a program for lpfg, in C++; Espalier reads the language of cpfg",
                        command->line);
    }
    object.diagnostics.push_back(
        warning(path, "no command of the menu starts cpfg; the files are recognised by their extensions"));
    take_by_extension(folder, object);
}

}  // namespace

ObjectFiles read_object_folder(const fs::path& folder) {
    ObjectFiles object;
    object.name = folder_name(folder);
    object.folder = folder;
    if (fs::is_regular_file(folder / specifications_name)) {
        take_by_specifications(folder, object);
    } else {
        take_by_extension(folder, object);
    }
    // Other notations have no arithmetic of cpfg.
    if (!notation_of(object.model)) object.arithmetic = Arithmetic::cpfg;
    return object;
}

std::vector<std::string> unused_files(const ObjectFiles& object) {
    std::vector<fs::path> to_read{object.model, object.view, object.animation, object.environment};
    std::set<std::string> used;
    for (const auto& sets : {object.colour_maps, object.materials}) {
        for (const auto& entry : sets) used.insert(entry.second.filename().string());
    }
    for (const fs::path& path : to_read) used.insert(path.filename().string());
    // A file that is used may name others: models include, views name surfaces, environments their parameters.
    for (std::size_t i = 0; i < to_read.size(); ++i) {
        if (to_read[i].empty() || !fs::is_regular_file(to_read[i])) continue;
        const std::string text = read_text(to_read[i]);
        for (const std::string& name : object.listed) {
            if (text.find(name) != std::string::npos && used.insert(name).second)
                to_read.push_back(object.folder / name);
        }
    }
    std::vector<std::string> unused;
    for (const std::string& name : object.listed) {
        const bool belongs = name == specifications_name || name == "icon" || name == "description.txt";
        if (!belongs && !used.count(name)) unused.push_back(name);
    }
    return unused;
}

}  // namespace espalier::simulation
