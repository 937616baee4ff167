// What went wrong in the user's words, whoever threw it.
#pragma once

#include <exception>
#include <string>

namespace espalier {

/// The message of an exception. The standard library's own of files and memory are told without its technical words:
/// "plants/x.vtp: Permission denied".
std::string reason_of(const std::exception& error);

}  // namespace espalier
