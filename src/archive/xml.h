// A whole XML document as a tree. Text after the last element is refused, because that is how a .pvd looks while a run
// is writing its new end over the old one.
#pragma once

#include <functional>
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
    std::string name;
    std::map<std::string, std::string, std::less<>> attributes;
    std::string_view text;  ///< the first that is not blank, as it stands in the document
    std::vector<XmlElement> children;

    /// "" if there is none.
    const std::string& attribute(std::string_view key) const;
    /// The first of that name; null if there is none.
    const XmlElement* child(std::string_view child_name) const;
};

/// The document's outermost element, with views of `document`: arrays of a run may be large. Throws XmlError saying
/// what is wrong, and where.
XmlElement parse_xml(std::string_view document);

}  // namespace espalier::archive
