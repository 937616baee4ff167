// XML as events, read with expat.
#pragma once

#include "espalier/base/error.h"

#include <exception>
#include <memory>
#include <string>
#include <string_view>

struct XML_ParserStruct;

namespace espalier {

/// The attributes of one element.
class XmlAttributes {
public:
    explicit XmlAttributes(const char* const* names_and_values) : first_(names_and_values) {}

    bool has(const char* name) const;
    /// "" if there is none.
    std::string value(const char* name) const;
    /// Calls what it is given with each name and its value, as texts that end with the element.
    template <class Visit>
    void each(Visit visit) const {
        for (const char* const* at = first_; *at; at += 2) visit(std::string_view(at[0]), std::string_view(at[1]));
    }

private:
    const char* const* first_;  // of expat: names and values in turn, then null
};

/// Reads a document element by element. Entities are refused, and elements nested deeper than a number.
class XmlReader {
public:
    XmlReader(const XmlReader&) = delete;
    XmlReader& operator=(const XmlReader&) = delete;

protected:
    /// `name` stands in messages.
    explicit XmlReader(std::string name, int most_depth = 200);
    virtual ~XmlReader();

    /// Calls begin() and end() for each element in turn. Throws UserError with the place of a mistake, and what they
    /// throw.
    void parse(std::string text);

    /// The same of a text that stays where it is: text() is empty, and what stands between tags is found by their
    /// places.
    void parse_in_place(std::string_view text);
    /// Where in the text the tag is that begin() or end() is called for.
    std::size_t tag_begin() const;
    std::size_t tag_end() const;

    virtual void begin(const std::string& element, const XmlAttributes& attributes) = 0;
    virtual void end(const std::string& element) = 0;

    /// Where the reader is.
    Place here() const;
    [[noreturn]] void fail(const std::string& message) const;
    /// The characters since the last begin() or end().
    const std::string& text() const { return text_; }

private:
    struct Events;

    void require(bool is_read) const;

    std::string name_, text_;
    std::unique_ptr<XML_ParserStruct, void (*)(XML_ParserStruct*)> parser_;
    std::exception_ptr mistake_;
    int depth_ = 0, most_depth_;
};

}  // namespace espalier
