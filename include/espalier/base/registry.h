// Parts that register themselves: a file in an open folder defines a `Registered` object and is found.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace espalier {

/// All parts of a kind, by name. The map is sorted, so nothing depends on link order.
template <class Kind>
const std::map<std::string, const Kind*>& registered();

/// Defining a constant of this type registers a part. A kind is a struct with the part's `name`, what `espalier list`
/// prints of it, and the function that makes it or acts for it:
///   const Registered<ProcessType> entry{{"height", "height above the ground", "ground (m, 0): ...",
///   construct<Height>}};
template <class Kind>
class Registered : public Kind {
public:
    explicit Registered(Kind part) : Kind(std::move(part)) { all()[this->name] = this; }
    Registered(const Registered&) = delete;
    Registered& operator=(const Registered&) = delete;

private:
    static std::map<std::string, const Kind*>& all() {
        static std::map<std::string, const Kind*> parts;
        return parts;
    }
    friend const std::map<std::string, const Kind*>& registered<Kind>();
};

template <class Kind>
const std::map<std::string, const Kind*>& registered() {
    return Registered<Kind>::all();
}

/// Makes a `Part` from whatever its kind hands to constructors.
template <class Part>
constexpr auto construct = []<class... Arguments>(Arguments&&... arguments) {
    return std::make_unique<Part>(std::forward<Arguments>(arguments)...);
};

}  // namespace espalier
