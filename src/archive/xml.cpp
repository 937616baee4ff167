#include "archive/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace espalier::archive {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr int most_depth = 16;

std::string unescaped(std::string_view text) {
    static constexpr std::pair<std::string_view, char> entities[] = {
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
    std::string result;
    while (!text.empty()) {
        const auto* entity = std::find_if(std::begin(entities), std::end(entities),
                                          [&](const auto& known) { return text.starts_with(known.first); });
        const bool found = entity != std::end(entities);
        result += found ? entity->second : text.front();
        text.remove_prefix(found ? entity->first.size() : 1);
    }
    return result;
}

class Parser {
public:
    explicit Parser(std::string_view text) : text_(text) {}

    XmlElement document() {
        skip_prolog();
        XmlElement root = element(0);
        if (text_.find_first_not_of(blanks, at_) != std::string_view::npos) fail("text behind the last element");
        return root;
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
        throw XmlError(fmt::format("line {}: {}", lines + 1, what));
    }

    // Behind the next `end`, returning what stands before it.
    std::string_view until(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        if (found == std::string_view::npos) fail(fmt::format("'{}' is missing: the file is cut short", end));
        const std::string_view before = text_.substr(at_, found - at_);
        at_ = found + end.size();
        return before;
    }

    void skip_blanks() { at_ = std::min(text_.find_first_not_of(blanks, at_), text_.size()); }

    bool skip(std::string_view word) {
        if (!text_.substr(at_).starts_with(word)) return false;
        at_ += word.size();
        return true;
    }

    void skip_prolog() {
        for (;;) {
            skip_blanks();
            if (skip("<?")) {
                until("?>");
            } else if (skip("<!--")) {
                until("-->");
            } else {
                return;
            }
        }
    }

    std::string_view name() {
        const std::size_t end = std::min(text_.find_first_of(" \t\r\n=/>\"<", at_), text_.size());
        if (end == at_) fail("a name is expected");
        const std::size_t begin = std::exchange(at_, end);
        return text_.substr(begin, end - begin);
    }

    XmlElement element(int depth) {
        if (depth > most_depth) fail("elements within elements, too deep");
        if (!skip("<")) fail("an element is expected");
        XmlElement result;
        result.name = name();
        for (skip_blanks(); !skip("/>"); skip_blanks()) {
            if (skip(">")) {
                content(result, depth);
                break;
            }
            const std::string_view key = name();
            if (!skip("=\"")) fail("an attribute's value is expected");
            result.attributes[key] = unescaped(until("\""));
        }
        return result;
    }

    void content(XmlElement& parent, int depth) {
        for (;;) {
            const std::string_view text = until("<");
            if (parent.text.empty() && text.find_first_not_of(blanks) != std::string_view::npos) parent.text = text;
            if (skip("/")) break;
            if (skip("!--")) {
                until("-->");
                continue;
            }
            --at_;
            parent.children.push_back(element(depth + 1));
        }
        if (name() != parent.name) fail(fmt::format("the end of element '{}' is expected", parent.name));
        skip_blanks();
        if (!skip(">")) fail("'>' is expected");
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace

const std::string& XmlElement::attribute(std::string_view key) const {
    static const std::string none;
    const auto found = attributes.find(key);
    return found == attributes.end() ? none : found->second;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](const XmlElement& element) { return element.name == child_name; });
    return found == children.end() ? nullptr : &*found;
}

XmlElement parse_xml(std::string_view document) {
    return Parser(document).document();
}

}  // namespace espalier::archive
