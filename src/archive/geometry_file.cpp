#include "archive/geometry_file.h"

#include "archive/vtk_xml.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace espalier::archive {
namespace {

constexpr std::string_view known_arrays[] = {"radius", "pixels", "Normals", "TCoords", "identity", "organ", "parent",
                                             "plant",  "symbol", "birth",   "order",   "colour",   "kind",  "rgb"};

template <class Vector>
Column<Vector> vectors(const VtkXmlFile& file, const XmlElement& element, std::size_t count) {
    constexpr std::size_t components = Vector::length();
    const Column<float> values = file.values<float>(element, count, components);
    Column<Vector> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < components; ++k) {
            result[i][static_cast<int>(k)] = values[i * components + k];
        }
    }
    return result;
}

template <class Vector>
Column<Vector> vectors(const VtkXmlFile& file, const XmlElement& section, std::string_view name, std::size_t count) {
    const XmlElement* element = VtkXmlFile::find(section, name);
    if (!element) return Column<Vector>(count, Vector(0));
    return vectors<Vector>(file, *element, count);
}

Column<glm::vec3> read_points(const VtkXmlFile& file, std::size_t count) {
    const XmlElement& section = file.child(file.piece(), "Points");
    if (section.children.empty()) file.fail("it has no points");
    Column<glm::vec3> points = vectors<glm::vec3>(file, section.children.front(), count);
    for (const glm::vec3& point : points) {
        if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) {
            file.fail("a point is not finite");
        }
    }
    return points;
}

FrameCells read_cells(const VtkXmlFile& file, std::string_view section_name, std::size_t count, std::size_t points) {
    const XmlElement& section = file.child(file.piece(), section_name);
    FrameCells cells;
    const Column<std::int64_t> ends = file.values<std::int64_t>(section, "offsets", count);
    std::int64_t last = 0;
    for (const std::int64_t end : ends) {
        if (end < last || end > std::numeric_limits<std::int32_t>::max()) file.fail("cells overlap");
        last = end;
        cells.offsets.push_back(static_cast<std::int32_t>(end));
    }
    const auto corners = file.values<std::int64_t>(section, "connectivity", static_cast<std::size_t>(last));
    for (const std::int64_t corner : corners) {
        if (corner < 0 || corner >= static_cast<std::int64_t>(points))
            file.fail("a cell has a point that is not there");
        cells.connectivity.push_back(static_cast<std::int32_t>(corner));
    }
    return cells;
}

Column<std::array<std::uint8_t, 3>> read_rgb(const VtkXmlFile& file, const XmlElement& section, std::size_t count) {
    const XmlElement* element = VtkXmlFile::find(section, "rgb");
    if (!element) return {};
    const Column<std::uint8_t> values = file.values<std::uint8_t>(*element, count, 3);
    Column<std::array<std::uint8_t, 3>> rgb(count);
    for (std::size_t i = 0; i < count; ++i) rgb[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return rgb;
}

template <class T>
void read_column(const VtkXmlFile& file, const XmlElement& section, const char* name, std::size_t count,
                 Column<T>& column) {
    column = file.values<T>(section, name, count);
}

void read_column(const VtkXmlFile& file, const XmlElement& section, const char* name, std::size_t count,
                 Column<Kind>& column) {
    for (const std::uint8_t kind : file.values<std::uint8_t>(section, name, count)) {
        if (kind > static_cast<std::uint8_t>(Kind::label)) file.fail("a kind is none of those that there are");
        column.push_back(static_cast<Kind>(kind));
    }
}

FrameAttributes read_attributes(const VtkXmlFile& file, const XmlElement& section, std::size_t count,
                                std::size_t symbols) {
    FrameAttributes result;
    result.for_columns([&](const char* name, auto& column) { read_column(file, section, name, count, column); });
    result.rgb = read_rgb(file, section, count);
    if (VtkXmlFile::find(section, "organ")) result.organs = file.values<std::uint64_t>(section, "organ", count);
    const bool known = std::all_of(result.symbols.begin(), result.symbols.end(), [&](auto s) { return s < symbols; });
    if (!known) file.fail("a symbol has no name");
    return result;
}

void read_parameters(FrameGeometry& geometry, const VtkXmlFile& file, const XmlElement& section) {
    for (const XmlElement& array : section.children) {
        const std::string& name = array.attribute("Name");
        const std::string& type = array.attribute("type");
        const bool known = std::find(std::begin(known_arrays), std::end(known_arrays), name) != std::end(known_arrays);
        const std::string& components = array.attribute("NumberOfComponents");
        const bool is_number = components.empty() || components == "1";  // else a direction
        if (known || !is_number || !type.starts_with("Float")) continue;
        geometry.parameters[name] = file.values<double>(array, geometry.points.size());
    }
}

/// From "light.absorbed: mol", one for each; "1" is no unit.
std::map<std::string, std::string> read_units(const VtkXmlFile& file) {
    std::map<std::string, std::string> units;
    for (const std::string& text : file.texts("organ_units")) {
        const std::size_t colon = text.rfind(": ");
        if (colon == std::string::npos) continue;
        if (std::string unit = text.substr(colon + 2); unit != "1") units[text.substr(0, colon)] = std::move(unit);
    }
    return units;
}

Column<std::uint16_t> read_looks(const VtkXmlFile& file, const XmlElement& section, std::string_view name,
                                 std::size_t count) {
    if (!VtkXmlFile::find(section, name)) return Column<std::uint16_t>(count, std::uint16_t{0});
    return file.values<std::uint16_t>(section, name, count);
}

}  // namespace

