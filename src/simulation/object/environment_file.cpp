#include "simulation/object/environment_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/environment/environment_process.h"

#include "base/text.h"
#include "base/toml_text.h"
#include "environment/exchange/communication.h"
#include "geometry/grid_operations.h"
#include "simulation/object/plain_lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace espalier::simulation {
namespace {

namespace fs = std::filesystem;

/// The file called `name` beside the one that names it, or else in `folder`. Throws UserError if it is in neither.
fs::path named_file(const std::string& name, const fs::path& beside, const fs::path& folder, const Place& place) {
    std::error_code ignored;
    for (const fs::path& where : {beside, folder}) {
        if (fs::is_regular_file(where / name, ignored)) return where / name;
    }
    const std::string there = beside.empty() ? "here" : "in " + beside.string();
    throw UserError(place, fmt::format("there is no file '{}' {}{}", name, there,
                                       folder.empty() || folder == beside ? "" : " or in " + folder.string()));
}

namespace fs = std::filesystem;

/// One .e file as it stands, before its process is known.
struct Lines {
    std::vector<std::string> command;
    Place command_place;
    std::vector<std::pair<std::string, std::string>> formats;  ///< key of the table `turtle`, printf format
    bool following_module = true;
    bool binary = false;
    std::string timeout;  ///< seconds; "": the default
};

// Meant for other ways to talk to a process, or for the window.
const std::vector<std::string> other_keywords{"communication type", "interpreted modules", "when interpret",
                                              "remote host",        "strings only",        "verbose"};

const std::vector<std::pair<std::string, std::string>> format_keywords{{"turtle position", "position"},
                                                                       {"turtle heading", "heading"},
                                                                       {"turtle left", "left"},
                                                                       {"turtle up", "up"},
                                                                       {"turtle line width", "line_width"},
                                                                       {"line width", "line_width"},
                                                                       {"turtle scale factor", "scale_factor"},
                                                                       {"scale factor", "scale_factor"}};

std::vector<std::string> known_keywords() {
    std::vector<std::string> known = other_keywords;
    for (const auto& entry : format_keywords) known.push_back(entry.first);
    for (const char* keyword : {"executable", "following module", "binary data", "timeout"}) {
        known.emplace_back(keyword);
    }
    return known;
}

class LineReader {
public:
    explicit LineReader(EnvironmentFile& result) : result_(result) {}

    Lines read(const fs::path& path) {
        for (const PlainLine& line : plain_lines(read_text(path), path.string())) {
            if (!trimmed(line.text, " \t").empty()) read_line(line);
        }
        if (lines_.command.empty()) {
            throw UserError({path.string(), 0, 0}, "no process answers: there is no line 'executable: PROGRAM'");
        }
        return std::move(lines_);
    }

private:
    void read_line(const PlainLine& line) {
        const std::size_t end = std::min(line.text.find_first_of("\t:"), line.text.size());
        const std::string keyword = line.text.substr(0, end);
        const std::string value = end < line.text.size() ? line.text.substr(end + 1) : "";
        const std::string word(trimmed(value, " \t"));
        if (keyword == "executable") {
            lines_.command = words_of(value, " \t");
            lines_.command_place = line.place;
        } else if (keyword == "following module") {
            lines_.following_module = !word.starts_with("no");
        } else if (keyword == "binary data") {
            lines_.binary = word == "on";
        } else if (keyword == "timeout") {
            if (word.find_first_not_of("0123456789.") != std::string::npos) {
                throw UserError(line.place, "a timeout is a number of seconds", line.text);
            }
            lines_.timeout = word;
        } else if (!read_format(keyword, value, line)) {
            note_other(keyword, line);
        }
    }

    bool read_format(const std::string& keyword, const std::string& value, const PlainLine& line) {
        const auto found = std::find_if(format_keywords.begin(), format_keywords.end(),
                                        [&](const auto& entry) { return entry.first == keyword; });
        if (found == format_keywords.end()) return false;
        TurtleFormat::read(value, line.place);  // complains here, where the line is known
        lines_.formats.emplace_back(found->second, value);
        return true;
    }

    void note_other(const std::string& keyword, const PlainLine& line) {
        if (std::find(other_keywords.begin(), other_keywords.end(), keyword) != other_keywords.end()) {
            result_.unused.push_back(keyword);
            return;
        }
        result_.diagnostics.push_back({Diagnostic::Severity::error, line.place,
                                       fmt::format("'{}' means nothing in an environment file{}", keyword,
                                                   did_you_mean(keyword, known_keywords())),
                                       line.text});
    }

