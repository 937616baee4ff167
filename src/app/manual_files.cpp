// The made pages of the manual on disk.
#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "manual_pages.h"

#include <fmt/format.h>

#include <vector>

namespace espalier::app {
namespace {

namespace fs = std::filesystem;

/// The pages of the manual that were made of parts.
std::vector<fs::path> made_before(const fs::path& manual) {
    std::vector<fs::path> made;
    if (!fs::is_directory(manual / "reference")) return made;
    for (const auto& entry : fs::recursive_directory_iterator(manual / "reference")) {
        if (entry.path().extension() != ".md" || !read_text(entry.path()).starts_with(made_by)) continue;
        made.push_back(entry.path().lexically_relative(manual));
    }
    return made;
}

}  // namespace

void write_manual(const ManualPages& pages, const fs::path& manual) {
    for (const fs::path& page : made_before(manual)) {
        if (!pages.contains(page)) fs::remove(manual / page);
    }
    for (const auto& [place, text] : pages) {
        fs::create_directories((manual / place).parent_path());
        write_text(manual / place, text);
    }
}

void check_manual(const ManualPages& pages, const fs::path& manual) {
    std::vector<Diagnostic> mistakes;
    const auto differs = [&](const fs::path& page, const char* what) {
        const std::string message =
            fmt::format("{}; write it anew: espalier list --markdown {}", what, manual.generic_string());
        mistakes.push_back({Diagnostic::Severity::error, {.file = (manual / page).generic_string()}, message, ""});
    };
    for (const fs::path& page : made_before(manual)) {
        if (!pages.contains(page)) differs(page, "the part that this page tells of is gone");
    }
    for (const auto& [place, text] : pages) {
        if (!fs::exists(manual / place)) {
            differs(place, "this page is missing");
        } else if (read_text(manual / place) != text) {
            differs(place, "this page is not what the parts say");
        }
    }
    if (!mistakes.empty()) throw UserError(std::move(mistakes));
}

}  // namespace espalier::app
