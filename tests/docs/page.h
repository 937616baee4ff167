// A page of the documentation: its fenced blocks, the commands in them, and what tests shorten.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace pages {

namespace fs = std::filesystem;

inline const fs::path root = ESPALIER_SOURCE_DIR;

struct Block {
    std::string language;  ///< the word after the fence: sh, console, cpp, ...
    std::vector<std::string> lines;
    std::size_t first_line = 0;                  ///< number of the first of `lines` in the page, counted from 1
    std::map<std::string, std::string> shorter;  ///< options that tests add to `espalier COMMAND`, by command
};

struct Command {
    std::string text;  ///< as it stands in the page, several lines of it where it goes on
    std::size_t line = 0;
    std::vector<std::string> output;  ///< what a console block shows below it; empty in a sh block
    bool shows_output = false;
};

inline std::vector<std::string> lines_of(const fs::path& page) {
    std::ifstream file(root / page);
    if (!file) throw std::runtime_error("cannot open " + page.string());
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

/// README.md and every page below docs/, the README first.
inline std::vector<fs::path> all_pages() {
    std::vector<fs::path> found;
    for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
        if (entry.path().extension() == ".md") found.push_back(fs::relative(entry.path(), root));
    }
    std::sort(found.begin(), found.end());
    for (const char* page : {"output/README.md", "packaging/README.md", "CONTRIBUTING.md", "README.md"})
        found.insert(found.begin(), page);
    return found;
}

/// "<!-- shortened in tests: run --steps 5; render --size 320x240 -->": options by command. Empty for other lines.
inline std::map<std::string, std::string> shorter_in(const std::string& line) {
    static const std::regex whole(R"(<!-- shortened in tests: (.*) -->)"), part(R"((\w+) ([^;]+))");
    std::smatch note;
    std::map<std::string, std::string> options;
    if (!std::regex_match(line, note, whole)) return options;
    const std::string parts = note[1];
    for (std::sregex_iterator at(parts.begin(), parts.end(), part), end; at != end; ++at) options[(*at)[1]] = (*at)[2];
    return options;
}

inline std::vector<Block> blocks_of(const fs::path& page) {
    std::vector<Block> blocks;
    std::map<std::string, std::string> shorter;
    bool inside = false;
    const std::vector<std::string> lines = lines_of(page);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const bool fence = lines[i].starts_with("```");
        if (inside && !fence) blocks.back().lines.push_back(lines[i]);
        if (!inside && fence) blocks.push_back({lines[i].substr(3), {}, i + 2, std::exchange(shorter, {})});
        if (!inside && !fence && !lines[i].empty()) shorter = shorter_in(lines[i]);
        inside = inside != fence;
    }
    return blocks;
}

/// Whether the shell would run this, instead of waiting for the rest of a loop or of a text. It is asked once.
inline bool is_whole(const std::string& text) {
    if (text.ends_with('\\')) return false;
    static std::map<std::string, bool> answers;
    const auto [answer, is_new] = answers.try_emplace(text);
    if (!is_new) return answer->second;
    std::string quoted;
    for (const char c : text) quoted += c == '\'' ? "'\\''" : std::string(1, c);
    answer->second = std::system(("test -z \"$(bash -n -c '" + quoted + "' 2>&1)\"").c_str()) == 0;
    return answer->second;
}

inline std::vector<Command> commands_of(const Block& block) {
    const bool console = block.language == "console";
    std::vector<Command> commands;
    if (!console && block.language != "sh") return commands;
    bool open = false;  // the last command goes on in the next line
    for (std::size_t i = 0; i < block.lines.size(); ++i) {
        std::string line = block.lines[i];
        const bool prompt = console && line.starts_with("$ ");
        if (prompt) line.erase(0, 2);
        if (console && !prompt && !open) {
            if (commands.empty()) throw std::runtime_error("a console block begins with '$ ' and a command");
            commands.back().output.push_back(line);
            continue;
        }
        if (!open && (line.empty() || line.starts_with('#'))) continue;
        if (open) {
            commands.back().text += "\n" + line;
        } else {
            commands.push_back({line, block.first_line + i, {}, console});
        }
        open = !is_whole(commands.back().text);
    }
    if (open) throw std::runtime_error("a command does not end in its block: " + commands.back().text);
    return commands;
}

/// False for no name at all.
inline bool is_installed(const std::string& program) {
    return !program.empty() && std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// The command without its comment and with single blanks, by which the list of commands not run names it.
inline std::string name_of(const Command& command) {
    static const std::regex comment(R"(\s+#[^\n]*)"), blanks(R"(\s+)");
    return std::regex_replace(std::regex_replace(command.text, comment, ""), blanks, " ");
}

}  // namespace pages
