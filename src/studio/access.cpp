#include "studio/access.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <random>

namespace espalier::studio {

std::string new_token() {
    std::random_device random;
    std::string token;
    for (int word = 0; word < 4; ++word) token += fmt::format("{:08x}", static_cast<std::uint32_t>(random()));
    return token;
}

bool is_token(std::string_view given, std::string_view token) {
    if (given.size() != token.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < token.size(); ++i) {
        difference |= static_cast<unsigned char>(given[i]) ^ static_cast<unsigned char>(token[i]);
    }
    return difference == 0;
}

bool is_own_host(std::string_view host) {
    const std::size_t colon = host.rfind(':');
    const std::string_view port = colon == std::string_view::npos ? "" : host.substr(colon + 1);
    const bool is_port =
        !port.empty() && std::all_of(port.begin(), port.end(), [](char c) { return c >= '0' && c <= '9'; });
    const std::string_view name = is_port ? host.substr(0, colon) : host;
    constexpr std::array<std::string_view, 3> own{"127.0.0.1", "localhost", "[::1]"};
    return std::find(own.begin(), own.end(), name) != own.end();
}

bool is_own_origin(std::string_view origin, std::string_view host) {
    constexpr std::string_view scheme = "http://";
    return is_own_host(host) && origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
}

}  // namespace espalier::studio
