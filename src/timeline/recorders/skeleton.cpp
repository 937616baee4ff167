// The plants of every frame: plants.pvd, and plants/NNNN.vtp with a line per axis; polygons, organs, generalized
// cylinders and patches; labels.
//
// Parameters: skeleton (true or false, default true); points_per_file (default 2^22): a frame of more is cut between
// plants, into plants/NNNN.vtp, plants/NNNN-1.vtp and so on; parameters (table of array name = "SYMBOL.NUMBER"): module
// parameters that become point arrays; a query's ("?E.1") also makes its queries vertices.
// Cell and point arrays: identity, organ (its number in the order of births), parent, plant, symbol (index into
// symbol_names), birth, order, colour, kind (0 query, 1 axis, 2 polygon, 3 organ, 4 generalized cylinder, 5 patch, 6
// label), and rgb where a plant has a palette; cell arrays besides: texture (index into texture_files) and back_colour;
// point arrays besides: Normals, TCoords, radius, the chosen parameters and quantities of organs, and pixels where a
// view file gives widths in pixels. Field data: the texts of the labels, in the order of their vertices; organ_units.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "base/folder.h"
#include "geometry/drawn/mesh_size.h"
#include "timeline/files/collection_file.h"
#include "timeline/files/vtk_file.h"
#include "timeline/frames/frame_cut.h"
#include "timeline/meshes/frame_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace espalier::timeline {
namespace {

// Bytes of the arrays and of the texts that they become. Measured, as the texts' bytes in files of 13 models rich in
// one kind of organ each: 28 a point, nearly all of them coordinates, which hardly compress; 5.4 a corner and a cell;
// up to 28 for the attributes of a run. An array that grows beyond its memory is there twice for a moment.
std::size_t bytes_to_write(const MeshSize& size, std::size_t parameters) {
    constexpr std::size_t of_owner = sizeof(Owner) + sizeof(std::uint32_t);
    constexpr std::size_t attributes = 46, texts_of_attributes = 36;
    constexpr std::size_t of_point = 36 + 28, of_corner = 4 + 6, of_cell = 4 + 6;
    const std::size_t of_point_run =
        of_owner + sizeof(std::uint32_t) + attributes + texts_of_attributes + parameters * (8 + 11);
    const std::size_t of_cell_run = 2 * of_owner + attributes + texts_of_attributes;
    const std::size_t largest = std::max(16 * size.points, 6 * size.corners);
    return size.points * of_point + size.corners * of_corner + size.cells * of_cell + size.point_runs * of_point_run +
           size.cell_runs * of_cell_run + largest;
}

class Skeleton final : public Recorder {
public:
    Skeleton(const Settings& settings, const RecorderContext& context)
        : folder_(context.folder),
          collection_(context.folder / "plants.pvd"),
          most_points_(
              static_cast<std::size_t>(settings.integer_or("points_per_file", 1 << 22, Range::between(1, 1e9)))),
          columns_(std::filesystem::path(settings.place().file).parent_path(), settings),
          compression_(context.compression),
          file_(compression_) {}

    std::size_t points_per_file() const override { return most_points_; }
    std::vector<std::string> organs() const override { return columns_.organs(); }

    void record(const Frame& frame) override {
        if (frame.begins) begin(frame);
        if (frame.piece) return record_piece(frame);
        if (frame.begins && frame.ends && points_of(frame.plants) <= most_points_) {
            write_piece(frame);
            return end();
        }
        const auto rest = [&] { return part_of(frame, std::exchange(waiting_, {})); };
        for (const PlantFrame& plant : frame.plants) {
            if (cut_.is_before(points_foreseen(plant.interpretation->geometry))) write_piece(rest());
            waiting_.push_back(plant);
        }
        if (!frame.ends) return;
        write_piece(rest());
        end();
    }

    void finish() override {
        columns_.release();
        file_ = VtkFile(compression_);
    }

    RecordedMemory memory(int, const ModuleString& string, const Interpretation& interpretation) const override {
        return {bytes_to_write(columns_.foreseen(interpretation), columns_.chosen()) +
                columns_.bytes_of_offsets(string)};
    }

    void save(std::ostream& out) const override {
        collection_.save(out);
        put_text(out, written_);
        put(out, static_cast<std::uint64_t>(columns_.texture_files().size()));
        for (const std::string& file : columns_.texture_files()) put_text(out, file);
        put(out, restored_ ? *restored_ : digest());
    }

