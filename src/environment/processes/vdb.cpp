// vdb: a field of numbers or vectors from OpenVDB files, as other programs write them: one, or several in time.
#include "espalier/base/file.h"
#include "espalier/environment/environment_process.h"
#include "espalier/geometry/field_values.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"
#include "base/text.h"
#include "environment/rising.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openvdb/io/Stream.h>

#include <sstream>

namespace espalier::environment {
namespace {

/// The grids of a file. Throws UserError at `place`.
openvdb::GridPtrVec read_grids(const std::filesystem::path& path, const Place& place) {
    initialize_openvdb();
    try {
        std::istringstream in(read_text(path), std::ios::binary);
        const openvdb::GridPtrVecPtr grids = openvdb::io::Stream(in, /*delayLoad=*/false).getGrids();
        if (!grids->empty()) return *grids;
    } catch (const UserError& error) {
        throw UserError(place, error.what());
    } catch (const std::exception& error) {
        throw UserError(place, fmt::format("{} is no OpenVDB file: {}", path.string(), error.what()));
    }
    throw UserError(place, fmt::format("{} holds no grid", path.string()));
}

/// The one that the key `grid` names, or the first.
openvdb::GridBase::Ptr chosen_grid(const openvdb::GridPtrVec& grids, const Settings& settings) {
    const std::string wanted = settings.text_or("grid", grids.front()->getName());
    std::vector<std::string> names;
    for (const openvdb::GridBase::Ptr& grid : grids) {
        if (grid->getName() == wanted) return grid;
        names.push_back(grid->getName());
    }
    throw UserError(settings.place("grid"), fmt::format("the file has no grid '{}'{}; it has: {}", wanted,
                                                        did_you_mean(wanted, names), fmt::join(names, ", ")));
}

/// A grid of floats with what `part` takes of each value.
template <class Grid, class Part>
std::shared_ptr<const FieldGrid> part_of(const Grid& source, const Part& part) {
    const auto floats = openvdb::FloatGrid::create(static_cast<float>(part(source.background())));
    floats->setTransform(source.transform().copy());
    for (auto value = source.cbeginValueOn(); value; ++value) {
        openvdb::CoordBBox box;
        value.getBoundingBox(box);
        floats->fill(box, static_cast<float>(part(*value)));
    }
    return std::make_shared<FieldGrid>(FieldGrid{floats, floats->evalActiveVoxelBoundingBox()});
}

template <class Grid>
bool add_numbers(const openvdb::GridBase& grid, std::vector<std::shared_ptr<const FieldGrid>>& found) {
    if (!grid.isType<Grid>()) return false;
    found.push_back(part_of(static_cast<const Grid&>(grid), [](const auto& value) { return value; }));
    return true;
}

template <class Grid>
bool add_vectors(const openvdb::GridBase& grid, std::vector<std::shared_ptr<const FieldGrid>>& found) {
    if (!grid.isType<Grid>()) return false;
    for (int axis = 0; axis < 3; ++axis) {
        found.push_back(part_of(static_cast<const Grid&>(grid), [axis](const auto& value) { return value[axis]; }));
    }
    return true;
}

/// What a file holds of a field: a grid of numbers, or one for each component of vectors.
struct Map {
    std::string grid;  ///< name in the file
    std::vector<std::shared_ptr<const FieldGrid>> parts;
};

Map read_map(const std::filesystem::path& path, const Place& place, const Settings& settings) {
    const openvdb::GridBase::Ptr grid = chosen_grid(read_grids(path, place), settings);
    Map map{grid->getName(), {}};
    const bool is_known =
        add_numbers<openvdb::FloatGrid>(*grid, map.parts) || add_numbers<openvdb::DoubleGrid>(*grid, map.parts) ||
        add_vectors<openvdb::Vec3SGrid>(*grid, map.parts) || add_vectors<openvdb::Vec3DGrid>(*grid, map.parts);
    if (is_known && grid->transform().isLinear()) return map;
    throw UserError(place,
                    fmt::format("the grid '{}' is neither of numbers nor of vectors in a regular lattice", map.grid));
}

/// Maps in time. Between two of them values change by straight lines; one alone holds for ever.
class MapsInTime {
public:
    MapsInTime(const Settings& settings, std::string name, std::size_t memory)
        : name_(std::move(name)), memory_(memory) {
        if (!settings.has("maps")) {
            add(0, read_map(settings.path("file"), settings.place("file"), settings), settings.place("file"));
        }
        for (const Settings& table : settings.tables("maps")) {
            add(table.number("time"), read_map(table.path("file"), table.place("file"), settings), table.place());
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
    void add(double time, Map map, const Place& place) {
        if (!times_.empty() && time <= times_.back()) {
            throw UserError(place, fmt::format("time {} is not behind time {} of the map before", format_general(time),
                                               format_general(times_.back())));
        }
        if (!maps_.empty() && !fits(map)) {
            throw UserError(place, fmt::format("this map does not match the first, '{}': maps in time have the same "
                                               "lattice, and all hold numbers or all vectors",
                                               grid()));
        }
        for (const auto& part : map.parts) bytes_ += part->grid->memUsage();
        if (bytes_ > memory_) {
            throw UserError(place, fmt::format("the grids take {:.3g} GB, which is more than the memory there is",
                                               static_cast<double>(bytes_) / 1e9));
        }
        times_.push_back(time);
        maps_.push_back(std::move(map));
    }

    bool fits(const Map& map) const {
        return map.parts.size() == parts() &&
               map.parts.front()->grid->transform() == maps_.front().parts.front()->grid->transform();
    }

    static std::shared_ptr<const FieldGrid> mixed(const FieldGrid& a, const FieldGrid& b, double share) {
        const auto grid = openvdb::FloatGrid::create();
        grid->setTransform(a.grid->transform().copy());
        const auto mix = [share](const float& before, const float& after, float& value) {
            value = static_cast<float>(before + share * (double(after) - before));
        };
        grid->tree().combine2(a.grid->tree(), b.grid->tree(), mix);
        openvdb::CoordBBox box = a.box;
        box.expand(b.box);
        return std::make_shared<FieldGrid>(FieldGrid{grid, box});
    }

    std::string name_;                ///< of the process
    std::size_t memory_, bytes_ = 0;  ///< that there are, and that the grids take
    std::vector<double> times_;
    std::vector<Map> maps_;
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

    void advance(const WorldView& world, std::span<const Query>, Fields& fields) override {
        if (maps_.change()) show(world.time, fields);
    }

    void answer(const WorldView&, std::span<const Query> queries, std::span<Answer> answers, Fields&) override {
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
