#include "simulation/scene/variation.h"

#include "espalier/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
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

std::optional<double> number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
    throw UserError(fmt::format("--vary {}: {}", text, why));
}

// Twelve digits: 0.3 is written so, whatever the last bit of its sum was.
std::vector<std::string> evenly(const std::string& text, const std::vector<std::string>& parts) {
    const auto first = number(parts[0]), last = number(parts[1]), count = number(parts[2]);
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
    const auto first = number(parts[0]), last = number(parts[1]);
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

std::vector<std::string> short_keys(const std::vector<Variation>& variations) {
    std::vector<std::string> keys;
    for (const Variation& variation : variations) {
        const auto ends_alike = [&](const Variation& other) {
            return last_part(other.key) == last_part(variation.key);
        };
        const bool unique = std::count_if(variations.begin(), variations.end(), ends_alike) == 1;
        keys.push_back(unique ? last_part(variation.key) : variation.key);
    }
    return keys;
}

}  // namespace

Variation parse_variation(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
        refuse(text, "KEY=VALUES is expected: 0.1:0.9:9, 1..10 or a,b,c");
    }
    Variation variation{text.substr(0, equals), {}};
    const std::string values = text.substr(equals + 1);
    const std::vector<std::string> by_colons = split(values, ":"), by_dots = split(values, "..");
    if (by_colons.size() == 3) {
        variation.values = evenly(text, by_colons);
    } else if (by_dots.size() == 2 && values.find(',') == std::string::npos) {
        variation.values = one_by_one(text, by_dots);
    } else {
        variation.values = split(values, ",");
    }
    const auto is_empty = [](const std::string& value) { return value.empty(); };
    if (std::any_of(variation.values.begin(), variation.values.end(), is_empty)) refuse(text, "a value is empty");
    std::set<std::string> seen;  // two of the same would be two runs in one folder
    for (const std::string& value : variation.values) {
        if (!seen.insert(value).second) refuse(text, fmt::format("the value {} is there twice", value));
    }
    return variation;
}

std::vector<Variant> combine(const std::vector<Variation>& variations) {
    double count = 1;
    for (std::size_t i = 0; i < variations.size(); ++i) {
        count *= static_cast<double>(variations[i].values.size());
        for (std::size_t j = 0; j < i; ++j) {
            if (variations[i].key == variations[j].key) refuse(variations[i].key, "this key is varied twice");
        }
    }
    if (count > most) throw UserError(fmt::format("a sweep of {:.0f} runs is more than a million", count));
    const std::vector<std::string> keys = short_keys(variations);
    std::vector<Variant> variants(1);
    for (std::size_t k = 0; k < variations.size(); ++k) {
        std::vector<Variant> longer;
        for (const Variant& variant : variants) {
            for (const std::string& value : variations[k].values) {
                longer.push_back(variant);
                longer.back().values.emplace_back(variations[k].key, value);
                longer.back().name.append(k == 0 ? "" : ",").append(as_name(keys[k] + "=" + value));
            }
        }
        variants = std::move(longer);
    }
    return variants;
}

}  // namespace espalier::simulation
