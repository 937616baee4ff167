#include "studio/session/document_message.h"

#include "studio/document/document_files.h"
#include "studio/document/graph_text.h"
#include "studio/document/point_text.h"
#include "studio/document/view_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <tuple>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

// "leaves: mean number of leaves on an internode" for LEAVES; a summary that repeats the name is enough.
std::string label_of(const WrittenNumber& number) {
    const std::string last = number.name.substr(number.name.rfind('.') + 1);
    std::string words;
    for (const char c : last) words += c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const bool has_summary = number.label != last && number.label != number.name;
    if (!has_summary) return last;
    return number.label.starts_with(words) ? number.label : words + ": " + number.label;
}

Nullable<double> bound(double value) {
    return std::isfinite(value) ? Nullable<double>(value) : Nullable<double>();
}

std::string group_of(const fs::path& file, const fs::path& main, const std::string& group) {
    if (file == main) return group;
    const std::string name = file.filename().string();
    return group.empty() ? name : name + ", " + group;
}

/// The numbers of files as they stand on disk.
class SavedNumbers {
public:
    /// As the file writes it; as it is now if the file does not.
    std::string text_of(const fs::path& file, const WrittenNumber& number) {
        const auto [place, is_new] = files_.try_emplace(file);
        if (is_new) place->second = written_numbers(file, text_on_disk(file).value_or(""));
        const auto saved = std::find_if(place->second.begin(), place->second.end(),
                                        [&](const WrittenNumber& other) { return other.name == number.name; });
        return saved == place->second.end() ? number.text : saved->text;
    }

private:
    std::map<fs::path, std::vector<WrittenNumber>> files_;
};

struct NumberRow {
    const std::string* name;
    const fs::path* file;
    const WrittenNumber* number;
};

// Those of the main file first, each file's in the order of its text.
std::vector<NumberRow> in_order(const std::map<std::string, DocumentTexts::Placed>& numbers, const fs::path& main) {
    std::vector<NumberRow> rows;
    for (const auto& [name, placed] : numbers) rows.push_back({&name, &placed.first, &placed.second});
    std::stable_sort(rows.begin(), rows.end(), [&](const NumberRow& a, const NumberRow& b) {
        return std::tuple(*a.file != main, *a.file, a.number->offset) <
               std::tuple(*b.file != main, *b.file, b.number->offset);
    });
    return rows;
}

}  // namespace

std::vector<ShownText> shown_texts(const DocumentTexts& texts, const DocumentState& state,
                                   const std::set<fs::path>& disputed) {
    std::vector<ShownText> list;
    for (const fs::path& file : texts.editable(state)) {
        ShownText text{file.string(), role_of(file, state.opened.path), language_of(file), {}, false, false};
        text.content = content_of(file, text_of(file, state));
        text.changed = state.unsaved.contains(file) && text_on_disk(file) != state.unsaved.at(file);
        text.disputed = disputed.contains(file);
        if (text.disputed && !is_palette(file)) text.disk = text_on_disk(file);
        if (text.disk && !is_text(*text.disk)) text.disk.reset();
        list.insert(text.role == "main" ? list.begin() : list.end(), std::move(text));
    }
    return list;
}

std::vector<ShownSetting> shown_settings(const DocumentTexts& texts, const DocumentState& state) {
    const std::map<std::string, DocumentTexts::Placed> numbers = texts.numbers(state);
    std::vector<ShownSetting> list;
    SavedNumbers saved;
    for (const NumberRow& row : in_order(numbers, state.opened.path)) {
        const WrittenNumber& number = *row.number;
        ShownSetting& setting = list.emplace_back();
        setting.name = *row.name;
        setting.label = label_of(number);
        setting.kind = number.is_switch ? "switch" : "number";
        setting.value = number.value;
        setting.text = number.text;
        setting.fallback = saved.text_of(*row.file, number);
        setting.lowest = bound(number.lowest);
        setting.highest = bound(number.highest);
        setting.whole = number.whole;
        setting.unit = number.unit;
        setting.group = group_of(*row.file, state.opened.path, number.group);
        setting.changed = setting.text != setting.fallback;
    }
    return list;
}

std::vector<ComponentGraph> shown_graphs(const DocumentTexts& texts, const DocumentState& state) {
    std::vector<ComponentGraph> graphs;
    for (const fs::path& file : texts.editable(state)) {
        if (language_of(file) != "pgraph") continue;
        if (std::optional<ComponentGraph> graph = read_graph(file, text_of(file, state)))
            graphs.push_back(std::move(*graph));
    }
    return graphs;
}

std::vector<PointCurve> shown_curves(const DocumentTexts& texts, const DocumentState& state) {
    std::vector<PointCurve> curves;
    for (const fs::path& file : texts.editable(state)) {
        for (PointCurve& curve : read_curves(file, text_of(file, state))) curves.push_back(std::move(curve));
    }
    return curves;
}

std::vector<ViewEntry> shown_view_entries(const DocumentTexts& texts, const DocumentState& state) {
    std::vector<ViewEntry> entries;
    for (const fs::path& file : texts.editable(state)) {
        if (language_of(file) != "view") continue;
        for (ViewEntry& entry : read_view_entries(file, text_of(file, state))) entries.push_back(std::move(entry));
    }
    return entries;
}

}  // namespace espalier::studio
