#include "picture/stage/field_props.h"

#include "espalier/base/error.h"

#include "picture/stage/textured_plane.h"

#include <fmt/format.h>
#include <vtkActor.h>
#include <vtkAutoInit.h>
#include <vtkColorTransferFunction.h>
#include <vtkContourFilter.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkSmartVolumeMapper.h>
#include <vtkUnsignedCharArray.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cmath>

// Chosen at run time, so it must be named.
VTK_MODULE_INIT(vtkRenderingVolumeOpenGL2);

namespace espalier::picture {
namespace {

constexpr int colour_steps = 64;

vtkSmartPointer<vtkImageData> image_of(const RecordedField& field) {
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(field.size.x, field.size.y, field.size.z);
    image->SetOrigin(field.origin.x, field.origin.y, field.origin.z);
    image->SetSpacing(field.voxel.x, field.voxel.y, field.voxel.z);
    vtkNew<vtkFloatArray> values;
    values->SetNumberOfTuples(static_cast<vtkIdType>(field.values.size()));
    std::copy(field.values.begin(), field.values.end(), values->GetPointer(0));
    image->GetPointData()->SetScalars(values);
    return image;
}

double share_of(double value, const std::array<double, 2>& range) {
    return range[1] > range[0] ? std::clamp((value - range[0]) / (range[1] - range[0]), 0.0, 1.0) : 0.5;
}

double median_of(const RecordedField& field) {
    std::vector<float> values;
    std::copy_if(field.values.begin(), field.values.end(), std::back_inserter(values),
                 [](float value) { return std::isfinite(value); });
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// What most of the field holds is clear; the further a value is from that, the denser the cloud.
vtkSmartPointer<vtkProp3D> cloud(const RecordedField& field, const std::array<double, 2>& range,
                                 std::span<const Rgb> colours) {
    const double usual = median_of(field);
    const double most = std::max({range[1] - usual, usual - range[0], 1e-30});
    vtkNew<vtkColorTransferFunction> colour;
    vtkNew<vtkPiecewiseFunction> opacity;
    for (int i = 0; i <= colour_steps; ++i) {
        const double place = double(i) / colour_steps, value = range[0] + place * (range[1] - range[0]);
        const Rgb rgb = along(colours, place);
        colour->AddRGBPoint(value, rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
        opacity->AddPoint(value, 0.8 * std::min(1.0, std::abs(value - usual) / most));
    }
    const glm::dvec3 size = field.voxel * glm::dvec3(field.size);
    vtkNew<vtkSmartVolumeMapper> mapper;
    mapper->SetInputData(image_of(field));
    mapper->SetRequestedRenderModeToRayCast();
    mapper->SetAutoAdjustSampleDistances(0);
    mapper->SetSampleDistance(static_cast<float>(0.5 * std::min({field.voxel.x, field.voxel.y, field.voxel.z})));
    const auto volume = vtkSmartPointer<vtkVolume>::New();
    volume->SetMapper(mapper);
    vtkVolumeProperty& property = *volume->GetProperty();
    property.SetColor(colour);
    property.SetScalarOpacity(opacity);
    property.SetScalarOpacityUnitDistance(std::max({size.x, size.y, size.z}) / 6);
    property.SetInterpolationTypeToLinear();
    property.ShadeOff();
    return volume;
}

int index_of(char axis) {
    return axis - 'x';
}

double place_of(const RecordedField& field, const FieldLook& look, const glm::dvec3& middle) {
    const int k = index_of(look.axis);
    if (look.place) return *look.place;
    const double low = field.origin[k], high = low + field.voxel[k] * (field.size[k] - 1);
    return std::clamp(middle[k], low, high);
}

/// A plane of the field as a picture: a texel per voxel.
vtkSmartPointer<vtkImageData> plane_image(const RecordedField& field, const std::array<int, 3>& axes, double place,
                                          const std::array<double, 2>& range, std::span<const Rgb> colours) {
    const auto [across, over, through] = axes;
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->SetDimensions(field.size[across], field.size[over], 1);
    image->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
    auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
    for (int y = 0; y < field.size[over]; ++y) {
        for (int x = 0; x < field.size[across]; ++x, pixel += 4) {
            glm::dvec3 point;
            point[across] = field.origin[across] + x * field.voxel[across];
            point[over] = field.origin[over] + y * field.voxel[over];
            point[through] = place;
            const double value = sampled(field, point);
            const Rgb rgb = along(colours, share_of(value, range));
            std::copy(rgb.begin(), rgb.end(), pixel);
            pixel[3] = std::isfinite(value) ? 225 : 0;
        }
    }
    return image;
}

vtkSmartPointer<vtkProp3D> plane(const RecordedField& field, char axis, double place,
                                 const std::array<double, 2>& range, std::span<const Rgb> colours) {
    const int through = index_of(axis);
    const std::array<int, 3> axes{(through + 1) % 3, (through + 2) % 3, through};
    glm::dvec3 corner = field.origin - 0.5 * field.voxel;
    corner[through] = place;
    glm::dvec3 right = corner, up = corner;
    right[axes[0]] += field.voxel[axes[0]] * field.size[axes[0]];
    up[axes[1]] += field.voxel[axes[1]] * field.size[axes[1]];
    return textured_plane(corner, right, up, *plane_image(field, axes, place, range, colours));
}

vtkSmartPointer<vtkProp3D> surface(const RecordedField& field, double level, const Rgb& rgb) {
    vtkNew<vtkContourFilter> contour;
    contour->SetInputData(image_of(field));
    contour->SetValue(0, level);
    contour->ComputeNormalsOn();
    contour->ComputeScalarsOff();
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(contour->GetOutputPort());
    mapper->ScalarVisibilityOff();
    const auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    vtkProperty& property = *actor->GetProperty();
    property.SetColor(rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    property.SetOpacity(std::min({field.size.x, field.size.y, field.size.z}) > 1 ? 0.35 : 1.0);
    property.SetLineWidth(2);
    return actor;
}

}  // namespace

void check_field(const RecordedRun& run, const FieldLook& look) {
    if (run.frames().empty()) return;
    const auto recorded = [&](const RecordedFrame& frame) { return frame.fields.contains(look.name); };
    const bool found = std::any_of(run.frames().begin(), run.frames().end(), recorded);
    if (!found) (void)run.field(run.frames().back(), look.name);  // which says what there is
}

FieldProp field_prop(const RecordedField& field, const FieldLook& look, const std::array<double, 2>& range,
                     const glm::dvec3& middle, std::span<const Rgb> colours) {
    ColourKey key{with_unit(field.name, field.unit), range, colours, {}};
    if (look.kind == FieldLook::Kind::surface) {
        const double level = look.level.value_or((range[0] + range[1]) / 2);
        const Rgb rgb = along(colours, 0.7);
        return {surface(field, level, rgb), {"", range, {}, {{fmt::format("{} = {:.4g}", key.title, level), rgb}}}};
    }
    const int flat = field.size.x == 1 ? 0 : field.size.y == 1 ? 1 : field.size.z == 1 ? 2 : -1;
    if (flat >= 0) return {plane(field, static_cast<char>('x' + flat), field.origin[flat], range, colours), key};
    if (look.kind == FieldLook::Kind::volume) return {cloud(field, range, colours), key};
    const double place = place_of(field, look, middle);
    const int k = index_of(look.axis);
    const double low = field.origin[k] - 0.5 * field.voxel[k], high = low + field.size[k] * field.voxel[k];
    if (place < low || place > high) {
        throw UserError(
            fmt::format("the plane {} = {:.4g} does not meet the field '{}', which reaches from {:.4g} to {:.4g}",
                        look.axis, place, field.name, low, high));
    }
    return {plane(field, look.axis, place, range, colours), key};
}

}  // namespace espalier::picture