FrameGeometry read_geometry(const std::filesystem::path& path) {
    const VtkXmlFile file(path, "PolyData");
    const XmlElement& piece = file.piece();
    const std::size_t points = file.count(piece, "NumberOfPoints");
    const std::size_t vertices = file.count(piece, "NumberOfVerts");
    const std::size_t lines = file.count(piece, "NumberOfLines");
    const std::size_t polygons = file.count(piece, "NumberOfPolys");
    const XmlElement& of_points = file.child(piece, "PointData");
    const XmlElement& of_cells = file.child(piece, "CellData");

    FrameGeometry geometry;
    geometry.symbol_names = file.texts("symbol_names");
    geometry.texture_files = file.texts("texture_files");
    geometry.label_texts = file.texts("label_texts");
    geometry.points = read_points(file, points);
    geometry.normals = vectors<glm::vec3>(file, of_points, "Normals", points);
    geometry.uvs = vectors<glm::vec2>(file, of_points, "TCoords", points);
    geometry.radii = file.values<float>(of_points, "radius", points);
    if (VtkXmlFile::find(of_points, "pixels")) geometry.pixels = file.values<float>(of_points, "pixels", points);
    geometry.vertices = read_cells(file, "Verts", vertices, points);
    geometry.lines = read_cells(file, "Lines", lines, points);
    geometry.polygons = read_cells(file, "Polys", polygons, points);
    geometry.lines.first = vertices;
    geometry.polygons.first = vertices + lines;
    const std::size_t cells = vertices + lines + polygons;
    geometry.of_points = read_attributes(file, of_points, points, geometry.symbol_names.size());
    geometry.of_cells = read_attributes(file, of_cells, cells, geometry.symbol_names.size());
    geometry.textures = read_looks(file, of_cells, "texture", cells);
    geometry.back_colours = read_looks(file, of_cells, "back_colour", cells);
    read_parameters(geometry, file, of_points);
    geometry.units = read_units(file);
    const auto named = [&](std::uint16_t texture) { return texture == 0 || texture < geometry.texture_files.size(); };
    if (!std::all_of(geometry.textures.begin(), geometry.textures.end(), named)) file.fail("a texture has no file");
    return geometry;
}

RecordedBackground read_background(const std::filesystem::path& path) {
    const VtkXmlFile file(path, "PolyData");
    const XmlElement& piece = file.piece();
    const std::size_t points = file.count(piece, "NumberOfPoints"), cells = file.count(piece, "NumberOfPolys");
    const XmlElement& of_cells = file.child(piece, "CellData");
    RecordedBackground background;
    background.points = read_points(file, points);
    background.normals = vectors<glm::vec3>(file, file.child(piece, "PointData"), "Normals", points);
    background.triangles = read_cells(file, "Polys", cells, points);
    for (std::size_t i = 0; i < cells; ++i) {
        if (background.triangles[i].size() != 3) file.fail("a triangle has not three corners");
    }
    background.rgb = read_rgb(file, of_cells, cells);
    background.opacities = file.values<float>(of_cells, "opacity", cells);
    if (background.rgb.size() != cells) file.fail("it has no colours");
    return background;
}

RecordedLives read_lives(const std::filesystem::path& path) {
    const VtkXmlFile file(path, "PolyData");
    const XmlElement& piece = file.piece();
    const std::size_t count = file.count(piece, "NumberOfLines");
    const XmlElement& cells = file.child(piece, "CellData");
    if (file.count(piece, "NumberOfPoints") != 2 * count) file.fail("an internode has not two ends");
    const Column<glm::vec3> points = read_points(file, 2 * count);
    const auto radii = file.values<float>(file.child(piece, "PointData"), "radius", 2 * count);
    const auto identities = file.values<std::uint64_t>(cells, "identity", count);
    const auto parents = file.values<std::uint64_t>(cells, "parent", count);
    const auto plants = file.values<std::uint32_t>(cells, "plant", count);
    const auto symbols = file.values<std::uint16_t>(cells, "symbol", count);
    const auto orders = file.values<std::uint16_t>(cells, "order", count);
    const auto colours = file.values<std::uint16_t>(cells, "colour", count);
    const auto births = file.values<std::int32_t>(cells, "birth", count);
    const auto deaths = file.values<std::int32_t>(cells, "death", count);
    const auto alive = file.values<std::uint8_t>(cells, "alive", count);
    RecordedLives result;
    result.symbol_names = file.texts("symbol_names");
    for (std::size_t i = 0; i < count; ++i) {
        if (symbols[i] >= result.symbol_names.size()) file.fail("a symbol has no name");
        result.lives.push_back({points[2 * i], points[2 * i + 1], radii[2 * i], radii[2 * i + 1], identities[i],
                                parents[i], plants[i], symbols[i], orders[i], colours[i], births[i], deaths[i],
                                alive[i] != 0});
    }
    return result;
}

}  // namespace espalier::archive
