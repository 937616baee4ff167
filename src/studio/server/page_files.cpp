#include "studio/server/page_files.h"

// What systems call the section of constants, how it ends, and what they put before the names of C.
#if defined(__APPLE__)
#define ESPALIER_CONSTANTS ".section __TEXT,__const\n"
#define ESPALIER_CONSTANTS_END ".previous\n"
#elif defined(_WIN32)
#define ESPALIER_CONSTANTS ".section .rdata,\"dr\"\n"
#define ESPALIER_CONSTANTS_END ".text\n"
#else
#define ESPALIER_CONSTANTS ".section .rodata\n"
#define ESPALIER_CONSTANTS_END ".previous\n"
#endif
#define ESPALIER_TEXT_OF(name) #name
#define ESPALIER_TEXT(name) ESPALIER_TEXT_OF(name)
#define ESPALIER_PREFIX ESPALIER_TEXT(__USER_LABEL_PREFIX__)

// The assembler reads the files: a compiler would take seconds for as many characters.
#define ESPALIER_PAGE_FILE(name, file)                                                        \
    asm(ESPALIER_CONSTANTS ESPALIER_PREFIX #name "_begin:\n.incbin \"" ESPALIER_PAGE "/" file \
                                                 "\"\n" ESPALIER_PREFIX #name                 \
                                                 "_end:\n.byte 0\n" ESPALIER_CONSTANTS_END);  \
    extern "C" {                                                                              \
    extern const char name##_begin[] __attribute__((visibility("hidden")));                   \
    extern const char name##_end[] __attribute__((visibility("hidden")));                     \
    }

ESPALIER_PAGE_FILE(espalier_studio_html, "index.html")
ESPALIER_PAGE_FILE(espalier_studio_js, "studio.js")
ESPALIER_PAGE_FILE(espalier_studio_css, "studio.css")
ESPALIER_PAGE_FILE(espalier_studio_icon, "icon.svg")
ESPALIER_PAGE_FILE(espalier_studio_licences, "LICENSES.txt")
ESPALIER_PAGE_FILE(espalier_studio_live, "live.html")

namespace espalier::studio {
namespace {

std::string_view between(const char* begin, const char* end) {
    return {begin, static_cast<std::size_t>(end - begin)};
}

}  // namespace

std::optional<PageFile> page_file(std::string_view address) {
    if (address == "/")
        return PageFile{"text/html; charset=utf-8", between(espalier_studio_html_begin, espalier_studio_html_end)};
    if (address == "/studio.js")
        return PageFile{"text/javascript; charset=utf-8", between(espalier_studio_js_begin, espalier_studio_js_end)};
    if (address == "/studio.css")
        return PageFile{"text/css; charset=utf-8", between(espalier_studio_css_begin, espalier_studio_css_end)};
    if (address == "/icon.svg")
        return PageFile{"image/svg+xml", between(espalier_studio_icon_begin, espalier_studio_icon_end)};
    if (address == "/LICENSES.txt") {
        return PageFile{"text/plain; charset=utf-8",
                        between(espalier_studio_licences_begin, espalier_studio_licences_end)};
    }
    return std::nullopt;
}

std::string_view live_page_file() {
    return between(espalier_studio_live_begin, espalier_studio_live_end);
}

}  // namespace espalier::studio
