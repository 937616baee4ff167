#include "archive/geometry_file.h"

#include "espalier/base/error.h"

namespace espalier::archive {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path) {
    throw UserError("a page reads no recorded runs: " + path.filename().string() +
                    " needs the program that is installed");
}

}  // namespace

FrameGeometry read_geometry(const std::filesystem::path& path) {
    refuse(path);
}

RecordedLives read_lives(const std::filesystem::path& path) {
    refuse(path);
}

RecordedBackground read_background(const std::filesystem::path& path) {
    refuse(path);
}

}  // namespace espalier::archive
