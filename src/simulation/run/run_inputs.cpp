#include "simulation/run/run_inputs.h"

#include "base/folder.h"

#include <fmt/format.h>

#include <charconv>

namespace espalier::simulation {
namespace {

using Json = nlohmann::ordered_json;

bool is_text(const std::string& bytes) {
    try {
        [[maybe_unused]] const std::string quoted = Json(bytes).dump();
        return true;
    } catch (const Json::type_error&) {  // bytes that are no UTF-8
        return false;
    }
}

std::string to_hex(const std::string& bytes) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text;
    text.reserve(2 * bytes.size());
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        text += digits[byte >> 4];
        text += digits[byte & 15];
    }
    return text;
}

// The bytes end at the first character that is no digit; the digest then differs.
std::string from_hex(const std::string& text) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < text.size(); i += 2) {
        unsigned value = 0;
        if (std::from_chars(text.data() + i, text.data() + i + 2, value, 16).ptr != text.data() + i + 2) break;
        bytes += static_cast<char>(value);
    }
    return bytes;
}

}  // namespace

Json inputs_json(const ReadLog* inputs, const std::filesystem::path& output) {
    Json list = Json::array();
    if (!inputs) return list;
    std::error_code unknown;
    for (const auto& [path, file] : inputs->files()) {
        if (!output.empty() && !resolved_below(path, output, unknown).empty()) continue;
        Json input = {{"path", path.string()}, {"size", file.size}, {"digest", fmt::format("{:016x}", file.digest)}};
        if (file.kept && is_text(file.bytes)) {
            input["text"] = file.bytes;
        } else if (file.kept) {
            input["hex"] = to_hex(file.bytes);
        }
        list.push_back(std::move(input));
    }
    return list;
}

ReadLog::File input_of(const Json& json) {
    ReadLog::File file;
    file.size = json.at("size").get<std::size_t>();
    const std::string digits = json.at("digest").get<std::string>();
    std::from_chars(digits.data(), digits.data() + digits.size(), file.digest, 16);
    file.kept = json.contains("text") || json.contains("hex");
    if (json.contains("text")) file.bytes = json["text"].get<std::string>();
    if (json.contains("hex")) file.bytes = from_hex(json["hex"].get<std::string>());
    return file;
}

}  // namespace espalier::simulation
