// lifespans.vtp: every internode of the run once, with birth and death, written at the end of the run.
// A threshold birth <= t < death shows the plant as it stood at step t.
//
// Parameters: lifespans (true or false, default true).
// Each internode is a line of two points, where it was last seen. Cell arrays: identity, organ (number of the module in
// the order of births), parent, plant, symbol (index into symbol_names), birth (step its module was born), death (first
// step without it; last step + 1 if it lives), both as times too, alive (1 or 0), order, colour. Point array: radius.
// Field data: units.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "timeline/files/vtk_file.h"
#include "timeline/measures/internode_lives.h"
#include "timeline/meshes/symbol_numbers.h"

#include <fmt/format.h>

#include <deque>
#include <map>
#include <type_traits>

namespace espalier::timeline {
namespace {

class Lifespans final : public Recorder {
public:
    explicit Lifespans(const RecorderContext& context)
        : path_(context.folder / "lifespans.vtp"), file_(context.compression) {}

    bool sees_every_step() const override { return true; }

    void record(const Frame& frame) override {
        for (const PlantFrame& plant : frame.plants) {
            plants_[plant.plant].record(frame.step, plant, symbols_.of(*plant.model));
        }
        last_step_ = frame.step;
        time_ = frame.time;
        dt_ = frame.dt;
        time_unit_ = frame.time_unit;
    }

    void finish() override {
        gather();
        fill_geometry();
        file_.begin("PolyData");
        file_.open("PolyData");
        file_.open("FieldData");
        file_.add_time(time_, last_step_);
        file_.add_texts("symbol_names", symbols_.names());
        file_.add_texts("units", {"birth: step", "death: step", "birth_time: " + time_unit_,
                                  "death_time: " + time_unit_, "radius: m", "points: m"});
        file_.close();
        file_.open("Piece", fmt::format(R"(NumberOfPoints="{}" NumberOfLines="{}")", radii_.size(), offsets_.size()));
        file_.open("PointData");
        file_.add(data_array<float>("radius", radii_));
        file_.close();
        file_.open("CellData");
        add_array("identity", [](const Row& row) { return row.life->identity; });
        add_array("organ", [](const Row& row) { return row.life->organ; });
        add_array("parent", [](const Row& row) { return row.life->parent; });
        add_array("plant", [](const Row& row) { return row.plant; });
        add_array("symbol", [](const Row& row) { return row.life->symbol; });
        add_array("birth", [](const Row& row) { return row.life->birth; });
        add_array("death", [this](const Row& row) { return death_of(*row.life); });
        add_array("birth_time", [this](const Row& row) { return row.life->birth * dt_; });
        add_array("death_time", [this](const Row& row) { return death_of(*row.life) * dt_; });
        add_array("alive", [](const Row& row) { return row.life->alive; });
        add_array("order", [](const Row& row) { return row.life->order; });
        add_array("colour", [](const Row& row) { return row.life->colour; });
        file_.close();
        file_.add_points(data_array<float>("Points", coordinates_, 3));
        file_.open("Lines");
        file_.add(data_array<std::int32_t>("connectivity", connectivity_));
        file_.add(data_array<std::int32_t>("offsets", offsets_));
        file_.write(path_);
    }

    // Measured. At the end lives become rows and arrays, and these become texts.
    RecordedMemory memory(int step, const ModuleString& string, const Interpretation& interpretation) const override {
        constexpr std::size_t of_life = 140, at_the_end = 260;
        const std::size_t born = internodes_born(step, string, interpretation.geometry.internodes);
        return {0, born * of_life, born * at_the_end};
    }

    void save(std::ostream& out) const override {
        put(out, last_step_);
        put(out, time_);
        put(out, dt_);
        put_text(out, time_unit_);
        put(out, static_cast<std::uint64_t>(plants_.size()));
        for (const auto& [plant, lives] : plants_) {
            put(out, plant);
            lives.save(out);
        }
    }

    void restore(std::istream& in) override {
        last_step_ = get<int>(in);
        time_ = get<double>(in);
        dt_ = get<double>(in);
        time_unit_ = get_text(in, 1 << 16);
        for (auto plants = get<std::uint64_t>(in); plants > 0; --plants) {
            const auto plant = get<std::uint32_t>(in);
            plants_[plant].restore(in);
        }
    }

private:
    struct Row {
        std::uint32_t plant;
        const InternodeLife* life;
    };

    int death_of(const InternodeLife& life) const { return life.alive ? last_step_ + 1 : life.death; }

    void gather() {
        std::size_t count = 0;
        for (const auto& [plant, lives] : plants_) count += lives.all().size();
        rows_.reserve(count);
        for (const auto& [plant, lives] : plants_) {
            for (const InternodeLife& life : lives.all()) rows_.push_back({plant, &life});
        }
    }

    // Two points an internode: neighbours may have been seen last at different steps.
    void fill_geometry() {
        coordinates_.reserve(6 * rows_.size());
        radii_.reserve(2 * rows_.size());
        connectivity_.reserve(2 * rows_.size());
        offsets_.reserve(rows_.size());
        for (const Row& row : rows_) {
            const InternodeLife& life = *row.life;
            for (const glm::vec3& point : {life.base, life.tip}) {
                connectivity_.push_back(static_cast<std::int32_t>(connectivity_.size()));
                for (int k = 0; k < 3; ++k) coordinates_.push_back(point[k]);
            }
            radii_.push_back(life.base_radius);
            radii_.push_back(life.tip_radius);
            offsets_.push_back(static_cast<std::int32_t>(connectivity_.size()));
        }
    }

    template <class Value>
    void add_array(const char* name, const Value& value) {
        using T = std::decay_t<decltype(value(rows_.front()))>;
        Column<std::byte>& bytes = columns_.emplace_back(rows_.size() * sizeof(T));
        T* values = reinterpret_cast<T*>(bytes.data());
        for (std::size_t i = 0; i < rows_.size(); ++i) values[i] = value(rows_[i]);
        file_.add(data_array<T>(name, std::span<const T>(values, rows_.size())));
    }

    std::filesystem::path path_;
    SymbolNumbers symbols_;
    std::map<std::uint32_t, InternodeLives> plants_;
    std::vector<Row> rows_;
    Column<float> coordinates_, radii_;
    Column<std::int32_t> connectivity_, offsets_;
    std::deque<Column<std::byte>> columns_;  ///< arrays of the cells, until the file is written
    VtkFile file_;
    int last_step_ = 0;
    double time_ = 0, dt_ = 1;
    std::string time_unit_;
};

const Registered<RecorderType> entry{
    {"lifespans", "lifespans.vtp: every internode once, with birth and death; written at the end",
     "lifespans  true; false: the file is not written",
     [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
         if (!settings.flag_or("lifespans", true)) return nullptr;
         return std::make_unique<Lifespans>(context);
     }}};

}  // namespace
}  // namespace espalier::timeline
