#include "calibrate/experiment/draw_down_front.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "base/input_error.h"
#include "base/units.h"
#include "dem/experiment/model_setup.h"
#include "render/renderer.h"
#include "vision/measure/outline_angle.h"

namespace repose::calibrate {
namespace {

constexpr int kLongest_px = 2400;
constexpr double kMargin_m = .002;

double degrees(double angle_rad) { return angle_rad * 180 / std::numbers::pi; }

std::optional<double> mean_deg(const std::optional<vision::OutlineFlank>& left,
                               const std::optional<vision::OutlineFlank>& right) {
  const auto angle_rad = vision::OutlineAngle{.left = left, .right = right}.angle_rad();
  return angle_rad ? std::optional(degrees(*angle_rad)) : std::nullopt;
}

/// A picture of both boxes from the front, and the positions of their parts in it.
class Front {
 public:
  Front(render::Scene scene, const dem::BoxesFront& boxes)
      : boxes_(boxes), width_m_(boxes.length_m + 2 * kMargin_m) {
    const double grain_m = dem::diameter_m(scene.shapes.front());
    // Grains levelled at the top protrude from the fill by at most half their length.
    height_m_ = boxes.upper_floor_m + boxes.fill_m + grain_m + 2 * kMargin_m;
    constexpr double kGrain_px = 40;  // more per grain add nothing
    m_per_px_ = std::max(grain_m / kGrain_px, std::max(width_m_, height_m_) / kLongest_px);
    const render::PictureSize size{.width = pixels(width_m_), .height = pixels(height_m_)};
    const render::OrthographicCamera camera{
        .azimuth_rad = 0,
        .mm_per_px = 1e3 * m_per_px_,
        .middle_m = dem::Vector(0, 0, height_m_ / 2 - kMargin_m)};
    scene.walls.clear();  // only grains
    picture_ = render::Renderer().draw(scene, camera, size, render::SilhouetteStyle{}).picture;
  }

  vision::Picture& picture() { return picture_; }

  /// Measures the section between two positions along the boxes, above a floor.
  vision::OutlineAngle angle_between(double from_m, double to_m, double floor_m, double top_m) {
    const int left = column_of(from_m), right = column_of(to_m);
    const int top = static_cast<int>(std::max(0.0, std::ceil(row_of(top_m))));
    const int bottom = std::min(picture_.height, static_cast<int>(std::ceil(row_of(floor_m))));
    floor_y_ = row_of(floor_m);
    const vision::Outline edge = vision::silhouette_edge(
        picture_, {.x = left, .y = top, .width = right - left, .height = bottom - top}, floor_y_);
    return edge.along.empty() ? vision::OutlineAngle{} : vision::measure_outline(edge);
  }

  /// A line in the section measured last.
  vision::Slope slope_of(const std::optional<vision::OutlineFlank>& flank, std::string name) const {
    if (!flank) return {.name = std::move(name), .angle_rad = {}, .line = {}};
    const auto place = [&](const vision::Point& point) {
      return vision::Point{.x = point.x, .y = floor_y_ - point.y};
    };
    return {.name = std::move(name),
            .angle_rad = flank->angle_rad,
            .line = {place(flank->line.from), place(flank->line.to)}};
  }

 private:
  int pixels(double length_m) const { return static_cast<int>(std::ceil(length_m / m_per_px_)); }

  int column_of(double along_m) const {
    const double column = picture_.width / 2. + along_m / m_per_px_;
    return std::clamp(static_cast<int>(std::lround(column)), 0, picture_.width);
  }

  double row_of(double above_m) const {
    return picture_.height / 2. + (height_m_ / 2 - kMargin_m - above_m) / m_per_px_;
  }

  dem::BoxesFront boxes_;
  double width_m_;
  double height_m_ = 0;
  double m_per_px_ = 0;
  vision::Picture picture_;
  double floor_y_ = 0;
};

}  // namespace

DrawDownFront draw_down_front(render::Scene scene, const dem::BoxesFront& boxes) {
  if (scene.grains.empty()) {
    throw base::InputError({.where = "draw_down", .value = "there are no grains to draw"});
  }
  Front front(std::move(scene), boxes);
  DrawDownFront result;
  const double end_m = boxes.length_m / 2 + kMargin_m;
  const double above_m = boxes.upper_floor_m;
  const auto add = [&](const std::optional<vision::OutlineFlank>& flank, const char* name) {
    result.slopes.push_back(front.slope_of(flank, name));
  };
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  const vision::OutlineAngle left = front.angle_between(-end_m, 0, above_m, kNoEnd);
  add(left.right, "upper left");
  const vision::OutlineAngle right = front.angle_between(0, end_m, above_m, kNoEnd);
  add(right.left, "upper right");
  const vision::OutlineAngle lower = front.angle_between(-end_m, end_m, 0, boxes.drop_m);
  add(lower.left, "lower left");
  add(lower.right, "lower right");
  result.upper_angle_deg = mean_deg(right.left, left.right);
  result.lower_angle_deg = mean_deg(lower.left, lower.right);
  result.picture = std::move(front.picture());
  return result;
}

}  // namespace repose::calibrate
