#include "studio/session/document_texts.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/number.h"
#include "base/text.h"
#include "studio/document/document_files.h"
#include "studio/document/sharing.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

// A number or a switch as a page may write it.
void require_value(const WrittenNumber& number, const std::string& text) {
    if (number.is_switch) {
        if (text != "true" && text != "false") throw UserError(fmt::format("{} is true or false", number.name));
        return;
    }
    const std::optional<double> value = finite_number(text);
    if (!value) throw UserError(fmt::format("{}: '{}' is not a number", number.name, text));
    if (*value < number.lowest || *value > number.highest) {
        throw UserError(fmt::format("{} lies between {} and {}", number.name, format_general(number.lowest),
                                    format_general(number.highest)));
    }
}

// As the file on disk has it.
std::string default_of(const std::string& name, const fs::path& file) {
    const std::string own = name.substr(name.find(':') + 1);
    for (const WrittenNumber& number : written_numbers(file, text_on_disk(file).value_or(""))) {
        if (number.name == own) return number.text;
    }
    throw UserError(fmt::format("the file on disk has no setting '{}'", name));
}

}  // namespace

std::string text_of(const fs::path& file, const DocumentState& state) {
    const auto found = state.unsaved.find(file);
    return found != state.unsaved.end() ? found->second : read_text(file);
}

bool DocumentTexts::learn(const Files& files) {
    const bool is_same =
        std::equal(read_.begin(), read_.end(), files.begin(), files.end(),
                   [](const auto& a, const auto& b) { return a.first == b.first && a.second.kept == b.second.kept; });
    read_ = files;
    return !is_same;
}

std::set<fs::path> DocumentTexts::editable(const DocumentState& state) const {
    std::set<fs::path> texts;
    for (const auto& [path, file] : read_) {
        if (file.kept && !is_mesh(path) && (is_palette(path) || is_text(file.bytes))) texts.insert(path);
    }
    for (const auto& [path, text] : state.unsaved) texts.insert(path);
    if (!fs::is_directory(state.opened.path)) texts.insert(state.opened.path);
    return texts;
}

std::map<fs::path, std::string> DocumentTexts::contents(const DocumentState& state) const {
    std::map<fs::path, std::string> files;
    for (const auto& [file, read] : read_) files[file] = text_of(file, state);
    for (const auto& [file, text] : state.unsaved) files[file] = text;
    files.try_emplace(state.opened.path, text_of(state.opened.path, state));
    return files;
}

std::map<std::string, DocumentTexts::Placed> DocumentTexts::numbers(const DocumentState& state) const {
    std::map<std::string, Placed> all;
    // Their words are read from other files too.
    const ReadLog reads(0, state.unsaved, permission_of(state.opened.path, library_));
    for (const fs::path& file : editable(state)) {
        const std::string role = role_of(file, state.opened.path);
        if (role != "main" && role != "model") continue;
        for (WrittenNumber& number : written_numbers(file, text_of(file, state))) {
            std::string name = role == "main" ? number.name : file.filename().string() + ":" + number.name;
            all.try_emplace(std::move(name), file, std::move(number));
        }
    }
    return all;
}

void DocumentTexts::set_number(const std::string& name, const std::optional<std::string>& text,
                               DocumentState& state) const {
    const auto known = numbers(state);
    const auto found = known.find(name);
    if (found == known.end()) throw UserError(fmt::format("there is no setting '{}'", name));
    const auto& [file, number] = found->second;
    const std::string value = text ? *text : default_of(name, file);
    require_value(number, value);
    state.unsaved[file] = with_number(text_of(file, state), number, value);
}

}  // namespace espalier::studio
