#include "analysis/field_profile.h"

#include "espalier/base/error.h"

#include "base/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace espalier::analysis {
namespace {

struct Summary {
    double count = 0, sum = 0, squares = 0;
    double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
};

/// Summarizes each layer across the axis. Squares are those of the distance from the layer's first value: this keeps
/// them exact where a field is nearly even.
std::vector<Summary> summaries(const RecordedField& field, int axis) {
    std::vector<Summary> layers(static_cast<std::size_t>(field.size[axis]));
    std::vector<double> first(layers.size(), std::numeric_limits<double>::quiet_NaN());
    glm::ivec3 at(0);
    for (at.z = 0; at.z < field.size.z; ++at.z) {
        for (at.y = 0; at.y < field.size.y; ++at.y) {
            for (at.x = 0; at.x < field.size.x; ++at.x) {
                const double value = field.at(at.x, at.y, at.z);
                const auto k = static_cast<std::size_t>(at[axis]);
                if (std::isnan(first[k])) first[k] = value;
                layers[k].count += 1;
                layers[k].sum += value - first[k];
                layers[k].squares += (value - first[k]) * (value - first[k]);
                layers[k].least = std::min(layers[k].least, value);
                layers[k].most = std::max(layers[k].most, value);
            }
        }
    }
    for (std::size_t k = 0; k < layers.size(); ++k) {
        Summary& layer = layers[k];
        layer.squares = std::max(layer.squares - layer.sum * layer.sum / layer.count, 0.0);
        layer.sum += first[k] * layer.count;
    }
    return layers;
}

/// The voxel's centre to a millionth of a voxel: decimal places without the rounding of sums.
double centre(double origin, double voxel, std::size_t index) {
    const double scale = std::pow(10.0, 6.0 - std::floor(std::log10(voxel)));
    return std::round((origin + voxel * static_cast<double>(index)) * scale) / scale;
}

}  // namespace

RecordedTable field_profile(const RecordedRun& run, std::span<const RecordedFrame* const> frames,
                            const std::string& field, const std::string& axis) {
    const std::vector<std::string> names = run.field_names();
    if (std::find(names.begin(), names.end(), field) == names.end()) {
        const std::string recorded =
            names.empty() ? "it recorded no fields" : "it has: " + fmt::format("{}", fmt::join(names, ", "));
        throw UserError(
            fmt::format("{} has no field '{}'{}; {}. A scene records fields by fields = [\"{}\"] under "
                        "[timeline]",
                        run.folder().string(), field, did_you_mean(field, names), recorded, field));
    }
    RecordedTable table{{"step", axis, "mean", "deviation", "minimum", "maximum"}, {}};
    const int number = axis == "x" ? 0 : axis == "y" ? 1 : 2;
    for (const RecordedFrame* frame : frames) {
        if (!frame->fields.contains(field)) continue;
        const RecordedField recorded = run.field(*frame, field);
        const std::vector<Summary> layers = summaries(recorded, number);
        for (std::size_t k = 0; k < layers.size(); ++k) {
            const Summary& layer = layers[k];
            table.rows.push_back({static_cast<double>(frame->step),
                                  centre(recorded.origin[number], recorded.voxel[number], k), layer.sum / layer.count,
                                  std::sqrt(layer.squares / layer.count), layer.least, layer.most});
        }
    }
    return table;
}

}  // namespace espalier::analysis
