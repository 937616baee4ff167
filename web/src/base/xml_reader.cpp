// XML 1.0 in UTF-8, read without expat.
#include "base/xml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <vector>

/// A text that is read from its beginning to its end.
struct XML_ParserStruct {
    std::string text = {};
    std::size_t at = 0;
    std::size_t event = 0;  ///< where what is told begins

    bool ends() const { return at >= text.size(); }
    char next() const { return ends() ? '\0' : text[at]; }
    bool skip(std::string_view word) {
        if (text.compare(at, word.size(), word) != 0) return false;
        at += word.size();
        return true;
    }
};

namespace espalier {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_of_name(char c) {
    return !is_space(c) && std::strchr("<>/=\"'&?!", c) == nullptr;
}

}  // namespace

bool XmlAttributes::has(const char* name) const {
    for (const char* const* at = first_; *at; at += 2) {
        if (std::strcmp(name, *at) == 0) return true;
    }
    return false;
}

std::string XmlAttributes::value(const char* name) const {
    for (const char* const* at = first_; *at; at += 2) {
        if (std::strcmp(name, *at) == 0) return at[1];
    }
    return "";
}

/// The grammar, a rule a function.
struct XmlReader::Events {
    XmlReader& reader;
    XML_ParserStruct& in = *reader.parser_;
    std::vector<std::string> open = {};
    bool has_root = false;

    void document() {
        in.skip("\xEF\xBB\xBF");
        while (!in.ends()) {
            in.event = in.at;
            if (in.next() == '<') {
                markup();
            } else {
                characters();
            }
        }
        if (!open.empty()) reader.fail("no element found");
        if (!has_root) reader.fail("no element found");
    }

    void markup() {
        if (in.skip("<!--")) return skip_to("-->");
        if (in.skip("<![CDATA[")) return cdata();
        if (in.skip("<?")) return skip_to("?>");
        if (in.skip("<!DOCTYPE")) return document_type();
        if (in.skip("</")) return end_tag();
        ++in.at;
        tag();
    }

    void skip_to(std::string_view end) {
        const std::size_t found = in.text.find(end, in.at);
        if (found == std::string::npos) reader.fail("unclosed token");
        in.at = found + end.size();
    }

    void cdata() {
        const std::size_t first = in.at;
        skip_to("]]>");
        if (open.empty()) reader.fail("not well-formed (invalid token)");
        reader.text_.append(in.text, first, in.at - 3 - first);
    }

    void document_type() {
        const std::size_t end = in.text.find_first_of("[>", in.at);
        if (end == std::string::npos) reader.fail("unclosed token");
        if (in.text[end] == '[') reader.fail("entities are not read here");
        in.at = end + 1;
    }

    void characters() {
        std::string text;
        while (!in.ends() && in.next() != '<') {
            if (open.empty() && !is_space(in.next())) {
                reader.fail(has_root ? "junk after document element" : "syntax error");
            }
            character(text);
        }
        if (!open.empty()) reader.text_ += text;
    }

    /// One, or what stands for one. Lines end with a line feed.
    void character(std::string& text) {
        if (in.next() == '&') return reference(text);
        if (in.next() == '\0') reader.fail("not well-formed (invalid token)");
        if (in.skip("\r")) {
            in.skip("\n");
            text += '\n';
        } else {
            text += in.text[in.at++];
        }
    }