    EnvironmentFile& result_;
    Lines lines_;
};

/// `honda81 -e plant.e density.spec`: the process, and the file with its parameters.
struct Command {
    std::string program;
    std::optional<std::string> parameters;
};

std::string program_of(const Lines& lines) {
    std::string program = fs::path(lines.command[0]).filename().string();
    if (program.ends_with(".exe")) program.resize(program.size() - 4);
    return program;
}

Command command_of(const Lines& lines, std::vector<Diagnostic>& diagnostics) {
    Command command;
    command.program = program_of(lines);
    for (std::size_t i = 1; i < lines.command.size(); ++i) {
        const std::string& word = lines.command[i];
        if (word == "-e" || word == "-k" || word == "-ext") {
            ++i;  // cpfg's own, with a value
        } else if (word == "-no_xserver") {
            continue;  // QuasiMC's: without a window, as everything here
        } else if (!word.starts_with('-') && !command.parameters) {
            command.parameters = word;
        } else {
            diagnostics.push_back({Diagnostic::Severity::error, lines.command_place,
                                   fmt::format("'{}' on the command line of {} is ignored", word, command.program)});
        }
    }
    return command;
}

const std::map<std::string, const ProcessType*>& process_types() {
    open_grid_library();
    return registered<ProcessType>();
}

// Programs of cpfg that are a process of Espalier under another name, which knows them by `program`.
bool follows_rays(const std::string& program) {
    return program == "QuasiMC" || program == "MonteCarlo" || program == "radiosity";
}

std::string process_of(const std::string& program) {
    return follows_rays(program) ? "ray-light" : program;
}

std::vector<std::string> known_programs() {
    std::vector<std::string> names{"multiple", "QuasiMC", "MonteCarlo", "radiosity"};
    for (const auto& entry : process_types()) names.push_back(entry.first);
    std::sort(names.begin(), names.end());
    return names;
}

bool is_process(const std::string& program) {
    return program == "multiple" || process_types().contains(process_of(program));
}

// What answers instead of a program of cpfg that is missing; "" if nothing does.
std::string near_in_purpose(const std::string& program) {
    if (program != "soil") return "";
    return ". Near to cpfg's soil in purpose is 'soil-water', but its parameters and answers are its own: a TOML file, "
           "as "
           "`executable: soil-water FILE.toml`";
}

// `./mine`, which is no process of Espalier.
bool is_own_program(const Lines& lines) {
    return lines.command[0].find('/') != std::string::npos && !is_process(program_of(lines));
}

// What the file says beside the parameters: keys of [environment.<name>] and their values as TOML.
std::vector<std::pair<std::string, std::string>> communication_of(const Lines& lines, const std::string& program) {
    std::vector<std::pair<std::string, std::string>> entries;
    if (process_types().at(process_of(program))->has_numbers_of_cpfg)
        entries.emplace_back("numbers", toml_text("cpfg"));
    if (!lines.following_module) entries.emplace_back("following_module", "false");
    if (!lines.binary) entries.emplace_back("digits", "6");
    std::map<std::string, std::string> turtle;
    for (const auto& [key, format] : lines.formats) turtle[key] = key + " = " + toml_text(format);
    std::vector<std::string> formats;
    for (const auto& format : turtle) formats.push_back(format.second);
    if (!formats.empty()) entries.emplace_back("turtle", fmt::format("{{ {} }}", fmt::join(formats, ", ")));
    return entries;
}

// On the executable's line, so that messages about the table name that line.
Settings table_of(const std::string& entries, const Lines& lines, const fs::path& path) {
    const std::string above(static_cast<std::size_t>(lines.command_place.line - 1), '\n');
    return Settings::parse_toml(fmt::format("{}process = {{ {} }}", above, entries), path.string()).table("process");
}

// The parameters of Espalier's own processes are a TOML file.
Settings table_of(const Lines& lines, const Command& command, const fs::path& parameters, const fs::path& path) {
    const auto communication = communication_of(lines, command.program);
    if (parameters.extension() == ".toml") {
        Settings table = Settings::read_toml(parameters);
        table.set("process", toml_text(command.program));
        for (const auto& [key, value] : communication) {
            if (!table.has(key)) table.set(key, value);
        }
        return table;
    }
    std::string entries = "process = " + toml_text(process_of(command.program));
    if (follows_rays(command.program)) entries += ", program = " + toml_text(command.program);
    if (!parameters.empty()) entries += ", parameters = " + toml_text(parameters.string());
    for (const auto& [key, value] : communication) entries += fmt::format(", {} = {}", key, value);
    return table_of(entries, lines, path);
}

// cpfg puts `-e FILE` before the arguments of a program, whether it stands there or not.
Settings table_of_own_program(const Lines& lines, const fs::path& program, const fs::path& path) {
    const std::string folder = fs::absolute(path).parent_path().string();
    std::string words = fmt::format("{}, \"-e\", {}", toml_text(program.string()), toml_text(path.filename().string()));
    for (std::size_t i = 1; i < lines.command.size(); ++i) words += ", " + toml_text(lines.command[i]);
    std::string entries = fmt::format("process = \"external\", command = [{}], folder = {}", words, toml_text(folder));
    if (!lines.timeout.empty()) entries += ", timeout = " + lines.timeout;
    for (const auto& [key, value] : communication_of(lines, "external"))
        entries += fmt::format(", {} = {}", key, value);
    return table_of(entries, lines, path);
}

class FileReader {
public:
    explicit FileReader(fs::path folder) : folder_(std::move(folder)) {}

