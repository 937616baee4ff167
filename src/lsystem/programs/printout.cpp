#include "espalier/lsystem/printout.h"

#include "base/text.h"

#include <cstdio>

namespace espalier::lsystem {

Printout::Printout() : Printout([](const std::string& text) { std::fputs(text.c_str(), stderr); }) {}

void Printout::print(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (is_full_) return;
    const std::string shown = escaped(text);
    printed_ += shown.size();
    is_full_ = printed_ > most;
    show_(is_full_ ? "\nThe models have printed 1 MiB; what they print from here on is left out.\n" : shown);
}

void Printout::say(const std::string& text) {
    const std::lock_guard lock(mutex_);
    show_(text);
}

}  // namespace espalier::lsystem
