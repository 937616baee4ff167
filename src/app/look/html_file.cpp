#include "html_file.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "base/folder.h"

#include <fmt/format.h>

namespace espalier::app {

void write_html(const std::filesystem::path& output, const std::string& page) {
    if (output.extension() != ".html") {
        throw UserError(fmt::format("--output {}: expected the name of a .html file", output.string()));
    }
    if (output.has_parent_path()) make_folder(output.parent_path());
    write_text(output, page);
}

}  // namespace espalier::app
