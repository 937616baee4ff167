// What stands around the plants in pictures, from the background scenes of their view files: background.vtp.
//
// Parameters: background (true or false, default true). Cell arrays: rgb and opacity; point array: Normals.
#include "espalier/timeline/recorder.h"

#include "base/bytes.h"
#include "timeline/files/vtk_file.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace espalier::timeline {
namespace {

/// The triangles of all scenes, as arrays.
struct BackgroundArrays {
    Column<float> points, normals, opacities;
    Column<std::int32_t> corners, ends;
    Column<std::uint8_t> rgb;

    void add(const Background& background) {
        const auto origin = static_cast<std::int32_t>(points.size() / 3);
        for (const SurfaceVertex& vertex : background.vertices) {
            for (int k = 0; k < 3; ++k) {
                points.push_back(static_cast<float>(vertex.position[k]));
                normals.push_back(static_cast<float>(vertex.normal[k]));
            }
        }
        for (const Background::Piece& piece : background.pieces) add(background, piece, origin);
    }

private:
    void add(const Background& background, const Background::Piece& piece, std::int32_t origin) {
        constexpr double most = 255;
        const glm::dvec4 colour = glm::clamp(piece.material.diffuse + piece.material.emissive, 0.0, 1.0);
        for (std::uint32_t i = 0; i < piece.count; ++i) {
            corners.push_back(origin + static_cast<std::int32_t>(background.triangles[piece.first + i]));
            if (i % 3 != 2) continue;
            ends.push_back(static_cast<std::int32_t>(corners.size()));
            for (int k = 0; k < 3; ++k) rgb.push_back(static_cast<std::uint8_t>(std::lround(most * colour[k])));
            opacities.push_back(static_cast<float>(piece.material.diffuse.a));
        }
    }
};

class BackgroundScene final : public Recorder {
public:
    explicit BackgroundScene(const RecorderContext& context)
        : path_(context.folder / "background.vtp"), compression_(context.compression) {}

    bool reads_plants() const override { return false; }

    void record(const Frame& frame) override {
        if (is_written_) return;
        for (const PlantFrame& plant : frame.plants) {
            if (plant.background && seen_.insert(plant.background).second) arrays_.add(*plant.background);
        }
        if (!frame.ends) return;
        is_written_ = true;
        if (!arrays_.ends.empty()) write(std::exchange(arrays_, {}));
    }

    void finish() override {}

    void save(std::ostream& out) const override { put(out, static_cast<std::uint8_t>(is_written_)); }
    void restore(std::istream& in) override { is_written_ = get<std::uint8_t>(in) != 0; }

private:
    void write(const BackgroundArrays& arrays) {
        VtkFile file(compression_);
        file.begin("PolyData");
        file.open("PolyData");
        file.open("Piece", fmt::format(R"(NumberOfPoints="{}" NumberOfPolys="{}")", arrays.points.size() / 3,
                                       arrays.ends.size()));
        file.open("PointData", R"(Normals="Normals")");
        file.add(data_array<float>("Normals", arrays.normals, 3));
        file.close();
        file.open("CellData");
        file.add(data_array<std::uint8_t>("rgb", arrays.rgb, 3));
        file.add(data_array<float>("opacity", arrays.opacities));
        file.close();
        file.add_points(data_array<float>("Points", arrays.points, 3));
        file.open("Polys");
        file.add(data_array<std::int32_t>("connectivity", arrays.corners));
        file.add(data_array<std::int32_t>("offsets", arrays.ends));
        file.write(path_);
    }

    std::filesystem::path path_;
    Compression compression_;
    std::set<const Background*> seen_;
    BackgroundArrays arrays_;
    bool is_written_ = false;
};

const Registered<RecorderType> entry{
    {"background", "background.vtp: what stands around the plants, where their view files name background scenes",
     "background  true; false: the file is not written",
     [](Settings& settings, const RecorderContext& context) -> std::unique_ptr<Recorder> {
         if (!settings.flag_or("background", true)) return nullptr;
         return std::make_unique<BackgroundScene>(context);
     }}};

}  // namespace
}  // namespace espalier::timeline
