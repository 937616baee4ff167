// vdb: a field of numbers or vectors from an OpenVDB file, as other programs write it.
#include "espalier/base/file.h"
#include "espalier/environment/environment_process.h"
#include "espalier/geometry/field_values.h"
#include "espalier/geometry/openvdb_grid.h"

#include "base/parallel.h"
#include "base/text.h"

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

class Vdb final : public EnvironmentProcess {
public:
    Vdb(Settings& settings, const EnvironmentContext& context, Fields& fields) {
        const Place place = settings.place("file");
        const openvdb::GridBase::Ptr grid = chosen_grid(read_grids(settings.path("file"), place), settings);
        const std::string unit = settings.text_or("unit", "1");
        std::vector<std::shared_ptr<const FieldGrid>> parts;
        const bool is_known =
            add_numbers<openvdb::FloatGrid>(*grid, parts) || add_numbers<openvdb::DoubleGrid>(*grid, parts) ||
            add_vectors<openvdb::Vec3SGrid>(*grid, parts) || add_vectors<openvdb::Vec3DGrid>(*grid, parts);
        if (!is_known || !grid->transform().isLinear()) {
            throw UserError(place,
                            fmt::format("the grid '{}' is neither of numbers nor of vectors in a regular lattice",
                                        grid->getName()));
        }
        for (const auto& part : parts) bytes_ += part->grid->memUsage();
        if (bytes_ > context.memory) {
            throw UserError(place, fmt::format("the grid takes {:.3g} GB, which is more than the memory there is",
                                               static_cast<double>(bytes_) / 1e9));
        }
        const std::string meaning = fmt::format("grid '{}' of a file", grid->getName());
        for (std::size_t k = 0; k < parts.size(); ++k) {
            names_.push_back(parts.size() == 1 ? context.name : context.name + "." + "xyz"[k]);
            fields.provide({names_.back(), unit, meaning, parts[k], false});
        }
        values_.take(fields, names_);
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
    Spreading spreading() const override { return Spreading::queries; }
    ProcessMemory memory() const override { return {bytes_}; }

private:
    std::size_t bytes_ = 0;           ///< bytes of the grid
    std::vector<std::string> names_;  ///< names of the fields
    FieldValues values_;
};

const Registered<ProcessType> entry{
    {"vdb", "numbers or vectors from an OpenVDB file",
     R"(?name(v)          -> the value of a grid of numbers at the position, interpolated linearly
?name(v, x, y, z) -> and its slope per metre
?name(x, y, z)    -> the vector of a grid of vectors

file   required; a .vdb file, relative to the scene. Its lattice is in metres
grid   the first in the file; the name of a grid in it
unit   "1"; unit of the values

Fields: name; of vectors name.x, name.y and name.z, which a model reads as vector(name).)",
     construct<Vdb>}};

}  // namespace
}  // namespace espalier::environment