    void restore(std::istream& in) override {
        collection_.restore(in);
        written_ = get_text(in, longest_name);
        std::vector<std::string> files;
        for (auto count = get<std::uint64_t>(in); count > 0; --count) files.push_back(get_text(in, longest_name));
        columns_.expect(std::move(files));
        restored_ = get<std::uint64_t>(in);
    }

private:
    static constexpr std::uint64_t longest_name = 1 << 16;

    // True if the last file shows what is there now.
    bool is_written() {
        const auto restored = std::exchange(restored_, std::nullopt);
        if (written_.empty()) return false;
        return restored ? digest() == *restored : !columns_.changed();
    }

    std::uint64_t digest() const {
        VtkFile file(compression_);
        file.begin("PolyData");
        columns_.put_into(file, 0, 0);
        return file.digest();
    }

    static std::size_t points_of(std::span<const PlantFrame> plants) {
        std::size_t points = 0;
        for (const PlantFrame& plant : plants) points += points_foreseen(plant.interpretation->geometry);
        return points;
    }

    static Frame part_of(const Frame& frame, std::vector<PlantFrame> plants) {
        Frame part{frame.step, frame.time, std::move(plants), frame.fields, frame.is_last, frame.environment};
        part.dt = frame.dt;
        part.time_unit = frame.time_unit;
        return part;
    }

    static std::string file_of(int step, int piece) {
        return piece == 0 ? fmt::format("plants/{:04}.vtp", step) : fmt::format("plants/{:04}-{}.vtp", step, piece);
    }

    void begin(const Frame& frame) {
        if (std::exchange(is_first_, false)) columns_.require_known(frame.models);
        columns_.expect(frame.models);
        cut_ = FrameCut(most_points_);
        piece_ = 0;
    }

    void end() {
        if (piece_ > 1) written_.clear();
        collection_.write();
    }

    // The pieces between those that come here are written by others.
    void record_piece(const Frame& frame) {
        for (; piece_ < *frame.piece; ++piece_) {
            collection_.add(frame.time, piece_, "plants", file_of(frame.step, piece_));
        }
        if (!frame.ends) return write_piece(frame);
        for (int piece = 1; piece < piece_; ++piece) require_file(folder_ / file_of(frame.step, piece));
        end();
    }

    static void require_file(const std::filesystem::path& path) {
        if (std::filesystem::exists(path)) return;
        throw RunError(fmt::format("{} is not there, though another rank wrote it: all must see the same output folder",
                                   path.string()));
    }

    // A frame that is one piece may be the same as the one before.
    void write_piece(const Frame& piece) {
        columns_.fill(piece);
        if (piece_ > 0 || !is_written()) write(piece);
        collection_.add(piece.time, piece_, "plants", written_);
        ++piece_;
    }

    void write(const Frame& frame) {
        const std::string before = std::exchange(written_, {});  // in case something throws
        before.empty() ? file_.begin("PolyData") : file_.begin_after("PolyData");
        columns_.put_into(file_, frame.time, frame.step);
        const std::string name = file_of(frame.step, piece_);
        make_folder_below(folder_, "plants");
        file_.write(folder_ / name);
        written_ = name;
    }

    std::filesystem::path folder_;
    CollectionFile collection_;
    std::size_t most_points_;                ///< of a file
    FrameColumns columns_;                   ///< what the last file shows
    std::optional<std::uint64_t> restored_;  ///< what a checkpoint holds of the last file
    /// The file of the frame before, relative to the folder; empty if there is none, or several.
    std::string written_;
    bool is_first_ = true;
    FrameCut cut_{most_points_};
    std::vector<PlantFrame> waiting_;  ///< of the piece to come
    int piece_ = 0;                    ///< pieces of the frame so far
    Compression compression_;
    VtkFile file_;
};

const Registered<RecorderType> entry{
    {"skeleton", "plants.pvd and plants/NNNN.vtp: a line per axis, organs and surfaces, with identities",
     "skeleton    true; false: the files are not written\n"
     "parameters  {}; arrays from module parameters, as in { vigour = \"F.2\", light = \"?E.1\" }: the 2nd parameter\n"
     "            of F, and the 1st of ?E after its answer, whose queries become points\n"
     "organs      []; arrays of what a process knows of each organ, as in [\"light.absorbed\", \"light.sunlit\"]; the\n"
     "            help of the process names them, organ_units in the files has their units\n"
     "points_per_file  4194304; a frame of more points is cut between plants, into plants/NNNN.vtp, plants/NNNN-1.vtp, "
     "...",
     [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
         auto recorder = std::make_unique<Skeleton>(settings, context);
         if (!settings.flag_or("skeleton", true)) return nullptr;
         return recorder;
     }}};

}  // namespace
}  // namespace espalier::timeline
