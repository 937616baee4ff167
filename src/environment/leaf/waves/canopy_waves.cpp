#include "environment/leaf/waves/canopy_waves.h"

#include "environment/leaf/gas/air.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace espalier::environment::leaf {
namespace {

constexpr std::uint32_t no_plant = ~0U;
constexpr double bytes_of_voxel = 80, bytes_of_piece = 2 * sizeof(LeafPiece) + 120;

CanopyScattering::Options read_directions(const Settings& table) {
    CanopyScattering::Options options;
    options.beams = 1;  // as scattered light has them, so that what is sent and what is met balance beam by beam
    options.clumping = table.number_or("clumping", 1, Range{0, 1, true});
    options.rings = table.integer_or("rings", 3, Range::between(1, 8));
    options.around = table.integer_or("around", 6, Range::between(3, 360));
    return options;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

double WaveLedger::closure() const {
    const double sent = from_plants + from_soil + from_sky;
    return sent > 0 ? (to_plants + to_soil + to_sky) / sent - 1 : 0;
}

CanopyWaves::CanopyWaves(const Settings& table, const EnvironmentContext& context)
    : space_(table, context.domain, 0.2),
      options_(read_directions(table)),
      soil_emissivity_(table.number_or("soil_emissivity", 0.95, Range::between(0, 1))),
      stems_(table.flag_or("stems", true)),
      memory_(context.memory),
      optics_(Settings{}),
      angles_("spherical") {
    if (table.has("sky")) sky_ = table.number("sky", Range::between(0, 2000));
}

void CanopyWaves::lay(const WorldView& world, std::span<const PlantLeaves> leaves) {
    leaves_.clear();
    for (const PlantView& plant : world.plants) {
        leaves_.add(plant.plant, plant.drawn(), space_.edge(), optics_, stems_,
                    [&](const ForeseenPieces& all) { require_memory(space_.over(all.box), all.count); });
    }
    Box box = leaves_.bounds();
    if (box.empty()) box.add(glm::dvec3(0));
    const CanopySpace::Extent extent = space_.over(box);
    require_memory(extent, static_cast<double>(leaves_.pieces().size()));
    voxels_ = space_.voxels(extent);
    leaves_.sort_into(voxels_);
    scattering_ = std::make_unique<CanopyScattering>(voxels_, leaves_.pieces(), optics_, angles_,
                                                     std::span<const char>(), options_);
    std::vector<LightBeam> sky;
    for (const SkyPart& part : sky_parts(options_.rings, options_.around)) {
        sky.push_back({part.towards, part.solid_angle / std::numbers::pi, false});
    }
    of_sky_ = scattering_->first(sky);
    find_rows(leaves);
    front_.assign(leaves_.pieces().size(), 0);
    back_ = front_;
    ground_.assign(voxels_.ground_count(), 0);
}

void CanopyWaves::find_rows(std::span<const PlantLeaves> leaves) {
    rows_.clear();
    for (const LeafPiece& piece : leaves_.pieces().pieces) {
        LeafRow row{no_plant, 0};
        if (piece.kind == LitKind::leaf && piece.plant < leaves.size()) {
            const std::size_t found = leaves[piece.plant].row_of(piece.module);
            if (found < leaves[piece.plant].size()) row = {piece.plant, static_cast<std::uint32_t>(found)};
        }
        rows_.push_back(row);
    }
}

void CanopyWaves::require_memory(const CanopySpace::Extent& extent, double pieces) const {
    const double voxels = extent.count(), bytes = voxels * bytes_of_voxel + pieces * bytes_of_piece;
    if (voxels < 2e9 && bytes <= static_cast<double>(memory_)) return;
    throw RunError(
        fmt::format("{}: long waves would have {:.3g} voxels and {:.3g} pieces of leaves and stems, and take "
                    "{:.3g} GB: use larger voxels or more memory",
                    to_string(space_.edge_place()), voxels, pieces, bytes / 1e9));
}

CanopyScattering::Emission CanopyWaves::emission(std::span<const PlantLeaves> leaves, const WavesAround& around) {
    CanopyScattering::Emission all;
    const double reflected = 1 - around.leaf_emissivity;
    const double of_stems = around.leaf_emissivity * black_body(around.air);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const auto [plant, row] = rows_[i];
        const double own = scattering_->side(i) * (plant == no_plant ? of_stems : leaves[plant].sent[row] / 2);
        ledger_.from_plants += 2 * own;
        all.front.push_back(own + reflected * front_[i]);
        all.back.push_back(own + reflected * back_[i]);
    }
    const double of_soil = soil_emissivity_ * black_body(around.soil);
    for (const double met : ground_) all.ground.push_back(of_soil + (1 - soil_emissivity_) * met);
    ledger_.from_soil = voxels_.edge * voxels_.edge * of_soil * static_cast<double>(ground_.size());
    if (!voxels_.periodic) all.outside = of_soil + (1 - soil_emissivity_) * around.sky;
    all.sum = sum_of(all.front) + sum_of(all.back) + voxels_.edge * voxels_.edge * sum_of(all.ground);
    return all;
}

double CanopyWaves::exchange(std::span<PlantLeaves> leaves, const WavesAround& around) {
    ledger_ = {};
    const CanopyScattering::Emission sent = emission(leaves, around);
    CanopyFlux flux = scattering_->spread(sent);
    const double square = voxels_.edge * voxels_.edge;
    ledger_.from_sky = around.sky * of_sky_.entered + flux.entered - square * sum_of(sent.ground);
    ledger_.to_sky = around.sky * of_sky_.escaped + flux.escaped;
    flux.add(of_sky_, around.sky);
    front_ = std::move(flux.front);
    back_ = std::move(flux.back);
    ground_ = std::move(flux.ground);
    ledger_.to_soil = soil_emissivity_ * square * sum_of(ground_);
    ledger_.to_plants = around.leaf_emissivity * (sum_of(front_) + sum_of(back_));

    std::vector<std::vector<double>> met(leaves.size()), sides(leaves.size());
    for (std::size_t p = 0; p < leaves.size(); ++p) {
        met[p].assign(leaves[p].size(), 0);
        sides[p] = met[p];
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const auto [plant, row] = rows_[i];
        if (plant == no_plant) continue;
        met[plant][row] += front_[i] + back_[i];
        sides[plant][row] += scattering_->side(i);
    }
    double change = 0;
    for (std::size_t p = 0; p < leaves.size(); ++p) {
        for (std::size_t row = 0; row < leaves[p].size(); ++row) {
            if (!(sides[p][row] > 0)) continue;  // it is not drawn, and keeps what it had
            const double thermal = met[p][row] / sides[p][row];
            change = std::max(change, std::abs(thermal / leaves[p].thermal[row] - 1));
            leaves[p].thermal[row] = thermal;
        }
    }
    return change;
}

const std::string& canopy_waves_help() {
    static const std::string text =
        R"(long_waves     none: each leaf sees the open sky above it, and below it a ground as warm as the air. A table: sky, leaves, stems and
               soil send long waves to each other along beams through voxels, as in canopy-light, each as warm as it is (stems as
               the air). Its keys: voxel = 0.2 m, ground = 0 m, periodic = false, stems = true, clumping = 1, rings = 3 and around = 6
               directions, as canopy-light has them; soil_emissivity = 0.95; sky, W m-2 on open level ground, in place of that
               of the air (Brutsaert 1975) and `cloud`
soil_temperature  that of the air; degrees Celsius, with long_waves
)";
    return text;
}

}  // namespace espalier::environment::leaf