    void reference(std::string& text) {
        constexpr std::pair<std::string_view, char> known[] = {
            {"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}, {"&apos;", '\''}, {"&quot;", '"'}};
        for (const auto& [word, character] : known) {
            if (in.skip(word)) {
                text += character;
                return;
            }
        }
        if (!in.skip("&#")) reader.fail("undefined entity");
        const bool is_hexadecimal = in.skip("x");
        std::uint32_t code = 0;
        for (; in.next() != ';'; ++in.at) {
            const char c = in.next();
            const int digit = c >= '0' && c <= '9'   ? c - '0'
                              : c >= 'a' && c <= 'f' ? c - 'a' + 10
                              : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                                     : 16;
            if (digit >= (is_hexadecimal ? 16 : 10)) reader.fail("not well-formed (invalid token)");
            code = code * (is_hexadecimal ? 16 : 10) + static_cast<std::uint32_t>(digit);
            if (code > 0x10FFFF) reader.fail("reference to invalid character number");
        }
        ++in.at;
        if (code == 0) reader.fail("reference to invalid character number");
        append_utf8(text, code);
    }

    static void append_utf8(std::string& text, std::uint32_t code) {
        const auto put = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
        if (code < 0x80) return put(code);
        if (code < 0x800) {
            put(0xC0 | code >> 6);
        } else if (code < 0x10000) {
            put(0xE0 | code >> 12);
            put(0x80 | (code >> 6 & 0x3F));
        } else {
            put(0xF0 | code >> 18);
            put(0x80 | (code >> 12 & 0x3F));
            put(0x80 | (code >> 6 & 0x3F));
        }
        put(0x80 | (code & 0x3F));
    }

    std::string name() {
        const std::size_t first = in.at;
        while (!in.ends() && is_of_name(in.next())) ++in.at;
        if (in.at == first) reader.fail("not well-formed (invalid token)");
        return in.text.substr(first, in.at - first);
    }

    void spaces() {
        while (is_space(in.next())) ++in.at;
    }

    void require(std::string_view word) {
        if (!in.skip(word)) reader.fail(in.ends() ? "unclosed token" : "not well-formed (invalid token)");
    }

    void tag() {
        if (open.empty() && has_root) reader.fail("junk after document element");
        has_root = true;
        const std::string element = name();
        std::vector<std::string> words;
        for (spaces(); in.next() != '>' && in.next() != '/'; spaces()) {
            if (!is_space(in.text[in.at - 1])) reader.fail("not well-formed (invalid token)");
            attribute(words);
        }
        const bool is_empty = in.skip("/");
        require(">");
        begin(element, words);
        if (is_empty) {
            end(element);
        } else {
            open.push_back(element);
        }
    }

    void attribute(std::vector<std::string>& words) {
        const std::string attribute = name();
        for (std::size_t i = 0; i < words.size(); i += 2) {
            if (words[i] == attribute) reader.fail("duplicate attribute");
        }
        spaces();
        require("=");
        spaces();
        const char quote = in.next();
        if (quote != '"' && quote != '\'') reader.fail("not well-formed (invalid token)");
        ++in.at;
        std::string value;
        while (in.next() != quote) {
            if (in.ends() || in.next() == '<') reader.fail("not well-formed (invalid token)");
            if (is_space(in.next())) {
                value += ' ';
                if (!in.skip("\r\n")) ++in.at;
            } else {
                character(value);
            }
        }
        ++in.at;
        words.push_back(attribute);
        words.push_back(value);
    }

    void end_tag() {
        const std::string element = name();
        spaces();
        require(">");
        if (open.empty() || open.back() != element) reader.fail("mismatched tag");
        open.pop_back();
        end(element);
    }

    void begin(const std::string& element, const std::vector<std::string>& words) {
        if (++reader.depth_ > reader.most_depth_) {
            reader.fail(fmt::format("elements are nested deeper than {}", reader.most_depth_));
        }
        std::vector<const char*> attributes;
        for (const std::string& word : words) attributes.push_back(word.c_str());
        attributes.push_back(nullptr);
        reader.begin(element, XmlAttributes(attributes.data()));
        reader.text_.clear();
    }

    void end(const std::string& element) {
        --reader.depth_;
        reader.end(element);
        reader.text_.clear();
    }
};

XmlReader::XmlReader(std::string name, int most_depth)
    : name_(std::move(name)),
      parser_(new XML_ParserStruct, [](XML_ParserStruct* parser) { delete parser; }),
      most_depth_(most_depth) {}

XmlReader::~XmlReader() = default;

void XmlReader::parse(std::string text) {
    parser_->text = std::move(text);
    Events{*this}.document();
}

// The text is copied: pages read small files.
void XmlReader::parse_in_place(std::string_view text) {
    parse(std::string(text));
}

std::size_t XmlReader::tag_begin() const {
    return parser_->event;
}

std::size_t XmlReader::tag_end() const {
    return parser_->at;
}

Place XmlReader::here() const {
    const std::string_view before = std::string_view(parser_->text).substr(0, parser_->event);
    const auto line = std::count(before.begin(), before.end(), '\n');
    const std::size_t last = before.rfind('\n');
    const std::size_t begin = last == std::string_view::npos ? 0 : last + 1;
    return {name_, static_cast<int>(line) + 1, static_cast<int>(before.size() - begin) + 1};
}

void XmlReader::fail(const std::string& message) const {
    throw UserError(here(), message);
}

}  // namespace espalier
