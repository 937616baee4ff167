#include "study/scan/point_files.h"

#include "espalier/base/error.h"
#include "espalier/base/file.h"

#include "archive/meshes/surface_mesh.h"
#include "base/csv_file.h"
#include "base/text.h"
#include "formats/bytes.h"
#include "timeline/files/vtk_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace espalier::study {
namespace {

/// The number that a column has of a point.
using Value = double (*)(const ScanPoint&, const archive::FrameOrgan*, const PointNames&);
struct PointColumn {
    const char* name;
    Value value;
};

constexpr double none = -1;  // of the ground

const std::array all_columns{
    PointColumn{"x", [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return p.place.x; }},
    PointColumn{"y", [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return p.place.y; }},
    PointColumn{"z", [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return p.place.z; }},
    PointColumn{"distance",
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return double{p.distance}; }},
    PointColumn{"intensity",
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return double{p.intensity}; }},
    PointColumn{"return",
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return double(p.number); }},
    PointColumn{"returns",
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return double(p.of); }},
    PointColumn{"beam", [](const ScanPoint& p, const archive::FrameOrgan*,
                           const PointNames&) { return static_cast<double>(p.beam); }},
    PointColumn{"plant", [](const ScanPoint&, const archive::FrameOrgan* of,
                            const PointNames&) { return of ? of->plant : none; }},
    PointColumn{"organ", [](const ScanPoint& p, const archive::FrameOrgan*,
                            const PointNames&) { return p.organ ? static_cast<double>(*p.organ) : none; }},
    PointColumn{"identity",  // 64 bits, of which only text has all
                [](const ScanPoint&, const archive::FrameOrgan* of, const PointNames&) {
                    return of ? static_cast<double>(of->identity) : none;
                }},
    PointColumn{"symbol", [](const ScanPoint&, const archive::FrameOrgan* of,
                             const PointNames&) { return of ? of->symbol : none; }},
    PointColumn{"order", [](const ScanPoint&, const archive::FrameOrgan* of,
                            const PointNames&) { return of ? of->order : none; }},
    PointColumn{"age", [](const ScanPoint&, const archive::FrameOrgan* of,
                          const PointNames& names) { return of ? double(names.step - of->birth) : none; }},
    PointColumn{"echo_width",  // ns that light needs to and fro
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) {
                    constexpr double metres_per_nanosecond = 0.299792458;
                    return 2 * p.depth / metres_per_nanosecond;
                }},
    PointColumn{"time", [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) { return p.time; }},
    PointColumn{"zenith",  // degrees
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) {
                    return glm::degrees(std::acos(std::clamp(double{p.direction.y}, -1.0, 1.0)));
                }},
    PointColumn{"azimuth",  // degrees from -z towards +x
                [](const ScanPoint& p, const archive::FrameOrgan*, const PointNames&) {
                    return glm::degrees(std::atan2(double{p.direction.x}, -double{p.direction.z}));
                }},
};

// Of all columns, those that every file has unless others are asked for.
constexpr std::size_t usual_columns = 14;

/// What HELIOS++ writes into its .xyz files (Winiwarter et al. 2022): X, Y, Z, intensity, echo width, return number,
/// number of returns, index of the pulse, object, class, time.
const std::vector<std::string> helios_columns{"x",       "y",    "z",     "intensity", "echo_width", "return",
                                              "returns", "beam", "plant", "symbol",    "time"};

/// `is_text`: the file has texts and whole numbers of any size.
std::vector<const PointColumn*> chosen(const PointFileOptions& options, bool is_text) {
    std::vector<std::string> names = options.columns;
    if (names.empty()) {
        names = point_columns();
        names.resize(usual_columns);
        if (!is_text) std::erase(names, "identity");
    }
    if (names == std::vector<std::string>{"helios++"}) names = helios_columns;
    std::vector<const PointColumn*> found;
    for (const std::string& name : names) {
        const auto column = std::find_if(all_columns.begin(), all_columns.end(),
                                         [&](const PointColumn& each) { return each.name == name; });
        if (column == all_columns.end()) {
            throw UserError(fmt::format("--columns {}: points have no such column{}; they have {}", name,
                                        did_you_mean(name, point_columns()), fmt::join(point_columns(), ", ")));
        }
        if (!is_text && name == "identity") {
            throw UserError("--columns identity: only .csv has numbers of 64 bits; take `organ`, or a .csv file");
        }
        found.push_back(&*column);
    }
    return found;
}

/// A point with its place in the axes that were asked for, and its organ.
template <class Visit>
void for_each_point(std::span<const ScanPoint> points, const ScannedPlants& plants, char up, const Visit& visit) {
    for (ScanPoint point : points) {
        if (up == 'z') point.place = {point.place.x, -point.place.z, point.place.y};
        visit(point, point.organ ? &plants.organs()[*point.organ] : nullptr);
    }
}

