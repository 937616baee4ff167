// Any bytes as TOML: what is let through to toml++ must be shallow there, too, and be settings or a mistake in words.
#include "espalier/base/settings.h"

#include "base/toml_depth.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

using namespace espalier;

constexpr std::size_t longest = 1 << 14;

int depth_of(const toml::node& node) {
    int deepest = 0;
    if (const toml::table* table = node.as_table()) {
        for (const auto& [key, value] : *table) deepest = std::max(deepest, 1 + depth_of(value));
    } else if (const toml::array* array = node.as_array()) {
        for (const toml::node& value : *array) deepest = std::max(deepest, 1 + depth_of(value));
    }
    return deepest;
}

// An array of tables is one part of a key, and two levels.
void check_depth(std::string_view text) {
    if (deeper_than_toml_may_be(text)) return;
    try {
        if (depth_of(toml::parse(text, std::string_view("fuzz.toml"))) > 2 * deepest_toml + 1) std::abort();
    } catch (const toml::parse_error&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size > longest) return 0;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    check_depth(text);
    try {
        Settings settings = Settings::parse_toml(text, "fuzz.toml");
        settings.resolved_json();
        settings.set("fuzz.key", text);
        settings.set(text.substr(0, text.find('\n')), "1");
        settings.reject_unread();
    } catch (const UserError&) {
    }
    return 0;
}
