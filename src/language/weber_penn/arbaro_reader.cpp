// The XML of Arbaro: <arbaro><species name="..."><param name="1Length" value="0.3"/>...
#include "base/number.h"
#include "base/text.h"
#include "base/xml_reader.h"
#include "language/weber_penn/species_builder.h"

#include <fmt/format.h>

namespace espalier::language::weber_penn {
namespace {

/// Values that say nothing which a tree of one trunk that stands upright would not have.
bool says_nothing(const std::string& name, double value) {
    if (name == "0Branches") return value == 1;
    return value == 0;
}

class ArbaroReader final : public XmlReader {
public:
    ArbaroReader(const std::string& text, const std::string& file)
        : XmlReader(file), text_of_file_(text), builder_(text, file, "arbaro") {}

    Species read() {
        parse(text_of_file_);
        if (!is_arbaro_) fail("this is no file of Arbaro: its outermost element is not <arbaro>");
        if (species_ == 0) fail("this file has no <species>");
        return builder_.finished();
    }

private:
    void begin(const std::string& element, const XmlAttributes& attributes) override {
        if (element == "arbaro") is_arbaro_ = true;
        if (element == "species" && ++species_ > 1) fail("a second species: write each into a file of its own");
        if (element == "param" && species_ > 0) read(attributes.value("name"), attributes.value("value"));
    }
    void end(const std::string&) override {}

    void read(const std::string& name, const std::string& value) {
        const SpeciesBuilder::At at{here().line, here().column};
        const std::optional<double> number = name == "LeafShape" ? shape_of_leaf(value, at) : finite_number(value);
        if (!number) return builder_.mistake(at, fmt::format("'{}' is a number, not '{}'", name, value));
        const bool is_unread = name == "Smooth" || name == "0DownAngle" || name == "0DownAngleV" || name == "0Rotate" ||
                               name == "0RotateV" || name == "0Branches" || name == "0BranchDist";
        if (!is_unread) return builder_.set(name, *number, at, at);
        if (says_nothing(name, *number)) return;
        builder_.warn(at, name == "Smooth"
                              ? "'Smooth' is not read: it shades the facets of Arbaro's meshes"
                              : fmt::format("'{}' is not read: there is one trunk, and it stands upright", name));
    }

    /// Arbaro calls shapes by words, too. Each is a flat outline there; solids have none here.
    std::optional<double> shape_of_leaf(const std::string& value, SpeciesBuilder::At at) {
        if (value == "square" || value == "sphere") {
            builder_.warn(at, fmt::format("leaves of the shape '{}' are drawn as ovals", value));
            return 0;
        }
        if (value.starts_with("disc")) return 0;
        return finite_number(value);
    }

    std::string text_of_file_;
    SpeciesBuilder builder_;
    bool is_arbaro_ = false;
    int species_ = 0;
};

}  // namespace

Species parse_arbaro(const std::string& text, const std::string& name) {
    return ArbaroReader(text, name).read();
}

}  // namespace espalier::language::weber_penn
