// Parts that register themselves: a file in an open folder defines one `Registered` object and is found.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace espalier {

/// What a part says of itself; `espalier list` prints it. `help` holds parameters with units and defaults.
struct PartDescription {
    std::string name;
    std::string summary;
    std::string help;
};

/// Every part of one kind by name. The map is sorted, so nothing depends on link order.
template <class Interface, class... Arguments>
class Registry {
public:
    using Factory = std::function<std::unique_ptr<Interface>(Arguments...)>;
    struct Entry {
        PartDescription description;
        Factory make;
    };

    static std::map<std::string, Entry>& entries() {
        static std::map<std::string, Entry> all;
        return all;
    }
};

}  // namespace espalier
