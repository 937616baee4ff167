#include "simulation/scene/variation.h"

#include "espalier/base/error.h"

#include "base/number.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <set>

namespace espalier::simulation {
namespace {

constexpr double most = 1e6;

std::vector<std::string> split(const std::string& text, const std::string& separator) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t at; (at = text.find(separator, begin)) != std::string::npos; begin = at + separator.size()) {
        parts.push_back(text.substr(begin, at - begin));
    }
    parts.push_back(text.substr(begin));
    return parts;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
    throw UserError(fmt::format("--vary {}: {}", text, why));
}

// Twelve digits: 0.3 is written so, whatever the last bit of its sum was.
std::vector<std::string> evenly(const std::string& text, const std::vector<std::string>& parts) {
    const auto first = finite_number(parts[0]), last = finite_number(parts[1]), count = finite_number(parts[2]);
    if (!first || !last || !count || !std::isfinite(*last - *first) || *count != std::trunc(*count) ||
        !(*count >= 1 && *count <= most)) {
        refuse(text, "FIRST:LAST:COUNT are expected, such as 0.1:0.9:9");
    }
    std::vector<std::string> values;
    for (int i = 0; i < static_cast<int>(*count); ++i) {
        const double share = *count == 1 ? 0 : i / (*count - 1);
        values.push_back(fmt::format("{:.12g}", *first + share * (*last - *first)));
    }
    return values;
}

std::vector<std::string> one_by_one(const std::string& text, const std::vector<std::string>& parts) {
    const auto first = finite_number(parts[0]), last = finite_number(parts[1]);
    const bool whole = first && last && *first == std::trunc(*first) && *last == std::trunc(*last);
    if (!whole || *first > *last || std::max(-*first, *last) > 1e15) {
        refuse(text, "FIRST..LAST are expected, whole numbers such as 1..10");
    }
    if (*last - *first >= most) refuse(text, "more than a million values");
    std::vector<std::string> values;
    for (auto value = static_cast<long long>(*first); value <= static_cast<long long>(*last); ++value) {
        values.push_back(std::to_string(value));
    }
    return values;
}

std::string last_part(const std::string& key) {
    return key.substr(key.rfind('.') + 1);
}

// What a folder may be called: everything but slashes, control characters and a leading dot.
std::string as_name(const std::string& text) {
    std::string name;
    for (const char c : text) {
        const bool plain =
            c != '/' && c != '%' && !std::iscntrl(static_cast<unsigned char>(c)) && !(c == '.' && name.empty());
        name += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
    return name;
}

std::vector<std::string> short_keys(const std::vector<std::string>& all) {
    std::vector<std::string> keys;
    for (const std::string& key : all) {
        const auto ends_alike = [&](const std::string& other) { return last_part(other) == last_part(key); };
        keys.push_back(std::count_if(all.begin(), all.end(), ends_alike) == 1 ? last_part(key) : key);
    }
    return keys;
}

/// The values of one key.
std::vector<std::string> values_of(const std::string& text, const std::string& values) {
    const std::vector<std::string> by_colons = split(values, ":"), by_dots = split(values, "..");
    if (by_colons.size() == 3) return evenly(text, by_colons);
    if (by_dots.size() == 2 && values.find(',') == std::string::npos) return one_by_one(text, by_dots);
    return split(values, ",");
}

/// Splits the values of several keys: 3:4,5:6
std::vector<std::vector<std::string>> values_together(const std::string& text, const std::string& values,
                                                      std::size_t keys) {
    std::vector<std::vector<std::string>> all;
    for (const std::string& together : split(values, ",")) {
        all.push_back(split(together, ":"));
        if (all.back().size() == keys) continue;
        refuse(text, fmt::format("{} keys take {} values with ':' between them, not {}", keys, keys, together));
    }
    return all;
}

}  // namespace

Variation parse_variation(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        refuse(text, "KEY=VALUES is expected: 0.1:0.9:9, 1..10 or a,b,c");
    }
    Variation variation{split(text.substr(0, equals), ","), {}};
    const std::string values = text.substr(equals + 1);
    if (variation.keys.size() > 1) {
        variation.values = values_together(text, values, variation.keys.size());
    } else {
        for (std::string& value : values_of(text, values)) variation.values.push_back({std::move(value)});
    }
    const auto is_empty = [](const std::string& value) { return value.empty(); };
    if (std::any_of(variation.keys.begin(), variation.keys.end(), is_empty)) refuse(text, "a key is empty");
    std::set<std::vector<std::string>> seen;  // two of the same would be two runs in one folder
    for (const std::vector<std::string>& value : variation.values) {
        if (std::any_of(value.begin(), value.end(), is_empty)) refuse(text, "a value is empty");
        if (!seen.insert(value).second) {
            refuse(text, fmt::format("the value {} is there twice", fmt::join(value, ":")));
        }
    }
    return variation;
}

std::vector<Variant> combine(const std::vector<Variation>& variations) {
    double count = 1;
    std::vector<std::string> all;
    for (const Variation& variation : variations) {
        count *= static_cast<double>(variation.values.size());
        for (const std::string& key : variation.keys) {
            if (std::find(all.begin(), all.end(), key) != all.end()) refuse(key, "this key is varied twice");
            all.push_back(key);
        }
    }
    if (count > most) throw UserError(fmt::format("a sweep of {:.0f} runs is more than a million", count));
    const std::vector<std::string> names = short_keys(all);
    std::vector<Variant> variants(1);
    for (const Variation& variation : variations) {
        std::vector<Variant> longer;
        for (const Variant& variant : variants) {
            for (const std::vector<std::string>& values : variation.values) {
                Variant& next = longer.emplace_back(variant);
                for (std::size_t k = 0; k < values.size(); ++k) {
                    next.name += next.values.empty() ? "" : ",";
                    next.name += as_name(names[next.values.size()] + "=" + values[k]);
                    next.values.emplace_back(variation.keys[k], values[k]);
                }
            }
        }
        variants = std::move(longer);
    }
    return variants;
}

}  // namespace espalier::simulation
