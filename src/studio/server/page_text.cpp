#include "studio/server/page_text.h"

#include "espalier/base/error.h"

#include <zlib.h>

namespace espalier::studio {
namespace {

std::string with_all(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// `window`: zlib's bits of the window, which say the header too.
std::string compressed(const std::string& bytes, int window) {
    z_stream stream{};
    constexpr int memory = 8;
    if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, window, memory, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw RunError("the page cannot be compressed: there is no memory left");
    }
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    const int end = deflate(&stream, Z_FINISH);
    deflateEnd(&stream);
    if (end != Z_STREAM_END) throw RunError("this is too large for a page");
    out.resize(stream.total_out);
    return out;
}

}  // namespace

std::string in_html(std::string text) {
    for (const auto& [letter, name] : {std::pair{"&", "&amp;"}, {"<", "&lt;"}, {"\"", "&quot;"}}) {
        text = with_all(std::move(text), letter, name);
    }
    return text;
}

std::string in_script(std::string_view text, std::string_view less) {
    const std::string escape(less);
    return with_all(with_all(std::string(text), "</", escape + "/"), "<!--", escape + "!--");
}

std::string deflated(const std::string& bytes) {
    return compressed(bytes, -15);
}

std::string gzipped(const std::string& bytes) {
    return compressed(bytes, 31);
}

}  // namespace espalier::studio
