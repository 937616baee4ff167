// Any bytes as a side file: the first byte chooses the reader, the rest is the file. Each must end in a result or in
// words, and what was read must bear being used.
#include "geometry/side_files/side_files.h"

#include "espalier/base/read_log.h"
#include "espalier/geometry/palette.h"
#include "espalier/turtle/background.h"
#include "espalier/turtle/view_file.h"

#include "archive/meshes/bark.h"
#include "language/side_files/side_files.h"
#include "simulation/object/animation_file.h"
#include "simulation/object/specifications.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

namespace {

using namespace espalier;
using namespace espalier::simulation;

constexpr std::size_t longest = 1 << 14;

void require(bool condition) {
    if (!condition) std::abort();
}

void use(const std::optional<Surface>& surface) {
    if (surface) mesh_of(*surface);
}

void read_view(std::string_view text) {
    const View view = read_view_text(text, "plant.v", {{"WIDTH", "2"}}, ESPALIER_SOURCE_DIR "/models/organs");
    require(view.resources != nullptr);
}

void read_surface(std::string_view text) {
    std::vector<Diagnostic> diagnostics;
    use(read_surface_text(text, "leaf.s", 2, diagnostics));
}

void read_triangles(std::string_view text) {
    std::vector<Diagnostic> diagnostics;
    use(read_triangles_text(text, "leaf.ray", 2, diagnostics));
}

void read_object_file(std::string_view text) {
    mesh_of(read_object_text(text, "fuzz.obj", 1));
}

void read_contour(std::string_view text) {
    std::vector<Diagnostic> diagnostics;
    read_contour_text(text, "stem.con", diagnostics);
}

void read_function(std::string_view text) {
    for (const int samples : {0, 10}) {
        const FunctionCurve function = read_function_text(text, "f.func", samples);
        for (const double x : {-1.0, 0.0, 0.3, 1.0, 2.0}) function(x);
    }
}

void read_functions(std::string_view text) {
    for (const NamedFunction& member : read_function_set_text(text, "all.fset")) member.function(0.5);
}

void read_curve(std::string_view text) {
    const SpaceCurve curve = read_curve_text(text, "path.con");
    for (const double t : {-1.0, 0.0, 0.3, 1.0, 2.0}) curve(t);
}

void read_scene(std::string_view text) {
    Background background;
    std::vector<Diagnostic> diagnostics;
    read_background_text(text, "room.bg", Material{}, background, diagnostics);
    for (const std::uint32_t vertex : background.triangles) require(vertex < background.vertices.size());
    for (const Background::Piece& piece : background.pieces) {
        require(std::size_t{piece.first} + piece.count <= background.triangles.size());
    }
}

/// Reads the text as a file, of which only the name is there: a disk would take more time than the reader.
template <class Read>
void read_as_file(std::string_view text, const Read& read) {
    const std::filesystem::path path = ESPALIER_SOURCE_DIR "/LICENSE";
    const ReadLog log(0, {{path, std::string(text)}});
    read(path);
}

void read_map(std::string_view text) {
    Palette palette;
    read_as_file(text, [&](const auto& path) { read_colour_map(path, 2, palette); });
    palette.material(600);
}

void read_material_file(std::string_view text) {
    Palette palette;
    read_as_file(text, [&](const auto& path) { read_materials(path, 1, palette); });
    palette.material(3);
}

// Nothing but this project's models is read from this machine's disk.
bool reaches_outside(std::string_view bytes) {
    for (std::size_t slash = bytes.find('/'); slash != bytes.npos; slash = bytes.find('/', slash + 1)) {
        const char next = slash + 1 < bytes.size() ? bytes[slash + 1] : '\0';
        if (next >= 'a' && next <= 'z') return true;
    }
    return bytes.find("..") != bytes.npos;
}

void read_animation(std::string_view text) {
    read_animation_text(std::string(text), "plant.a");
}

void read_menu(std::string_view text) {
    read_as_file(text, [](const auto& path) { read_specifications(path); });
}

// Pictures that it names are not read.
void read_bark_file(std::string_view text) {
    read_as_file(text, [](const auto& path) {
        const Bark bark = read_bark(path);
        if (bark.heights || bark.size > 64) return;
        const HeightMap map = archive::heights_of(bark);
        for (const float height : map.heights) require(height >= 0 && height <= 1);
        archive::normals_of(bark, map);
        archive::shades_of(bark, map);
    });
}

constexpr std::array readers{read_view,      read_surface, read_triangles,   read_contour,  read_function,
                             read_functions, read_curve,   read_scene,       read_map,      read_material_file,
                             read_animation, read_menu,    read_object_file, read_bark_file};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    if (size < 1 || size > longest || reaches_outside(bytes)) return 0;
    try {
        readers.at(data[0] % readers.size())(bytes.substr(1));
    } catch (const UserError&) {
    } catch (const RunError&) {
    }
    return 0;
}