    EnvironmentFile read(const fs::path& path) {
        result_.files.push_back(path);
        const Lines lines = LineReader(result_).read(path);
        if (is_own_program(lines)) {
            add_own_program(program_of(lines), lines, path);
            return std::move(result_);
        }
        const Command command = command_of(lines, result_.diagnostics);
        if (command.program != "multiple") {
            add_process(command.program, lines, command, path);
            return std::move(result_);
        }
        result_.routed = true;
        read_fields(named(command, lines, path));
        return std::move(result_);
    }

private:
    // The parameter file of `multiple`: one environment file a line.
    void read_fields(const fs::path& list) {
        if (list.empty()) throw UserError("process 'multiple' needs a file that names environment files");
        for (const PlainLine& line : plain_lines(read_text(list), list.string())) {
            const std::size_t end = std::min(line.text.find_first_of("\t:"), line.text.size());
            const std::string keyword = line.text.substr(0, end);
            if (keyword == "verbose" || trimmed(line.text, " \t").empty()) continue;
            if (keyword != "field communication file") {
                result_.diagnostics.push_back({Diagnostic::Severity::error, line.place,
                                               fmt::format("'{}' means nothing to process 'multiple'", keyword),
                                               line.text});
                continue;
            }
            read_field(std::string(trimmed(line.text.substr(std::min(end + 1, line.text.size())), " \t")), line, list);
        }
        if (result_.processes.empty()) {
            throw UserError({list.string(), 0, 0}, "no process: there is no line 'field communication file: FILE'");
        }
    }

    void read_field(const std::string& name, const PlainLine& line, const fs::path& list) {
        const fs::path path = named_file(name, list.parent_path(), folder_, line.place);
        result_.files.push_back(path);
        const Lines lines = LineReader(result_).read(path);
        if (is_own_program(lines)) {
            return add_own_program(fmt::format("{}-{}", program_of(lines), result_.processes.size()), lines, path);
        }
        const Command command = command_of(lines, result_.diagnostics);
        if (command.program == "multiple") {
            throw UserError(lines.command_place, "process 'multiple' cannot be one of several itself");
        }
        add_process(fmt::format("{}-{}", command.program, result_.processes.size()), lines, command, path);
    }

    void add_process(const std::string& name, const Lines& lines, const Command& command, const fs::path& path) {
        if (!is_process(command.program)) {
            const std::vector<std::string> known = known_programs();
            throw UserError(
                lines.command_place,
                fmt::format(
                    "there is no environment process '{}'{}; there are {}{}. A program of your own is named with "
                    "its folder, as ./{}. With --without-environment the plant grows without answers",
                    command.program, did_you_mean(command.program, known), fmt::join(known, ", "),
                    near_in_purpose(command.program), command.program),
                fmt::format("executable: {}", fmt::join(lines.command, " ")));
        }
        const fs::path parameters = named(command, lines, path);
        if (follows_rays(command.program) && (parameters.empty() || parameters.extension() == ".toml")) {
            throw UserError(lines.command_place,
                            fmt::format("{} needs its file of parameters, as in `executable: {} FILE.spec`; a table of "
                                        "TOML is for `executable: ray-light FILE.toml`",
                                        command.program, command.program));
        }
        result_.processes.emplace_back(name, table_of(lines, command, parameters, path));
    }

    // Relative to the folder of the file that names it, or to that of the object.
    void add_own_program(const std::string& name, const Lines& lines, const fs::path& path) {
        const fs::path program = named_file(lines.command[0], path.parent_path(), folder_, lines.command_place);
        result_.files.push_back(program);
        result_.processes.emplace_back(name,
                                       table_of_own_program(lines, fs::absolute(program).lexically_normal(), path));
        const Place place{path.string(), 0, 0};
        for (const char* keyword : {"interpreted modules", "when interpret", "remote host"}) {
            if (std::erase(result_.unused, keyword) == 0) continue;
            const std::string message = fmt::format(
                "'{}' has no effect: a program of your own runs on this machine and "
                "is told modules, not their geometry",
                keyword);
            result_.diagnostics.push_back({Diagnostic::Severity::error, place, message, ""});
        }
    }

    fs::path named(const Command& command, const Lines& lines, const fs::path& path) {
        if (!command.parameters) return {};
        const fs::path file = named_file(*command.parameters, path.parent_path(), folder_, lines.command_place);
        result_.files.push_back(file);
        return file;
    }

    fs::path folder_;
    EnvironmentFile result_;
};

}  // namespace

EnvironmentFile read_environment_file(const fs::path& path, const fs::path& folder) {
    return FileReader(folder).read(path);
}

}  // namespace espalier::simulation
