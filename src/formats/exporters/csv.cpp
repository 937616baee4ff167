// One table of all internodes, organs and answered queries of all frames, for statistics programs.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/facet_areas.h"
#include "archive/meshes/surface_mesh.h"
#include "base/csv_file.h"
#include "base/text.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <cmath>
#include <iterator>
#include <numbers>

namespace espalier::formats {
namespace {

/// What a row says of the module: its attributes stand in a row of a frame's points or cells.
struct Described {
    const char* kind;
    const FrameAttributes& of;
    std::size_t row;
};

class Table {
public:
    explicit Table(const ExportJob& job) : job_(job) {}

    void add(const RecordedFrame& frame) {
        const FrameGeometry geometry = job_.run.geometry(frame);
        if (text_.empty()) add_header(geometry);
        for (const FrameInternode& internode : internodes_of(geometry)) {
            if (wanted(internode.plant)) add_internode(frame, geometry, internode);
        }
        add_organs(frame, geometry);
        add_queries(frame, geometry);
    }

    std::size_t rows() const { return rows_; }
    const std::string& text() const { return text_; }

private:
    bool wanted(std::uint32_t plant) const { return !job_.options.plant || *job_.options.plant == plant; }

    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_header(const FrameGeometry& geometry) {
        text_ =
            "step,time,plant,name,kind,symbol,identity,organ,parent,birth,order,colour,x,y,z,end_x,end_y,end_z,length,"
            "radius,"
            "area,volume";
        for (const auto& [name, values] : geometry.parameters) {
            parameters_.push_back(name);
            text_.append(",").append(csv_text(name));
        }
        text_ += '\n';
    }

    void begin_row(const RecordedFrame& frame, const FrameGeometry& geometry, const Described& described) {
        const auto& [kind, of, row] = described;
        put("{},{},{},{},{},{},{},", frame.step, format_exact(frame.time), of.plants[row],
            csv_text(job_.run.plants()[of.plants[row]].name), kind, csv_text(geometry.symbol_names[of.symbols[row]]),
            of.identities[row]);
        if (!of.organs.empty()) put("{}", of.organs[row]);
        put(",{},{},{},{}", of.parents[row], of.births[row], of.orders[row], of.colours[row]);
        ++rows_;
    }

    void put(const glm::vec3& position) {
        const glm::vec3 v = upright(position, job_.options.up);
        put(",{},{},{}", v.x, v.y, v.z);
    }

    // A parameter the module has not is an empty cell.
    void end_row(const FrameGeometry& geometry, std::size_t point) {
        for (const std::string& name : parameters_) {
            const auto column = geometry.parameters.find(name);
            text_ += ',';
            if (column == geometry.parameters.end() || std::isnan(column->second[point])) continue;
            text_ += format_exact(column->second[point]);
        }
        text_ += '\n';
    }

    void add_internode(const RecordedFrame& frame, const FrameGeometry& geometry, const FrameInternode& internode) {
        const std::size_t point = internode.tip_point.row();
        begin_row(frame, geometry, {"internode", geometry.of_points, point});
        put(internode.base);
        put(internode.tip);
        const double length = glm::distance(internode.base, internode.tip);
        const double a = internode.base_radius, b = internode.tip_radius;
        const double slant = std::sqrt(length * length + (a - b) * (a - b));
        put(",{},{},{},{}", format_exact(length), format_exact((a + b) / 2),
            format_exact(std::numbers::pi * (a + b) * slant),
            format_exact(std::numbers::pi / 3 * length * (a * a + a * b + b * b)));
        end_row(geometry, point);
    }

    // Neighbouring polygons of one module are one organ; its place is its first corner, its end the farthest from
    // there.
    void add_organs(const RecordedFrame& frame, const FrameGeometry& geometry) {
        const FrameAttributes& of = geometry.of_cells;
        const archive::FacetAreas areas(geometry, job_.run.folder());
        for (std::size_t cell = 0; cell < geometry.polygons.size();) {
            const std::size_t row = geometry.polygons.first + cell;
            std::size_t end = cell + 1;
            while (end < geometry.polygons.size() &&
                   of.identities[geometry.polygons.first + end] == of.identities[row] &&
                   of.kinds[geometry.polygons.first + end] == of.kinds[row]) {
                ++end;
            }
            if (wanted(of.plants[row])) add_organ(frame, geometry, areas, cell, end);
            cell = end;
        }
    }

    void add_organ(const RecordedFrame& frame, const FrameGeometry& geometry, const archive::FacetAreas& areas,
                   std::size_t first, std::size_t end) {
        const std::size_t row = geometry.polygons.first + first;
        const auto corners = geometry.polygons[first];
        if (corners.empty()) return;
        const auto point = static_cast<std::size_t>(corners[0]);
        const glm::vec3 base = geometry.points[point];
        glm::vec3 farthest = base;
        double area = 0;
        for (std::size_t cell = first; cell < end; ++cell) {
            const auto polygon = geometry.polygons[cell];
            const auto corner = [&](std::size_t i) { return geometry.points[static_cast<std::size_t>(polygon[i])]; };
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                if (glm::distance(corner(i), base) > glm::distance(farthest, base)) farthest = corner(i);
            }
            area += areas.of(cell);
        }
        begin_row(frame, geometry, {"organ", geometry.of_cells, row});
        put(base);
        put(farthest);
        put(",{},,{},", format_exact(glm::distance(base, farthest)), format_exact(area));
        end_row(geometry, point);
    }

    // What they were answered is a chosen parameter.
    void add_queries(const RecordedFrame& frame, const FrameGeometry& geometry) {
        const FrameAttributes& of = geometry.of_cells;
        for (std::size_t cell = 0; cell < geometry.vertices.size(); ++cell) {
            const std::size_t row = geometry.vertices.first + cell;
            const auto corners = geometry.vertices[cell];
            if (of.kinds[row] != Kind::query || corners.empty() || !wanted(of.plants[row])) continue;
            const auto point = static_cast<std::size_t>(corners[0]);
            begin_row(frame, geometry, {"query", of, row});
            put(geometry.points[point]);
            text_ += ",,,,,,,";
            end_row(geometry, point);
        }
    }

    const ExportJob& job_;
    std::vector<std::string> parameters_;  ///< parameters of the first frame
    std::string text_;
    std::size_t rows_ = 0;
};

class Csv final : public Exporter {
public:
    std::string extension() const override { return "csv"; }

    void write(const ExportJob& job) const override {
        Table table(job);
        for (const RecordedFrame* frame : job.frames) table.add(*frame);
        const auto path = job.path(extension());
        write_text(path, table.text());
        job.report({path, 0, 0, table.rows(), "rows"});
    }
};

const Registered<ExporterType> entry{
    {"csv", "a table with a row per frame and internode, organ or answered query: for R, pandas, spreadsheets",
     "Columns: step, time, plant (its number), name, kind (internode, organ, query), symbol, identity, organ (number "
     "of "
     "the module, from 0 in the order of births), parent, birth, order, colour, x, y, z, end_x, end_y, end_z,\n"
     "length, radius, area (m2, of one side of an organ), volume, and the run's chosen parameters. All frames in one "
     "file.\n"
     "Lost: the shape of organs",
     construct<Csv>}};

}  // namespace
}  // namespace espalier::formats
