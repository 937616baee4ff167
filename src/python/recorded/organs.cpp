#include "python/recorded/organs.h"

#include "espalier/archive/recorded_run.h"

#include "archive/frame_rows.h"

#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace espalier::python {
namespace {

/// Texts by numbers, each once.
class Words {
public:
    std::uint32_t number_of(const std::string& text) {
        const auto [found, is_new] = numbers_.emplace(text, static_cast<std::uint32_t>(texts_.size()));
        if (is_new) texts_.push_back(text);
        return found->second;
    }
    const std::vector<std::string>& texts() const { return texts_; }

private:
    std::vector<std::string> texts_;
    std::map<std::string, std::uint32_t> numbers_;
};

/// Columns that grow, each an array in the end.
struct OrganColumns {
    std::vector<std::int32_t> step, birth;
    std::vector<double> time;
    std::vector<std::uint32_t> plant, symbol, name;
    std::vector<std::uint8_t> kind;
    std::vector<std::uint16_t> order, colour;
    std::vector<std::uint64_t> identity, parent;
    std::vector<std::int64_t> organ;  ///< -1 in runs without them
    std::vector<float> x, y, z, end_x, end_y, end_z;
    std::vector<double> length, radius, area, volume;
    std::map<std::string, std::vector<double>> parameters;  ///< those of the first frame
    Words symbols, names;

    void add(const RecordedRun& run, const RecordedFrame& frame, const FrameGeometry& geometry,
             const archive::FrameRow& row) {
        const FrameAttributes& of = row.of;
        const std::size_t at = row.attributes;
        name.push_back(names.number_of(run.plants()[of.plants[at]].name));
        step.push_back(frame.step);
        time.push_back(frame.time);
        plant.push_back(of.plants[at]);
        kind.push_back(static_cast<std::uint8_t>(row.what));
        symbol.push_back(symbols.number_of(geometry.symbol_names[of.symbols[at]]));
        identity.push_back(of.identities[at]);
        organ.push_back(of.organs.empty() ? -1 : static_cast<std::int64_t>(of.organs[at]));
        parent.push_back(of.parents[at]);
        birth.push_back(of.births[at]);
        order.push_back(of.orders[at]);
        colour.push_back(of.colours[at]);
        add_places(row);
        for (auto& [name, values] : parameters) {
            const auto column = geometry.parameters.find(name);
            values.push_back(column == geometry.parameters.end() ? std::nan("") : column->second[row.point]);
        }
    }

private:
    void add_places(const archive::FrameRow& row) {
        x.push_back(row.base.x), y.push_back(row.base.y), z.push_back(row.base.z);
        end_x.push_back(row.end.x), end_y.push_back(row.end.y), end_z.push_back(row.end.z);
        length.push_back(row.length);
        radius.push_back(row.radius);
        area.push_back(row.area);
        volume.push_back(row.volume);
    }
};

template <class T>
py::array array_of(std::vector<T>& column) {
    column.shrink_to_fit();
    const auto kept = std::make_shared<const std::vector<T>>(std::move(column));
    return view(kept, kept->data(), {static_cast<py::ssize_t>(kept->size())}, {sizeof(T)});
}

py::dict arrays_of(OrganColumns& columns) {
    py::dict arrays;
    arrays["step"] = array_of(columns.step);
    arrays["time"] = array_of(columns.time);
    arrays["plant"] = array_of(columns.plant);
    arrays["name"] = py::make_tuple(array_of(columns.name), columns.names.texts());
    arrays["kind"] = py::make_tuple(array_of(columns.kind), std::vector<std::string>{"internode", "organ", "query"});
    arrays["symbol"] = py::make_tuple(array_of(columns.symbol), columns.symbols.texts());
    arrays["identity"] = array_of(columns.identity);
    arrays["organ"] = array_of(columns.organ);
    arrays["parent"] = array_of(columns.parent);
    arrays["birth"] = array_of(columns.birth);
    arrays["order"] = array_of(columns.order);
    arrays["colour"] = array_of(columns.colour);
    arrays["x"] = array_of(columns.x);
    arrays["y"] = array_of(columns.y);
    arrays["z"] = array_of(columns.z);
    arrays["end_x"] = array_of(columns.end_x);
    arrays["end_y"] = array_of(columns.end_y);
    arrays["end_z"] = array_of(columns.end_z);
    arrays["length"] = array_of(columns.length);
    arrays["radius"] = array_of(columns.radius);
    arrays["area"] = array_of(columns.area);
    arrays["volume"] = array_of(columns.volume);
    for (auto& [name, values] : columns.parameters) arrays[py::str(name)] = array_of(values);
    return arrays;
}

}  // namespace

py::dict organs_of(const RecordedRun& run, const std::vector<int>& steps) {
    OrganColumns columns;
    {
        const py::gil_scoped_release free;
        for (const int step : steps) {
            const RecordedFrame& frame = run.frame(step);
            const FrameGeometry geometry = run.geometry(frame);
            if (step == steps.front()) {
                for (const auto& [name, values] : geometry.parameters) columns.parameters[name];
            }
            archive::for_each_row(geometry, run.folder(),
                                  [&](const archive::FrameRow& row) { columns.add(run, frame, geometry, row); });
        }
    }
    return arrays_of(columns);
}

}  // namespace espalier::python
