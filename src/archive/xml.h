// The part of XML that the timeline writes: elements, attributes and text; no entities but the five, no CDATA.
// A library such as pugixml accepts text behind the last element. This reader refuses it, because that is how a .pvd
// looks while a run is writing its new end over the old one.
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace espalier::archive {

struct XmlError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct XmlElement {
    std::string_view name;
    std::map<std::string_view, std::string> attributes;
    std::string_view text;  ///< the first that is not blank
    std::vector<XmlElement> children;

    /// "" if there is none.
    const std::string& attribute(std::string_view key) const;
    /// The first of that name; null if there is none.
    const XmlElement* child(std::string_view child_name) const;
};

/// The document's outermost element, with views of `document`. Throws XmlError saying what is wrong, and where.
XmlElement parse_xml(std::string_view document);

}  // namespace espalier::archive
