#include "studio/server/live_page.h"

#include "espalier/base/error.h"

#include "studio/server/frame_texts.h"
#include "studio/server/page_files.h"
#include "studio/server/page_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace espalier::studio {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path common_folder(const std::map<fs::path, std::string>& files) {
    fs::path common = files.begin()->first.parent_path();
    for (const auto& [path, bytes] : files) {
        const auto end = std::mismatch(common.begin(), common.end(), path.begin(), path.end()).first;
        fs::path shorter;
        for (auto part = common.begin(); part != end; ++part) shorter /= *part;
        common = std::move(shorter);
    }
    if (common.has_relative_path()) return common;
    throw UserError(fmt::format("{} and {} have no folder in common: put copies of them beside each other",
                                files.begin()->first.string(), files.rbegin()->first.string()));
}

/// What studio/source/web/library-pack.ts unpacks.
std::string pack_of(const std::map<fs::path, std::string>& files, const fs::path& folder) {
    Json names = Json::array();
    std::string all;
    for (const auto& [path, bytes] : files) {
        names.push_back({path.lexically_relative(folder).generic_string(), bytes.size()});
        all += bytes;
    }
    return names.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n" + all;
}

/// Puts `is` where the page has a text that begins and ends so.
void replace(std::string& page, std::string_view begin, std::string_view end, const std::string& is) {
    const std::size_t at = page.find(begin);
    const std::size_t to = at == page.npos ? page.npos : page.find(end, at + begin.size());
    if (to == page.npos) throw RunError(fmt::format("the page that grows has no '{}': build it anew", begin));
    page.replace(at, to + end.size() - at, is);
}

}  // namespace

std::map<fs::path, std::string> kept_bytes(const std::map<fs::path, ReadLog::File>& files) {
    std::map<fs::path, std::string> bytes;
    for (const auto& [path, file] : files) {
        if (!file.kept)
            throw UserError(fmt::format("{}: a page has no room for more than 16 MB of files", path.string()));
        bytes[path] = file.bytes;
    }
    return bytes;
}

std::string live_page(const LiveGrowth& growth) {
    const fs::path folder = common_folder(growth.files);
    const std::string opened = "/library/" + growth.opened.lexically_relative(folder).generic_string();
    const std::string seed = growth.seed ? fmt::format(" data-seed=\"{}\"", *growth.seed) : "";
    const std::string steps = growth.steps ? fmt::format(" data-steps=\"{}\"", *growth.steps) : "";
    const std::string lesson = growth.lesson.empty()
                                   ? ""
                                   : fmt::format("<script type=\"application/json\" id=\"lesson\">{}</script>\n",
                                                 in_script(growth.lesson, "\\u003c"));
    std::string page(live_page_file());
    replace(page, "data-open=", " ", fmt::format("data-open=\"{}\"{}{} ", in_html(opened), seed, steps));
    replace(page, "<title>", "</title>", fmt::format("<title>{}</title>", in_html(growth.title)));
    replace(page, "id=\"part-library.pack\">", "</script>\n",
            fmt::format("id=\"part-library.pack\">{}</script>\n{}", in_letters(gzipped(pack_of(growth.files, folder))),
                        lesson));
    return page;
}

}  // namespace espalier::studio
