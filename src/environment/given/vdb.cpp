// vdb: a field of numbers or vectors from OpenVDB files, as other programs write them: one, or several in time.
#include "espalier/environment/environment_process.h"
#include "espalier/geometry/field_values.h"

#include "base/parallel.h"
#include "base/text.h"
#include "environment/exchange/rising.h"
#include "geometry/grids/grid_map.h"
#include "geometry/grids/voxel_values.h"

#include <fmt/format.h>

namespace espalier::environment {
namespace {

/// Maps in time. Between two of them values change by straight lines; one alone holds for ever.
class MapsInTime {
public:
    MapsInTime(const Settings& settings, std::string name, std::size_t memory)
        : name_(std::move(name)), memory_(memory) {
        const std::string grid = settings.text_or("grid", "");
        const auto read = [&](const Settings& table) {
            return read_grid_map(
                {table.path("file"), table.place("file"), grid, settings.place("grid"), memory - bytes_});
        };
        if (!settings.has("maps")) add(0, read(settings), settings.place("file"));
        for (const Settings& table : settings.tables("maps")) {
            add(table.number("time"), read(table), table.place());
        }
        if (maps_.empty()) throw UserError(settings.place("maps"), "'maps' must hold one map or more");
        if (change() && times_.front() > 0) {
            throw UserError(settings.place("maps"), fmt::format("the first map is of time {}, but runs begin at 0",
                                                                format_general(times_.front())));
        }
    }

    bool change() const { return maps_.size() > 1; }
    std::size_t parts() const { return maps_.front().parts.size(); }
    const std::string& grid() const { return maps_.front().grid; }
    std::size_t bytes() const { return bytes_; }

    std::shared_ptr<const FieldGrid> at(double time, std::size_t part) const {
        require_covered(times_, time, fmt::format("'{}'", name_), "maps");
        const Between place = find_between(times_, time);
        const auto& before = maps_[place.index].parts[part];
        return place.share > 0 ? mixed(*before, *maps_[place.index + 1].parts[part], place.share) : before;
    }

private:
    void add(double time, GridMap map, const Place& place) {
        if (!times_.empty() && time <= times_.back()) {
            throw UserError(place, fmt::format("time {} is not behind time {} of the map before", format_general(time),
                                               format_general(times_.back())));
        }
        if (!maps_.empty() && !same_lattice(map, maps_.front())) {
            throw UserError(place, fmt::format("this map does not match the first, '{}': maps in time have the same "
                                               "lattice, and all hold numbers or all vectors",
                                               grid()));
        }
        for (const auto& part : map.parts) bytes_ += bytes_held(*part);
        if (bytes_ > memory_) {
            throw UserError(place, fmt::format("the grids take {:.3g} GB, which is more than the memory there is",
                                               static_cast<double>(bytes_) / 1e9));
        }
        times_.push_back(time);
        maps_.push_back(std::move(map));
    }

    std::string name_;                ///< of the process
    std::size_t memory_, bytes_ = 0;  ///< that there are, and that the grids take
    std::vector<double> times_;
    std::vector<GridMap> maps_;
};

class Vdb final : public EnvironmentProcess {
public:
    Vdb(Settings& settings, const EnvironmentContext& context, Fields& fields)
        : maps_(settings, context.name, context.memory), unit_(settings.text_or("unit", "1")) {
        for (std::size_t k = 0; k < maps_.parts(); ++k) {
            names_.push_back(maps_.parts() == 1 ? context.name : context.name + "." + "xyz"[k]);
        }
        show(0, fields);
    }

    void advance(const WorldView& world, Queries, Fields& fields) override {
        if (maps_.change()) show(world.time, fields);
    }

    void answer(const WorldView&, Queries queries, std::span<Answer> answers, Fields&) override {
        for_in_parallel(std::size_t{0}, queries.size(), [&](std::size_t i) {
            const glm::dvec3& place = queries[i].pose.position;
            for (std::size_t k = 0; k < names_.size(); ++k) answers[i][k] = values_.value(names_[k], place);
            if (answers[i].size() < 4) return;
            const glm::dvec3 slope = values_.gradient(names_[0], place);
            for (int axis = 0; axis < 3; ++axis) answers[i][std::size_t(1 + axis)] = slope[axis];
        });
    }

    std::pair<int, int> query_arity() const override { return names_.size() == 1 ? std::pair{1, 4} : std::pair{3, 3}; }
    Spreading spreading() const override { return Spreading::reach; }
    ProcessMemory memory() const override { return {maps_.bytes()}; }

private:
    void show(double time, Fields& fields) {
        const std::string meaning = fmt::format("grid '{}' of a file", maps_.grid());
        for (std::size_t k = 0; k < names_.size(); ++k) {
            fields.provide({names_[k], unit_, meaning, maps_.at(time, k), maps_.change()});
        }
        values_.take(fields, names_);
    }

    MapsInTime maps_;
    std::string unit_;
    std::vector<std::string> names_;  ///< names of the fields
    FieldValues values_;
};

const Registered<ProcessType> entry{
    {"vdb", "numbers or vectors from OpenVDB files, also in time",
     R"(?name(v)          -> the value of a grid of numbers at the position, interpolated linearly
?name(v, x, y, z) -> and its slope per metre
?name(x, y, z)    -> the vector of a grid of vectors

file   required; a .vdb file, relative to the scene. Its lattice is in metres
maps   none; files in time, instead of file: tables { time, file }, the times in the scene's unit and rising
grid   the first in the file; the name of a grid in it
unit   "1"; unit of the values

Between the times of two maps, values change by straight lines. Two maps or more begin at time 0 and cover the run, and have
one lattice.

Fields: name; of vectors name.x, name.y and name.z, which a model reads as vector(name).)",
     construct<Vdb>}};

}  // namespace
}  // namespace espalier::environment
