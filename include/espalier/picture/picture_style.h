// How a frame of a run is drawn: colours, fields, ground, light and background.
#pragma once

#include "espalier/archive/mesh_options.h"
#include "espalier/base/stations.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace espalier::picture {

/// A field as a cloud whose density follows its values, as colours on a plane, or as the surface of one value.
struct FieldLook {
    enum class Kind { volume, slice, surface };

    std::string name;
    Kind kind = Kind::volume;
    char axis = 'z';              ///< a slice's normal
    std::optional<double> place;  ///< metres along `axis`; none: through the middle of the plants
    std::optional<double> level;  ///< level of a surface; none: halfway between the field's extremes
};

struct PictureBackground {
    std::array<std::uint8_t, 3> rgb{255, 255, 255};
    bool transparent = false;

    bool is_dark() const { return 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2] < 110; }
};

inline constexpr PictureBackground light_background{{255, 255, 255}, false}, dark_background{{24, 26, 30}, false};

/// Sun and sky of a picture that light paths make.
struct PictureSky {
    /// clear: Preetham, Shirley & Smits 1999, with a sun; overcast: Moon & Spencer 1942; uniform: the same everywhere.
    enum class Kind : std::uint8_t { clear, overcast, uniform };

    Kind kind = Kind::clear;
    double turbidity = 2.2;         ///< haze of the air: 2 is very clear, 8 hazy
    std::optional<double> diffuse;  ///< share of the sky in the light on level ground; none: as the kind has it
    std::optional<std::array<double, 2>> sun;  ///< its azimuth and elevation, degrees; none: those of the style
};

/// How light paths make a picture, instead of a graphics card.
struct PictureLight {
    PictureSky sky;
    int samples = 64;  ///< paths of a pixel; at most, if there is a `noise`
    double noise = 0;  ///< a pixel is done when its standard error is less, as a share of white; 0: after all samples
    double stops = 0;  ///< brightness, in powers of two
    bool shows_sky = true;  ///< or the style's background
};

struct PictureStyle {
    /// "natural": the model's colours and textures; else an array of the plants (birth, age, order, plant, symbol,
    /// kind, colour, identity, radius, height, a chosen parameter), or a recorded field, sampled at the organs
    /// ("light"; "field.light" where a parameter bears that name too).
    std::string colour_by = "natural";
    std::optional<std::array<double, 2>> range;  ///< range of `colour_by`; none: what the surveyed frames hold
    std::optional<std::uint32_t> plant;          ///< this one alone, by its number; none: all
    std::vector<FieldLook> fields;
    PictureBackground background = light_background;
    bool ground =
        false;  ///< at height 0: a disc through which roots are seen; in the light of a sky, up to the horizon
    bool shading = true;  ///< shadows and what hides in corners; false: lit surfaces only
    bool textures = true;
    std::string bark;        ///< the texture of axes that wear none: a file; "": none
    archive::AxisSkin skin;  ///< how axes are skinned
    bool legend = true;      ///< colour bars of arrays and fields
    bool scale_bar = false;
    bool time_label = false;
    bool time_beneath = false;  ///< the time in the middle of the lower edge
    std::string title;
    double sun_azimuth = -20, sun_elevation = 50;  ///< degrees, as a camera's place
    std::optional<PictureLight> light;             ///< draws by light paths; fields are left out
    int triangles = 3'000'000;  ///< most triangles of axes, about: they have fewer sides where there are many
};

/// From where a camera looks at the middle of what it frames.
struct CameraPlace {
    double azimuth = 30, elevation = 12;              ///< degrees; azimuth 0 looks against z, elevation 90 from above
    double zoom = 1;                                  ///< 1: everything fits
    double twist = 0;                                 ///< degrees that the camera is turned about where it looks
    std::optional<double> view_angle = std::nullopt;  ///< degrees from the lower edge to the upper; none: 24
    bool is_parallel = false;                         ///< without perspective
    bool front_if_flat = true;                        ///< what lies in a plane across z is seen from the front
    bool turns = false;                               ///< everything fits from every azimuth, at one distance
};

}  // namespace espalier::picture
