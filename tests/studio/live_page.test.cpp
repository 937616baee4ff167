// A growth as one page that grows it again.
#include "studio/server/live_page.h"

#include "espalier/base/error.h"

#include "catch.h"
#include "page_letters.h"

#include <nlohmann/json.hpp>

#include <array>
#include <zlib.h>

namespace espalier::studio {
namespace {

std::string unzipped(const std::string& bytes) {
    z_stream stream{};
    REQUIRE(inflateInit2(&stream, 31) == Z_OK);
    std::array<char, 4096> out;
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = out.size();
    REQUIRE(inflate(&stream, Z_FINISH) == Z_STREAM_END);
    inflateEnd(&stream);
    return {out.data(), stream.total_out};
}

std::string between(const std::string& text, const std::string& before, const std::string& after) {
    const std::size_t begin = text.find(before) + before.size();
    return text.substr(begin, text.find(after, begin) - begin);
}

}  // namespace

TEST_CASE("a page that grows has the files by their places in the folder they share", "[studio][share]") {
    LiveGrowth growth;
    growth.files = {{"/home/a/garden/scenes/one.toml", "[[plant]]"}, {"/home/a/garden/models/x/tree.l", "lsystem: 1"}};
    growth.opened = "/home/a/garden/scenes/one.toml";
    growth.seed = 7;
    growth.title = "A <b> & \"c\"";
    const std::string page = live_page(growth);
    CHECK(page.find(R"(data-open="/library/scenes/one.toml" data-seed="7" )") != page.npos);
    CHECK(page.find("<title>A &lt;b> &amp; &quot;c&quot;</title>") != page.npos);
    CHECK(page.find("/home/a") == page.npos);

    const std::string pack = unzipped(from_letters(between(page, "id=\"part-library.pack\">", "<")));
    const std::size_t end = pack.find('\n');
    const auto names = nlohmann::json::parse(pack.substr(0, end));
    CHECK(names == nlohmann::json::parse(R"([["models/x/tree.l", 10], ["scenes/one.toml", 9]])"));
    CHECK(pack.substr(end + 1) == "lsystem: 1[[plant]]");
}

TEST_CASE("a page that grows loads nothing, and no text of a growth is a script of it", "[studio][share]") {
    LiveGrowth growth;
    growth.files = {{"/garden/tree.l", "</script><script>alert(1)</script>"}};
    growth.opened = "/garden/tree.l";
    growth.title = "</title><script>alert(2)</script>";
    const std::string page = live_page(growth);
    CHECK(page.find("<script>alert") == page.npos);
    CHECK(page.find("default-src 'none'") != page.npos);
}

TEST_CASE("files without a folder in common are refused with what to do", "[studio][share]") {
    LiveGrowth growth;
    growth.files = {{"/a/one.toml", ""}, {"/b/tree.l", ""}};
    growth.opened = "/a/one.toml";
    CHECK_THROWS_WITH(live_page(growth), Catch::Contains("/a/one.toml") && Catch::Contains("beside each other"));
}

}  // namespace espalier::studio