/// Identities need all their digits, the texts of symbols and plants stand for their numbers in tables.
std::string cell(const PointColumn& column, const ScanPoint& point, const archive::FrameOrgan* organ,
                 const PointNames& names) {
    const std::string_view name = column.name;
    if (organ && name == "identity") return std::to_string(organ->identity);
    if (organ && name == "symbol") return csv_text(names.symbols.at(organ->symbol));
    if (organ && name == "plant") return csv_text(names.plants.at(organ->plant));
    if (name == "symbol" || name == "plant") return "ground";
    return csv_number(column.value(point, organ, names));
}

std::string table(std::span<const ScanPoint> points, const ScannedPlants& plants, const PointNames& names,
                  const PointFileOptions& options, bool is_csv) {
    const std::vector<const PointColumn*> columns = chosen(options, is_csv);
    std::string text;
    for (const PointColumn* column : columns) {
        if (is_csv) text.append(text.empty() ? "" : ",").append(column->name);
    }
    if (is_csv) text += '\n';
    for_each_point(points, plants, options.up, [&](const ScanPoint& point, const archive::FrameOrgan* organ) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            if (i > 0) text += is_csv ? ',' : ' ';
            text +=
                is_csv ? cell(*columns[i], point, organ, names) : csv_number(columns[i]->value(point, organ, names));
        }
        text += '\n';
    });
    return text;
}

std::string ply(std::span<const ScanPoint> points, const ScannedPlants& plants, const PointNames& names,
                const PointFileOptions& options) {
    const std::vector<const PointColumn*> columns = chosen(options, false);
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment made by espalier; metres\nelement vertex {}\n", points.size());
    for (const PointColumn* column : columns) bytes += fmt::format("property double {}\n", column->name);
    bytes += "end_header\n";
    for_each_point(points, plants, options.up, [&](const ScanPoint& point, const archive::FrameOrgan* organ) {
        for (const PointColumn* column : columns) formats::append_bytes(bytes, column->value(point, organ, names));
    });
    return bytes;
}

void write_vtp(std::span<const ScanPoint> points, const ScannedPlants& plants, const PointNames& names,
               const PointFileOptions& options, const std::filesystem::path& path) {
    VtkFile file(Compression::lz4);
    Column<float> places;
    std::vector<const PointColumn*> columns = chosen(options, false);
    std::erase_if(columns, [](const PointColumn* column) { return column->name[1] == '\0'; });  // x, y, z
    std::vector<Column<double>> values(columns.size());
    Column<std::int32_t> connectivity, ends;
    for_each_point(points, plants, options.up, [&](const ScanPoint& point, const archive::FrameOrgan* organ) {
        for (int axis = 0; axis < 3; ++axis) places.push_back(static_cast<float>(point.place[axis]));
        for (std::size_t i = 0; i < columns.size(); ++i) values[i].push_back(columns[i]->value(point, organ, names));
        connectivity.push_back(static_cast<std::int32_t>(connectivity.size()));
        ends.push_back(static_cast<std::int32_t>(connectivity.size()));
    });
    file.begin("PolyData");
    file.open("PolyData");
    file.open("Piece", fmt::format(R"(NumberOfPoints="{}" NumberOfVerts="{}")", points.size(), points.size()));
    file.open("PointData");
    for (std::size_t i = 0; i < columns.size(); ++i) file.add(data_array<double>(columns[i]->name, values[i]));
    file.close();
    file.add_points(data_array<float>("Points", places, 3));
    file.open("Verts");
    file.add(data_array<std::int32_t>("connectivity", connectivity));
    file.add(data_array<std::int32_t>("offsets", ends));
    file.write(path);
}

}  // namespace

const std::vector<std::string>& point_columns() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const PointColumn& column : all_columns) all.emplace_back(column.name);
        return all;
    }();
    return names;
}

void require_point_file(const std::filesystem::path& path, const PointFileOptions& options) {
    const std::string extension = path.extension().string();
    (void)chosen(options, extension == ".csv");
    if (extension == ".csv" || extension == ".xyz" || extension == ".ply" || extension == ".vtp") return;
    throw UserError(fmt::format("--output {}: expected the name of a .csv, .xyz, .ply or .vtp file", path.string()));
}

void write_points(std::span<const ScanPoint> points, const ScannedPlants& plants, const PointNames& names,
                  const PointFileOptions& options, const std::filesystem::path& path) {
    require_point_file(path, options);
    const std::string extension = path.extension().string();
    if (extension == ".vtp") return write_vtp(points, plants, names, options, path);
    if (extension == ".ply") return write_text(path, ply(points, plants, names, options));
    write_text(path, table(points, plants, names, options, extension == ".csv"));
}

}  // namespace espalier::study
