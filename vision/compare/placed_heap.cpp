#include "vision/compare/placed_heap.h"

#include <algorithm>

#include "vision/measure/geometry.h"

namespace repose::vision {
namespace {

// The slab whose centre is the axis, in parts of the height.
constexpr double kSlabFrom = 0.2;
constexpr double kSlabTo = 0.8;

PictureLine line_through(const Segment& segment) {
  const double slope = (segment.to.y - segment.from.y) / (segment.to.x - segment.from.x);
  return {segment.from.y - slope * segment.from.x, slope};
}

/// On a tilted ground a leap of the edge may run backwards: such points hide under the leap.
Skyline skyline_of(const std::vector<Point>& edge, const GroundFrame& ground) {
  Skyline skyline;
  for (const Point& point : edge) {
    const double along = ground.along(point);
    if (!skyline.empty() && along <= skyline.back().along) continue;
    skyline.push_back({along, std::max(0.0, ground.height(point))});
  }
  return skyline;
}

bool has_both_flanks(const ReposeAngle& measured) {
  return measured.left.status == FlankStatus::ok && measured.right.status == FlankStatus::ok;
}

Cover flank_cover(const Flank& first, const Flank& second) {
  const auto both = {&first, &second};
  if (std::any_of(both.begin(), both.end(),
                  [](const Flank* flank) { return flank->status == FlankStatus::absent; })) {
    return Cover::none;
  }
  const bool is_cut = first.leaves_frame || second.leaves_frame;
  return is_cut ? Cover::part : Cover::whole;
}

}  // namespace

Point StandingHeap::on_ground(double along) const {
  return GroundFrame(line_through(ground)).picture(along, 0);
}

StandingHeap standing_heap(const ReposeAngle& measured) {
  StandingHeap heap;
  heap.ground = *measured.ground;
  const GroundFrame ground(line_through(heap.ground));
  heap.skyline = skyline_of(measured.upper_edge, ground);
  heap.height = *measured.height_px;
  heap.crest = ground.along(*measured.crest);
  const double low = kSlabFrom * heap.height;
  // Large grains end a heap upright, higher than the slab begins.
  const auto shows_slab = [low](const Flank& flank, const OutlinePoint& end) {
    return !flank.leaves_frame || end.height <= low;
  };
  if (has_both_flanks(measured) && shows_slab(measured.left, heap.skyline.front()) &&
      shows_slab(measured.right, heap.skyline.back())) {
    heap.axis = slab_centre(heap.skyline, low, kSlabTo * heap.height);
  }
  return heap;
}

std::array<double, 2> Reach::stretch(const Skyline& a, const Skyline& b, Side side) const {
  const std::size_t at = side == Side::left ? 0 : 1;
  if (cover[at] == Cover::none) return {0, 0};
  const auto end_of = [&](const Skyline& skyline) {
    return side == Side::left ? -skyline.front().along : skyline.back().along;
  };
  const double ends[] = {end_of(a), end_of(b)};
  double out = std::max(ends[0], ends[1]);
  for (const std::size_t heap : {0, 1}) {
    if (is_cut[heap][at]) out = std::min(out, ends[heap]);
  }
  out = std::max(0.0, out);
  return side == Side::left ? std::array{-out, 0.0} : std::array{0.0, out};
}

Reach reach_of(const ReposeAngle& first, const ReposeAngle& second) {
  Reach reach;
  reach.cover = {flank_cover(first.left, second.left), flank_cover(first.right, second.right)};
  reach.is_cut = {{{first.left.leaves_frame, first.right.leaves_frame},
                   {second.left.leaves_frame, second.right.leaves_frame}}};
  return reach;
}

}  // namespace repose::vision
