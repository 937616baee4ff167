#include "base/xml_reader.h"

#include <climits>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <expat.h>
#include <limits>

namespace espalier {
namespace {

// Later versions of Expat have counters of 64 bits, and warn of those that earlier ones have alone.
template <class Parser>
int line_of(Parser parser) {
    if constexpr (requires { XML_GetCurrentLineNumber64(parser); }) {
        return static_cast<int>(XML_GetCurrentLineNumber64(parser));
    } else {
        return static_cast<int>(XML_GetCurrentLineNumber(parser));
    }
}
template <class Parser>
int column_of(Parser parser) {
    if constexpr (requires { XML_GetCurrentColumnNumber64(parser); }) {
        return static_cast<int>(XML_GetCurrentColumnNumber64(parser));
    } else {
        return static_cast<int>(XML_GetCurrentColumnNumber(parser));
    }
}
template <class Parser>
std::size_t begin_of(Parser parser) {
    if constexpr (requires { XML_GetCurrentByteIndex64(parser); }) {
        return static_cast<std::size_t>(XML_GetCurrentByteIndex64(parser));
    } else {
        return static_cast<std::size_t>(XML_GetCurrentByteIndex(parser));
    }
}
template <class Parser>
std::size_t length_of(Parser parser) {
    if constexpr (requires { XML_GetCurrentByteCount64(parser); }) {
        return static_cast<std::size_t>(XML_GetCurrentByteCount64(parser));
    } else {
        return static_cast<std::size_t>(XML_GetCurrentByteCount(parser));
    }
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

/// What expat calls. No exception passes through it.
struct XmlReader::Events {
    template <class Work>
    static void guarded(void* self, Work work) {
        auto& reader = *static_cast<XmlReader*>(self);
        if (reader.mistake_) return;
        try {
            work(reader);
        } catch (...) {
            reader.mistake_ = std::current_exception();
            XML_StopParser(reader.parser_.get(), XML_FALSE);
        }
    }
    static void begin(void* self, const char* element, const char** attributes) {
        guarded(self, [&](XmlReader& reader) {
            if (++reader.depth_ > reader.most_depth_) {
                reader.fail(fmt::format("elements are nested deeper than {}", reader.most_depth_));
            }
            reader.begin(element, XmlAttributes(attributes));
            reader.text_.clear();
        });
    }
    static void end(void* self, const char* element) {
        guarded(self, [&](XmlReader& reader) {
            --reader.depth_;
            reader.end(element);
            reader.text_.clear();
        });
    }
    static void characters(void* self, const char* text, int length) {
        guarded(self, [&](XmlReader& reader) { reader.text_.append(text, static_cast<std::size_t>(length)); });
    }
    static void entity(void* self, const char*, int, const char*, int, const char*, const char*, const char*,
                       const char*) {
        guarded(self, [](XmlReader& reader) { reader.fail("entities are not read here"); });
    }
};

XmlReader::XmlReader(std::string name, int most_depth)
    : name_(std::move(name)), parser_(XML_ParserCreate(nullptr), XML_ParserFree), most_depth_(most_depth) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), Events::begin, Events::end);
    XML_SetCharacterDataHandler(parser_.get(), Events::characters);
    XML_SetEntityDeclHandler(parser_.get(), Events::entity);
}

XmlReader::~XmlReader() = default;

void XmlReader::parse(std::string text) {
    if (text.size() > INT_MAX) fail("this file is too long");
    // Into expat's own memory, where it would copy the text in any case, so that only one of both remains.
    const auto length = static_cast<int>(text.size());
    void* const buffer = XML_GetBuffer(parser_.get(), std::max(length, 1));
    if (!buffer) fail("this file is too long");
    std::copy(text.begin(), text.end(), static_cast<char*>(buffer));
    std::string().swap(text);
    require(XML_ParseBuffer(parser_.get(), length, 1) == XML_STATUS_OK);
}

void XmlReader::parse_in_place(std::string_view text) {
    if (text.size() > static_cast<std::size_t>(std::numeric_limits<XML_Index>::max())) fail("this file is too long");
    XML_SetCharacterDataHandler(parser_.get(), nullptr);
    constexpr std::size_t at_once = std::size_t{1} << 20;  // expat copies what it has not come to the end of
    do {
        const std::string_view piece = text.substr(0, at_once);
        text.remove_prefix(piece.size());
        require(XML_Parse(parser_.get(), piece.data(), static_cast<int>(piece.size()), text.empty()) == XML_STATUS_OK);
    } while (!text.empty());
}

void XmlReader::require(bool is_read) const {
    if (mistake_) std::rethrow_exception(mistake_);
    if (!is_read) fail(XML_ErrorString(XML_GetErrorCode(parser_.get())));
}

std::size_t XmlReader::tag_begin() const {
    return begin_of(parser_.get());
}

std::size_t XmlReader::tag_end() const {
    return tag_begin() + length_of(parser_.get());
}

Place XmlReader::here() const {
    return {name_, line_of(parser_.get()), column_of(parser_.get()) + 1};
}

void XmlReader::fail(const std::string& message) const {
    throw UserError(here(), message);
}

}  // namespace espalier
