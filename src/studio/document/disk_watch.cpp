#include "studio/document/disk_watch.h"

#include "espalier/base/error.h"
#include "espalier/base/read_log.h"

#include "studio/document/document_files.h"

#include <optional>
#include <string>
#include <system_error>

namespace espalier::studio {

namespace fs = std::filesystem;

void DiskWatch::accept(const fs::path& file) {
    if (const std::optional<std::string> text = text_on_disk(file)) know(file, digest(*text));
}

std::vector<fs::path> DiskWatch::changed() {
    std::vector<fs::path> changed;
    for (auto& [file, known] : known_) {
        if (look(file, known)) changed.push_back(file);
    }
    return changed;
}

bool DiskWatch::look(const fs::path& file, Known& known) {
    std::error_code error;
    Stamp stamp{fs::last_write_time(file, error), 0};
    if (!error) stamp.size = fs::file_size(file, error);
    if (error) return false;
    if (stamp == known.stamp) return known.differs;
    try {
        const std::optional<std::string> text = text_on_disk(file);
        if (!text) return false;
        known.differs = digest(*text) != known.digest;
        known.stamp = stamp;
    } catch (const UserError&) {
        return false;  // it cannot be read at the moment
    }
    return known.differs;
}

}  // namespace espalier::studio
