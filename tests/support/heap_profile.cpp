#include "tests/support/heap_profile.h"

#include <algorithm>
#include <cmath>

namespace repose::testing {
namespace {

using vision::Point;
using vision::Segment;

constexpr double kStep = 0.5;
constexpr double kStraightTo = 0.85;
/// A grain needs this diameter [px] to look like one.
constexpr double kSmallestGrain = 4;

Point between(Point a, Point b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

bool has_flanks(Shape shape) { return shape == Shape::heap || shape == Shape::half_heap; }

}  // namespace

HeapProfile::HeapProfile(const HeapForm& form, double picture_width_px, double margin_px) {
  const double base = form.base * picture_width_px;
  apex_height_ = base / (1 / std::tan(form.left_rad) + 1 / std::tan(form.right_rad));
  left_toe_x_ = margin_px + form.center * picture_width_px - base / 2;
  right_toe_x_ = left_toe_x_ + base;
  apex_x_ = left_toe_x_ + apex_height_ / std::tan(form.left_rad);
  runout_px_ = form.toe_runout * base / 2;
  height_px_ = apex_height_ * (1 - form.crest / 2);
  straight_from_ = std::max(form.toe_height, 0.15);
  is_hollow_ = form.flanks != Flanks::straight;
  has_left_ = has_flanks(form.shape) && form.wall != Side::left && form.cut != Side::left;
  has_right_ = has_flanks(form.shape) && form.wall != Side::right && form.cut != Side::right;

  switch (form.shape) {
    case Shape::heap:
    case Shape::half_heap:
      is_hollow_ ? lay_hollow(form) : lay_heap(form);
      lean_on_wall(form);
      break;
    case Shape::column:
      lay_column();
      break;
    case Shape::layer:
      lay_layer(picture_width_px + 2 * margin_px);
      break;
    case Shape::nothing:
    case Shape::ball:
    case Shape::oblique:
      break;  // no outline curve
  }
  grain_px_ = std::max(kSmallestGrain, height_px_ / form.grains_high);
  index_heights();
}

void HeapProfile::lay_heap(const HeapForm& form) {
  const double bend_height = apex_height_ * (1 - form.crest);
  const double left_bend = apex_x_ - (apex_height_ - bend_height) / std::tan(form.left_rad);
  const double right_bend = apex_x_ + (apex_height_ - bend_height) / std::tan(form.right_rad);
  add_toe(form, Side::left);
  add_line({left_bend, bend_height});
  add_bend({apex_x_, apex_height_}, {right_bend, bend_height});
  add_toe(form, Side::right);
}

/// Like straight flanks, hollow ones are rounded off by a curve that is tangent to both.
void HeapProfile::lay_hollow(const HeapForm& form) {
  const FlankLaw law(form.flanks, form.hollow);
  const double highest = 1 - form.crest;
  const double left_slope = law.steepness(highest) * std::tan(form.left_rad);
  const double right_slope = law.steepness(highest) * std::tan(form.right_rad);
  const double bend_height = highest * apex_height_;
  const double out_px = law.out_at(highest) * apex_height_;
  const Point left = {apex_x_ - out_px / std::tan(form.left_rad), bend_height};
  const Point right = {apex_x_ + out_px / std::tan(form.right_rad), bend_height};
  const double rise = (right.x - left.x) / (1 / left_slope + 1 / right_slope);
  height_px_ = bend_height + rise / 2;
  curve_.push_back({left_toe_x_, 0});
  add_flank(law, Side::left, highest);
  add_bend({left.x + rise / left_slope, bend_height + rise}, right);
  add_flank(law, Side::right, highest);
}

/// Between the ground and `highest` of the apex, from left to right.
void HeapProfile::add_flank(const FlankLaw& law, Side side, double highest) {
  const double toe_x = side == Side::left ? left_toe_x_ : right_toe_x_;
  const double from = side == Side::left ? 1 : law.out_at(highest);
  const double to = side == Side::left ? law.out_at(highest) : 1;
  const int steps =
      static_cast<int>(std::ceil(2 * (apex_height_ + std::abs(toe_x - apex_x_)) / kStep));
  for (int i = 1; i <= steps; ++i) {
    const double out = from + (to - from) * i / steps;
    curve_.push_back({apex_x_ + out * (toe_x - apex_x_), apex_height_ * law.height(out)});
  }
}

void HeapProfile::lean_on_wall(const HeapForm& form) {
  if (form.wall == Side::none || form.wall_is_frame) return;
  std::erase_if(curve_,
                [&](Point p) { return form.wall == Side::left ? p.x < apex_x_ : p.x > apex_x_; });
}

/// A straight toe is a corner; a concave one leaves the flank at toe_height and touches the ground
/// runout_px_ farther out, tangent to both.
void HeapProfile::add_toe(const HeapForm& form, Side side) {
  const bool left = side == Side::left;
  const Point toe = {left ? left_toe_x_ : right_toe_x_, 0};
  const double out = left ? -1 : 1;
  const double rise = form.toe_height * height_px_;
  const double slope = std::tan(left ? form.left_rad : form.right_rad);
  const Point bend = {toe.x - out * rise / slope, rise};
  const Point end = {toe.x + out * runout_px_, 0};
  if (left) {
    curve_.push_back(end);
    add_bend(toe, bend);
  } else {
    add_line(bend);
    add_bend(toe, end);
  }
}

void HeapProfile::lay_column() {
  curve_.push_back({left_toe_x_, 0});
  add_line({left_toe_x_, height_px_});
  add_line({right_toe_x_, height_px_});
  add_line({right_toe_x_, 0});
}

void HeapProfile::lay_layer(double stage_width_px) {
  curve_.push_back({-20, height_px_});
  add_line({stage_width_px + 20, height_px_});
}

void HeapProfile::add_line(Point to) { add_bend(between(curve_.back(), to, 0.5), to); }

/// Quadratic Bezier curve from the last point.
void HeapProfile::add_bend(Point control, Point to) {
  const Point from = curve_.back();
  const double length = std::hypot(control.x - from.x, control.y - from.y) +
                        std::hypot(to.x - control.x, to.y - control.y);
  const int steps = static_cast<int>(std::ceil(2 * length / kStep));
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    curve_.push_back(between(between(from, control, t), between(control, to, t), t));
  }
}

void HeapProfile::index_heights() {
  if (curve_.empty()) return;
  first_x_ = curve_.front().x;
  const double width = curve_.back().x - first_x_;
  heights_.assign(static_cast<std::size_t>(width / kStep) + 1, 0);
  for (const Point& p : curve_) {
    auto& height = heights_[static_cast<std::size_t>((p.x - first_x_) / kStep)];
    height = std::max(height, p.y);
  }
}

double HeapProfile::height_at(double x) const {
  const double index = std::floor((x - first_x_) / kStep);
  if (index < 0 || index >= static_cast<double>(heights_.size())) return 0;
  return heights_[static_cast<std::size_t>(index)];
}

double HeapProfile::crest_x() const {
  return std::max_element(curve_.begin(), curve_.end(), [](Point a, Point b) { return a.y < b.y; })
      ->x;
}

std::optional<EdgeAngle> HeapProfile::angle(Side side) const {
  if (!has_flank(side)) return std::nullopt;
  const bool left = side == Side::left;
  const double crest_x = this->crest_x();
  std::vector<EdgePoint> edge;
  for (const Point& p : curve_) {
    const double out = left ? crest_x - p.x : p.x - crest_x;
    if (out >= 0) edge.push_back({.out = out, .height = p.y});
  }
  if (left) std::reverse(edge.begin(), edge.end());
  return angle_of_edge(edge, height_px_);
}

Segment HeapProfile::window_of_hollow(Side side) const {
  const EdgeAngle window = *angle(side);
  const double sign = side == Side::left ? -1 : 1;
  return {{crest_x() + sign * window.low.out, window.low.height},
          {crest_x() + sign * window.high.out, window.high.height}};
}

std::optional<Segment> HeapProfile::flank(Side side) const {
  if (!has_flank(side)) return std::nullopt;
  if (is_hollow_) return window_of_hollow(side);
  const bool left = side == Side::left;
  const Point toe = {left ? left_toe_x_ : right_toe_x_, 0};
  const Point apex = {apex_x_, apex_height_};
  const double scale = height_px_ / apex_height_;
  return Segment{between(toe, apex, straight_from_ * scale),
                 between(toe, apex, kStraightTo * scale)};
}

}  // namespace repose::testing
