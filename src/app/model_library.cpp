#include "model_library.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"
#include "espalier/language/notation.h"

#include "base/json_text.h"
#include "program_data.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// The comment a file begins with, without its marks: a block, or lines of // or #.
std::string leading_comment(const std::string& text) {
    if (text.starts_with("/*")) return text.substr(2, text.find("*/") - 2);
    std::string comment;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line) && (line.starts_with("//") || line.starts_with("#"));) {
        comment += line.substr(std::min(line.find_first_not_of("/#"), line.size())) + "\n";
    }
    return comment;
}

// "04  Context" is about context.
std::string without_number(const std::string& title) {
    const std::size_t end = title.find_first_not_of("0123456789");
    if (end == 0 || end == std::string::npos || (title[end] != ' ' && title[end] != '\t')) return title;
    return title.substr(title.find_first_not_of(" \t", end));
}

std::string without_trailing_blanks(const std::string& line) {
    return line.substr(0, line.find_last_not_of(" \t\r") + 1);
}

}  // namespace

fs::path model_library(const fs::path& given) {
    if (!given.empty()) {
        if (fs::is_directory(given)) return given;
        throw UserError(fmt::format("--models {}: the folder does not exist", given.string()));
    }
    if (fs::is_directory("models")) return "models";
    std::error_code ignored;
    for (fs::path here = fs::current_path(ignored); here.has_relative_path(); here = here.parent_path()) {
        if (fs::is_directory(here / "models")) return here / "models";
    }
    if (const fs::path data = program_data(); !data.empty()) return data / "models";
    throw UserError("no library of models found; name its folder with --models FOLDER");
}

PartDescription describe_file(const fs::path& file) {
    PartDescription part{file.string(), "", ""};
    std::istringstream in(leading_comment(read_text(file)));
    std::size_t indent = std::string::npos;
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        line = without_trailing_blanks(line);
        const std::size_t begin = line.find_first_not_of(" \t");
        if (part.summary.empty()) {
            if (begin != std::string::npos) part.summary = without_number(line.substr(begin));
            continue;
        }
        indent = std::min(indent, begin);
        lines.push_back(line);
    }
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
    for (const std::string& line : lines) part.help += line.substr(std::min(indent, line.size())) + "\n";
    return part;
}

bool describes_model(const fs::path& file) {
    return file.extension() == ".l" || notation_of(file);
}

bool describes_scene(const fs::path& file) {
    return file.extension() == ".toml" && read_text(file).find("[[plant]]") != std::string::npos;
}

std::vector<PartDescription> models_of(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && describes_model(entry.path())) files.push_back(entry.path());
    }
    const auto place = [](const fs::path& file) { return std::pair(file.parent_path(), file.filename()); };
    std::sort(files.begin(), files.end(), [&](const auto& a, const auto& b) { return place(a) < place(b); });
    std::vector<PartDescription> models;
    for (const fs::path& file : files) models.push_back(describe_file(file));
    return models;
}

void print_part(const PartDescription& part) {
    fmt::print("{}\n  {}\n", part.name, part.summary);
    std::istringstream help(part.help);
    for (std::string line; std::getline(help, line);) fmt::print("{}{}\n", line.empty() ? "" : "  ", line);
}

void print_parts(const std::vector<PartDescription>& parts) {
    std::size_t width = 0;
    for (const PartDescription& part : parts) width = std::max(width, part.name.size());
    for (const PartDescription& part : parts) fmt::print("  {:{}}  {}\n", part.name, width, part.summary);
}

Json json_of(const std::vector<PartDescription>& parts) {
    Json list = Json::array();
    for (const PartDescription& part : parts) {
        list.push_back({{"name", part.name}, {"summary", part.summary}, {"help", part.help}});
    }
    return list;
}

void print_json(const Json& list) {
    fmt::print("{}\n", json_text(list));
}

}  // namespace espalier::app
