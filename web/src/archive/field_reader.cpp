#include "archive/field_reader.h"

#include "espalier/base/error.h"

namespace espalier::archive {

RecordedField read_field(const std::filesystem::path& path, const std::string&) {
    throw UserError("a page reads no recorded runs: " + path.filename().string() +
                    " needs the program that is installed");
}

}  // namespace espalier::archive
