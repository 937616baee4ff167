#include "timeline/collection_file.h"

#include "espalier/base/file.h"
#include "espalier/base/text.h"

#include <fmt/format.h>

namespace espalier {
namespace {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

}  // namespace

void CollectionFile::add(double time, int part, const std::string& name, const std::string& file) {
    entries_ += fmt::format("    <DataSet timestep=\"{}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
                            format_exact(time), part, escaped(name), escaped(file));
}

void CollectionFile::write() const {
    write_text(path_, fmt::format("<?xml version=\"1.0\"?>\n"
                                  "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
                                  "  <Collection>\n{}  </Collection>\n</VTKFile>\n",
                                  entries_));
}

}  // namespace espalier
