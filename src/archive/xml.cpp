#include "archive/xml.h"

#include "base/xml_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace espalier::archive {
namespace {

class Document : XmlReader {
public:
    explicit Document(std::string_view text) : XmlReader(""), text_(text) {}

    XmlElement root() {
        parse_in_place(text_);
        return std::move(above_.children.front());
    }

private:
    void begin(const std::string& name, const XmlAttributes& attributes) override {
        keep_text();
        XmlElement& element = open_.back()->children.emplace_back();
        element.name = name;
        attributes.each([&](std::string_view key, std::string_view value) { element.attributes.emplace(key, value); });
        open_.push_back(&element);
    }

    void end(const std::string&) override {
        keep_text();
        open_.pop_back();
    }

    /// Between the tag before and this one.
    void keep_text() {
        const std::string_view text = text_.substr(after_tag_, tag_begin() - after_tag_);
        std::string_view& kept = open_.back()->text;
        if (kept.empty() && text.find_first_not_of(" \t\r\n") != std::string_view::npos) kept = text;
        after_tag_ = tag_end();
    }

    std::string_view text_;
    std::size_t after_tag_ = 0;
    XmlElement above_;                        ///< has the root as its child
    std::vector<XmlElement*> open_{&above_};  ///< elements within elements
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
    try {
        return Document(document).root();
    } catch (const UserError& error) {
        const Diagnostic& what = error.diagnostics().front();
        throw XmlError(fmt::format("line {}: {}", what.place.line, what.message));
    }
}

}  // namespace espalier::archive
