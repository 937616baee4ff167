#include "language/measured/notes.h"

#include <fmt/format.h>

namespace espalier::language::measured {

void Notes::unused(const std::string& what, const Place& place, std::size_t places) {
    note(what, place, true, places);
}

void Notes::warn(const std::string& sentence, const Place& place, std::size_t places) {
    note(sentence, place, false, places);
}

void Notes::note(const std::string& text, const Place& place, bool is_unused, std::size_t places) {
    constexpr std::size_t most_unused = 100;
    if (is_unused && unused_kinds_ == most_unused && !number_of_.contains(text)) {
        further_ += places;
        return;
    }
    const auto [found, is_new] = number_of_.try_emplace(text, kinds_.size());
    if (is_new && is_unused) ++unused_kinds_;
    if (is_new) kinds_.push_back({text, place.known() ? place : Place{file_, 0, 0}, 0, is_unused});
    kinds_[found->second].places += places;
}

std::vector<Diagnostic> Notes::warnings() const {
    std::vector<Diagnostic> warnings;
    for (const Kind& kind : kinds_) {
        Diagnostic& warning = warnings.emplace_back();
        warning.severity = Diagnostic::Severity::warning;
        warning.place = kind.first;
        warning.message = kind.text;
        if (kind.is_unused) {
            warning.message += kind.places == 1 ? " is not used" : fmt::format(" is not used ({} places)", kind.places);
        } else if (kind.places > 1) {
            warning.message += fmt::format(" ({} places)", kind.places);
        }
    }
    if (further_ > 0) {
        Diagnostic& warning = warnings.emplace_back();
        warning.severity = Diagnostic::Severity::warning;
        warning.place = Place{file_, 0, 0};
        warning.message = fmt::format("more is not used, in {} places", further_);
    }
    return warnings;
}

}  // namespace espalier::language::measured
