#include "studio/lesson/marked_text.h"

#include "espalier/base/file.h"

#include "base/base64.h"
#include "base/folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmark.h>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <system_error>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t largest_picture = 1 << 20;

using Node = std::unique_ptr<cmark_node, decltype(&cmark_node_free)>;
using Iterator = std::unique_ptr<cmark_iter, decltype(&cmark_iter_free)>;

const char* type_of_picture(std::string_view bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return nullptr;
}

std::string embedded(const std::string& url, const fs::path& folder, const Place& place) {
    std::error_code unknown;
    const fs::path file = resolved_below(folder / fs::path(url), folder, unknown);
    if (file.empty()) {
        throw UserError(place, fmt::format("the picture '{}' does not lie beside the lesson or below", url));
    }
    const std::string bytes = read_text(file);
    const char* const type = type_of_picture(bytes);
    if (!type) throw UserError(place, fmt::format("the picture '{}' is neither PNG nor JPEG", url));
    if (bytes.size() > largest_picture) {
        throw UserError(place, fmt::format("the picture '{}' has {:.1f} MB: make it smaller than 1 MB", url,
                                           static_cast<double>(bytes.size()) / 1e6));
    }
    return fmt::format("data:{};base64,{}", type, base64(bytes));
}

/// cmark knows lines of blocks.
int line_of(cmark_node* node) {
    for (; node; node = cmark_node_parent(node)) {
        if (const int line = cmark_node_get_start_line(node)) return line;
    }
    return 1;
}

}  // namespace

MarkedText html_of_markdown(const std::string& text, const fs::path& folder, const std::string& name, int first_line) {
    MarkedText marked;
    const Node document(cmark_parse_document(text.data(), text.size(), CMARK_OPT_VALIDATE_UTF8), cmark_node_free);
    const Iterator each(cmark_iter_new(document.get()), cmark_iter_free);
    for (cmark_event_type event; (event = cmark_iter_next(each.get())) != CMARK_EVENT_DONE;) {
        if (event != CMARK_EVENT_ENTER) continue;
        cmark_node* const node = cmark_iter_get_node(each.get());
        const Place place{name, first_line + line_of(node) - 1, 0};
        const cmark_node_type type = cmark_node_get_type(node);
        if (type == CMARK_NODE_IMAGE) {
            cmark_node_set_url(node, embedded(cmark_node_get_url(node), folder, place).c_str());
        } else if (type == CMARK_NODE_HEADING) {
            cmark_node_set_heading_level(node,
                                         std::min(6, cmark_node_get_heading_level(node) + 1));  // the page has one
        } else if (type == CMARK_NODE_HTML_BLOCK || type == CMARK_NODE_HTML_INLINE) {
            marked.warnings.push_back(
                {Diagnostic::Severity::warning, place, "HTML is left out: a lesson is Markdown alone"});
        }
    }
    const std::unique_ptr<char, decltype(&std::free)> html(cmark_render_html(document.get(), CMARK_OPT_DEFAULT),
                                                           &std::free);
    marked.html = html.get();
    return marked;
}

}  // namespace espalier::studio
