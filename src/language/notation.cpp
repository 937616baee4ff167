#include "espalier/language/notation.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "language/text/other_language.h"
#include "language/text/plain_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <functional>
#include <optional>
#include <set>
#include <utility>

namespace espalier::language {

namespace {

std::string head_of(const std::filesystem::path& path) {
    constexpr std::size_t enough = 4096;
    if (!is_readable(path)) return "";
    std::ifstream file(path, std::ios::binary);
    std::string head(enough, '\0');
    file.read(head.data(), static_cast<std::streamsize>(enough));
    head.resize(static_cast<std::size_t>(file.gcount()));
    return head;
}

MeasuredPlants plants_of(const NotationType& notation, std::string text, const std::filesystem::path& path,
                         const MeasuredOptions& options) {
    require_text(text, path.string());
    MeasuredPlants plants = notation.measure(with_plain_lines(std::move(text)), path, options);
    plants.path = path;
    for (auto axis = plants.axes.rbegin(); axis != plants.axes.rend(); ++axis) {
        if (!axis->bearer) plants.plants[axis->plant].base = axis->nodes.front().at;
    }
    plants.separate = options.separate.value_or(true);
    return plants;
}

/// " .mtg .rsml"
std::string extensions_of(const std::function<bool(const NotationType&)>& counts) {
    std::set<std::string> extensions;
    for (const auto& [name, known] : registered<NotationType>()) {
        if (counts(*known)) extensions.insert(known->extension);
    }
    return extensions.empty() ? " none" : fmt::format(" {}", fmt::join(extensions, " "));
}

}  // namespace

const NotationType* notation_of(const std::filesystem::path& path) {
    std::optional<std::string> head;
    const NotationType* any = nullptr;
    for (const auto& [name, notation] : registered<NotationType>()) {
        if (path.extension() != notation->extension) continue;
        if (!notation->recognises) {
            any = notation;
            continue;
        }
        if (!head) head = head_of(path);
        if (notation->recognises(*head)) return notation;
    }
    return any;
}

bool holds_measured_plants(const std::filesystem::path& path) {
    const NotationType* const notation = notation_of(path);
    return notation && notation->measure;
}

MeasuredPlants read_measured_plants(const std::filesystem::path& path, const MeasuredOptions& options) {
    const NotationType* const notation = notation_of(path);
    if (notation && notation->measure) return plants_of(*notation, read_text(path), path, options);
    if (const std::optional<std::string> other = other_language(head_of(path), path)) {
        throw UserError(fmt::format("{}: {}", path.string(), *other));
    }
    const std::string extensions = extensions_of([](const NotationType& known) { return known.measure != nullptr; });
    throw UserError(fmt::format("{} is no file of measured plants: their extensions are{}", path.string(), extensions));
}

TranslatedText translated(const NotationType& notation, const std::string& text, const std::filesystem::path& path) {
    if (notation.measure) {
        const MeasuredPlants plants = plants_of(notation, text, path, {});
        return {measured_model_text(plants), {}, plants.warnings};
    }
    require_text(text, path.string());
    return notation.translate(with_plain_lines(text), path);
}

TranslatedText translated(const std::filesystem::path& path) {
    if (const NotationType* notation = notation_of(path)) return translated(*notation, read_text(path), path);
    const std::string extensions = extensions_of([](const NotationType&) { return true; });
    throw UserError(
        fmt::format("{} is in no notation that can be translated; their extensions are{}", path.string(), extensions));
}

}  // namespace espalier::language
