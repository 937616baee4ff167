// One table of all internodes, organs and answered queries of all frames, for statistics programs.
#include "espalier/base/file.h"
#include "espalier/formats/exporter.h"

#include "archive/frame_rows.h"
#include "archive/meshes/surface_mesh.h"
#include "base/csv_file.h"
#include "base/text.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace espalier::formats {
namespace {

class Table {
public:
    explicit Table(const ExportJob& job) : job_(job) {}

    void add(const RecordedFrame& frame) {
        const FrameGeometry geometry = job_.run.geometry(frame);
        if (text_.empty()) add_header(geometry);
        archive::for_each_row(geometry, job_.run.folder(),
                              [&](const archive::FrameRow& row) { add(frame, geometry, row); });
    }

    std::size_t rows() const { return rows_; }
    const std::string& text() const { return text_; }

private:
    template <class... Values>
    void put(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    void add_header(const FrameGeometry& geometry) {
        text_ =
            "step,time,plant,name,kind,symbol,identity,organ,parent,birth,order,colour,x,y,z,end_x,end_y,end_z,length,"
            "radius,area,volume";
        for (const auto& [name, values] : geometry.parameters) {
            parameters_.push_back(name);
            text_.append(",").append(csv_text(name));
        }
        text_ += '\n';
    }

    void add(const RecordedFrame& frame, const FrameGeometry& geometry, const archive::FrameRow& row) {
        const std::uint32_t plant = row.of.plants[row.attributes];
        if (job_.options.plant && *job_.options.plant != plant) return;
        add_names(frame, geometry, row);
        put(row.base);
        std::isnan(row.end.x) ? text_.append(",,,"), void() : put(row.end);
        for (const double value : {row.length, row.radius, row.area, row.volume}) {
            text_.append(",").append(csv_number(value));
        }
        for (const std::string& name : parameters_) {  // one that the module has not is an empty cell
            const auto column = geometry.parameters.find(name);
            text_ += ',';
            if (column != geometry.parameters.end()) text_ += csv_number(column->second[row.point]);
        }
        text_ += '\n';
        ++rows_;
    }

    void add_names(const RecordedFrame& frame, const FrameGeometry& geometry, const archive::FrameRow& row) {
        const FrameAttributes& of = row.of;
        const std::size_t at = row.attributes;
        put("{},{},{},{},{},{},{},", frame.step, format_exact(frame.time), of.plants[at],
            csv_text(job_.run.plants()[of.plants[at]].name), name_of(row.what),
            csv_text(geometry.symbol_names[of.symbols[at]]), of.identities[at]);
        if (!of.organs.empty()) put("{}", of.organs[at]);
        put(",{},{},{},{}", of.parents[at], of.births[at], of.orders[at], of.colours[at]);
    }

    void put(const glm::vec3& position) {
        const glm::vec3 v = upright(position, job_.options.up);
        put(",{},{},{}", v.x, v.y, v.z);
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
