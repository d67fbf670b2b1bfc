#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

/// The appearance of a picture.
namespace repose::render {

/// What is drawn of a grain.
enum class Shown {
  mesh,     ///< its surface, or its spheres if it has none
  spheres,  ///< its contact geometry
  both,
};

/// Black grains on white, no shades between: the kind of picture that papers measure.
struct SilhouetteStyle {
  Shown shown = Shown::mesh;
  /// Draws the ground as a grey bar below the ground line, over the whole width.
  bool shows_ground = false;
};

/// Red, green, blue (sRGB), 0 to 1.
using Colour = std::array<double, 3>;

inline constexpr int kMaxPasses = 1000;

/// Like a laboratory photograph: soft light from the upper left and from all around, shadows, a
/// plate on a table in front of a backdrop, a lens with limited depth of field, sensor noise.
struct PhotoStyle {
  Shown shown = Shown::mesh;
  Colour grain = {0.56, 0.38, 0.24};
  Colour spot = {0.72, 0.60, 0.45};  ///< at a grain's blunt end
  double brightness_spread = 0.12;   ///< between grains, standard deviation / brightness
  double pattern = 1;                ///< strength of stripes and spot; 0: plain grains
  double gloss = 0.35;               ///< 0 matt, 1 polished
  Colour plate = {0.62, 0.64, 0.66};
  Colour table = {0.33, 0.34, 0.36};
  Colour backdrop = {0.80, 0.82, 0.84};
  double key_softness_rad = 0.22;  ///< half the lamp's angular size; smaller: harder shadows
  double key_fraction = 0.62;      ///< of the light; the rest comes from all around
  double aperture_mm = 6;          ///< of the lens; 0: everything is sharp
  double blur_px = 0.6;            ///< of lens and sensor, standard deviation
  double noise = 0.008;            ///< standard deviation at full light / full light
  double vignette = 0.10;          ///< light lost in the corners
  int passes = 24;                 ///< averaged, at most kMaxPasses; more: smoother shadows
  std::uint64_t seed = 1;          ///< of grains' appearance, textures and noise
  std::uint64_t frame = 0;         ///< number in a film: each has different noise
};

/// The default photo style; if a colour is given, grains have it without stripes and spot.
inline PhotoStyle photo_of_grains(const std::optional<Colour>& colour) {
  PhotoStyle style;
  if (!colour) return style;
  style.grain = style.spot = *colour;
  style.pattern = 0;
  return style;
}

using Style = std::variant<SilhouetteStyle, PhotoStyle>;

}  // namespace repose::render
