#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Describes a drawn picture. Everything random about a picture follows from its scene, so the same
/// scene gives the same picture.
namespace repose::testing {

/// sRGB, 0 to 1.
struct Color {
  double r = 0;
  double g = 0;
  double b = 0;
};

enum class Shape {
  heap,
  half_heap,  ///< one flank, against a wall or the frame
  nothing,
  column,   ///< block with vertical faces
  ball,     ///< one large sphere
  oblique,  ///< heap seen from above
  layer,    ///< level layer through the whole frame
};

enum class Side { none, left, right };
enum class Flanks { straight, power, exponential };  ///< see FlankLaw
enum class Texture { none, noise, fabric, wood };
enum class Style { photo, silhouette };
enum class Tube { none, steel, acrylic };

/// The heap's geometry. Lengths are fractions, so that a scene can be drawn at any size.
struct HeapForm {
  Shape shape = Shape::heap;
  double left_rad = 0.45;  ///< of the line from toe to apex; for a straight flank, its angle
  double right_rad = 0.45;
  Flanks flanks = Flanks::straight;
  double hollow = 1;           ///< see FlankLaw
  double base = 0.6;           ///< width of the base / width of the picture
  double center = 0.5;         ///< middle of the base / width of the picture
  double grains_high = 30;     ///< height of the heap / mean grain diameter
  double roughness = 1;        ///< of the outline, 0 (grains touch the line) to 1
  double crest = 0.18;         ///< fraction of the uncut cone's height that is rounded off
  double toe_height = 0;       ///< concave toe begins here / height; 0 is a straight toe
  double toe_runout = 0;       ///< how far the concave toe runs out / half base
  double apron = 0;            ///< length of the thin layer beyond each toe / half base
  double toe_sink = 0.1;       ///< how far the ground's edge may hide a toe grain / its radius
  Side wall = Side::none;      ///< half heap: where the wall stands
  bool wall_is_frame = false;  ///< half heap: the wall is the picture's edge
  Side cut = Side::none;       ///< which flank leaves the frame
  double cut_height = 0.5;     ///< ... at this height / height
  double elevation_rad = 0;    ///< oblique: camera above the horizontal
  int strays = 0;              ///< grains lying on the ground beside the heap
};

struct GrainLook {
  Color color = {0.6, 0.4, 0.22};
  double brightness_spread = 0.14;
  double hue_spread = 0.03;
  double size_spread = 0.2;
  double elongation = 1.25;  ///< largest ratio of the axes
  double gloss = 0.15;
  bool pale_spot = false;  ///< a nut's base
};

struct Surroundings {
  Color backdrop = {0.75, 0.75, 0.76};
  Color plate = {0.65, 0.66, 0.68};
  Color table = {0.3, 0.3, 0.32};
  double ground = 0.8;        ///< ground line, from the top / height of the picture
  double plate_thick = 0.04;  ///< / height of the picture
  Texture texture = Texture::none;
  double texture_strength = 0;  ///< standard deviation / brightness
  double texture_scale = 1;     ///< finest scale / grain diameter
  Side shadow = Side::none;
  double shadow_strength = 0;
  double reflection = 0;  ///< brightness of the mirror image / brightness of the heap
  Tube tube = Tube::none;
  double tube_gap = 0.5;    ///< above the crest / height of the heap
  double tube_width = 0.3;  ///< / width of the base
  Side ruler = Side::none;
};

struct Camera {
  double tilt_rad = 0;        ///< roll: > 0 lowers the right end of the ground
  double exposure = 1;        ///< factor on the light
  double gradient = 0.1;      ///< relative change of the light over half the diagonal
  double gradient_rad = 0.5;  ///< its direction
  double vignette = 0.08;     ///< loss of light in the corners
  double blur_px = 0.55;      ///< standard deviation of the point spread
  double noise = 0.006;       ///< sensor noise, standard deviation at full light / full light
  int jpeg_quality = 0;       ///< 0: not compressed
};

struct HeapScene {
  std::string condition;
  std::uint64_t seed = 1;
  int width = 1200;
  int height = 800;
  Style style = Style::photo;
  HeapForm form;
  GrainLook grain;
  Surroundings around;
  Camera camera;
};

}  // namespace repose::testing
