#include "studio/server/access.h"

#include <fmt/format.h>

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

bool is_own_host(std::string_view host, int port) {
    return host == fmt::format("127.0.0.1:{}", port) || host == fmt::format("localhost:{}", port);
}

bool is_own_origin(std::string_view origin, std::string_view host) {
    constexpr std::string_view scheme = "http://";
    return origin.starts_with(scheme) && origin.substr(scheme.size()) == host;
}

}  // namespace espalier::studio
