#pragma once

#include <string>
#include <vector>

#include <opencv2/core/types.hpp>

#include "tests/support/heap_paint.h"
#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"
#include "tests/support/paint_pattern.h"

namespace repose::testing {

/// In picture widths, from the top left corner to the right and down.
using Place = cv::Point2d;
using Places = std::vector<Place>;

/// How the light falls off over a painted shape.
enum class Shading {
  slope,     ///< evenly in one direction
  ball,      ///< as on a ball that fills the shape's bounding box
  cylinder,  ///< as on an upright cylinder that fills it
};

struct Paint {
  Color color;
  Shading shading = Shading::slope;
  double contrast = 0.2;     ///< of the shading: 0 is flat
  double towards_rad = 0.8;  ///< direction in which a slope becomes lighter
  Pattern pattern = Pattern::plain;
  double pattern_strength = 0.2;
  double pattern_scale = 0.012;  ///< in picture widths
  double opacity = 1;
};

/// A stage to paint any picture on, in fractions of the picture's width.
class Canvas {
 public:
  /// Takes its size and roll from the scene.
  Canvas(const HeapScene& scene, Random& random);

  double height() const { return height_; }  ///< of the picture
  const Stage& stage() const { return stage_; }

  void fill(const Places& polygon, const Paint& paint);
  void stroke(const Places& line, double width, const Paint& paint);
  /// Writes the text with its lower left corner at `at`, `size` high.
  void write(const std::string& text, Place at, double size, int font, const Paint& paint);
  /// Shadow with a soft edge.
  void darken(const Places& polygon, double strength, double softness);

 private:
  cv::Point fine(Place place, cv::Point corner) const;
  cv::Rect box_of(const Places& places, double more) const;
  void blend(const cv::Mat& mask, cv::Rect box, const Paint& paint);

  Stage stage_;
  double width_px_ = 0;
  double height_ = 0;
  Random random_;
};

/// Rectangle from its upper left to its lower right corner.
Places rectangle(Place from, Place to);
Places ellipse(Place middle, double half_width, double half_height, double turn_rad = 0);
/// The polygon with rounded corners.
Places rounded(Places polygon, int rounds = 4);
Places moved(Places places, Place by);
/// Rotated about a place; > 0 is clockwise in the picture.
Places turned(Places places, Place round, double angle_rad);

}  // namespace repose::testing
