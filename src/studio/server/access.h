// Who may talk to the studio: pages that came from it and know its token.
#pragma once

#include <string>
#include <string_view>

namespace espalier::studio {

/// 128 random bits in hexadecimal.
std::string new_token();

/// Compares in a time that does not tell how much of it is right.
bool is_token(std::string_view given, std::string_view token);

/// True for this machine under its own names and the port that the studio listens on. A name that another owner's
/// server gave to this machine is none of them (DNS rebinding), nor is another port, which another program may listen
/// on.
bool is_own_host(std::string_view host, int port);

/// True for an Origin that is a page of this host, which is one of the studio's own.
bool is_own_origin(std::string_view origin, std::string_view host);

}  // namespace espalier::studio
