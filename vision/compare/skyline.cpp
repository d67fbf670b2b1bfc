#include "vision/compare/skyline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "vision/measure/geometry.h"

namespace repose::vision {

namespace {

double between(const OutlinePoint& p, const OutlinePoint& q, double along) {
  return p.height + (q.height - p.height) * (along - p.along) / (q.along - p.along);
}

/// Heights at both ends of a stretch that contains no point of the skyline.
struct Ends {
  double from = 0;
  double to = 0;
};

Ends heights_over(const Skyline& skyline, double from, double to) {
  const auto next =
      std::upper_bound(skyline.begin(), skyline.end(), from,
                       [](double along, const OutlinePoint& point) { return along < point.along; });
  if (next == skyline.begin() || next == skyline.end()) return {};
  const OutlinePoint& before = *std::prev(next);
  return {between(before, *next, from), between(before, *next, to)};
}

/// Adds a stretch in which a - b does not change sign and both are linear.
void add_straight(SkylineDifference& total, Ends a, Ends b, double length) {
  const double first = a.from - b.from;
  const double last = a.to - b.to;
  const double area_a = (a.from + a.to) / 2 * length;
  const double area_b = (b.from + b.to) / 2 * length;
  total.length += length;
  total.common += std::min(area_a, area_b);
  total.covered += std::max(area_a, area_b);
  total.sum += (first + last) / 2 * length;
  total.squares += (first * first + first * last + last * last) / 3 * length;
}

void add_stretch(SkylineDifference& total, Ends a, Ends b, double length) {
  const double first = a.from - b.from;
  const double last = a.to - b.to;
  if (first * last >= 0) {
    add_straight(total, a, b, length);
    return;
  }
  const double fraction = first / (first - last);  // where the two lines cross
  const double meeting = a.from + (a.to - a.from) * fraction;
  add_straight(total, {a.from, meeting}, {b.from, meeting}, fraction * length);
  add_straight(total, {meeting, a.to}, {meeting, b.to}, (1 - fraction) * length);
}

/// Both ends and every point of either skyline between them, ascending.
std::vector<double> divisions(const Skyline& a, const Skyline& b, double from, double to) {
  std::vector<double> places = {from, to};
  for (const Skyline* skyline : {&a, &b}) {
    for (const OutlinePoint& point : *skyline) {
      if (point.along > from && point.along < to) places.push_back(point.along);
    }
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

/// The skyline with points added where it crosses a given height.
Skyline divided_at(const Skyline& skyline, double height) {
  Skyline divided;
  for (const OutlinePoint& point : skyline) {
    if (!divided.empty()) {
      const OutlinePoint& before = divided.back();
      const double fraction = (height - before.height) / (point.height - before.height);
      if (fraction > 0 && fraction < 1) {
        divided.push_back({before.along + fraction * (point.along - before.along), height});
      }
    }
    divided.push_back(point);
  }
  return divided;
}

}  // namespace

Skyline placed(const Skyline& skyline, double origin, double factor) {
  Skyline result = skyline;
  for (OutlinePoint& point : result) {
    point = {(point.along - origin) * factor, point.height * factor};
  }
  return result;
}

Skyline part_of(const Skyline& skyline, double from, double to) {
  Skyline part;
  for (std::size_t i = 0; i < skyline.size(); ++i) {
    const OutlinePoint& point = skyline[i];
    if (i > 0) {
      const OutlinePoint& before = skyline[i - 1];
      for (const double end : {from, to}) {
        if (before.along < end && end < point.along) {
          part.push_back({end, between(before, point, end)});
        }
      }
    }
    if (point.along >= from && point.along <= to) part.push_back(point);
  }
  return part;
}

double height_at(const Skyline& skyline, double along) {
  if (!skyline.empty() && along == skyline.back().along) return skyline.back().height;
  return heights_over(skyline, along, along).from;
}

double slab_centre(const Skyline& skyline, double low, double high) {
  Skyline slab = divided_at(divided_at(skyline, low), high);
  for (OutlinePoint& point : slab) point.height = std::clamp(point.height, low, high) - low;
  double area = 0;
  double moment = 0;
  for (std::size_t i = 1; i < slab.size(); ++i) {
    const auto [x0, h0] = slab[i - 1];
    const auto [x1, h1] = slab[i];
    area += (x1 - x0) * (h0 + h1) / 2;
    moment += (x1 - x0) * (h0 * (2 * x0 + x1) + h1 * (x0 + 2 * x1)) / 6;
  }
  return area > 0 ? moment / area : std::numeric_limits<double>::quiet_NaN();
}

SkylineDifference& SkylineDifference::operator+=(const SkylineDifference& other) {
  length += other.length;
  common += other.common;
  covered += other.covered;
  sum += other.sum;
  squares += other.squares;
  return *this;
}

double SkylineDifference::iou() const { return covered > 0 ? common / covered : 0; }
double SkylineDifference::rmse() const { return length > 0 ? std::sqrt(squares / length) : 0; }
double SkylineDifference::mean() const { return length > 0 ? sum / length : 0; }

SkylineDifference difference_of(const Skyline& a, const Skyline& b, double from, double to) {
  SkylineDifference total;
  if (!(from < to)) return total;
  const std::vector<double> places = divisions(a, b, from, to);
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double left = places[i - 1];
    const double right = places[i];
    add_stretch(total, heights_over(a, left, right), heights_over(b, left, right), right - left);
  }
  return total;
}

namespace {

constexpr int kSteps = 2000;
constexpr double kMaxOfIt = 0.95;

double step_between(const OutlinePoint& p, const OutlinePoint& q) {
  return std::hypot(q.along - p.along, q.height - p.height);
}

/// Points at equal steps along the edge, both ends included.
Skyline walked(const Skyline& edge) {
  double length = 0;
  for (std::size_t i = 1; i < edge.size(); ++i) length += step_between(edge[i - 1], edge[i]);
  if (length <= 0) return {edge.front()};
  Skyline walk;
  double behind = 0;  // length of the edge before point i
  std::size_t i = 1;
  for (int step = 0; step <= kSteps; ++step) {
    const double target = length * step / kSteps;
    double piece = step_between(edge[i - 1], edge[i]);
    while (i + 1 < edge.size() && behind + piece < target) {
      behind += piece;
      ++i;
      piece = step_between(edge[i - 1], edge[i]);
    }
    const double fraction = piece > 0 ? std::min(1.0, (target - behind) / piece) : 0;
    const OutlinePoint& p = edge[i - 1];
    const OutlinePoint& q = edge[i];
    walk.push_back(
        {p.along + fraction * (q.along - p.along), p.height + fraction * (q.height - p.height)});
  }
  return walk;
}

double squared_distance(const OutlinePoint& point, const OutlinePoint& p, const OutlinePoint& q) {
  const double x = q.along - p.along;
  const double y = q.height - p.height;
  const double length = x * x + y * y;
  const double along = (point.along - p.along) * x + (point.height - p.height) * y;
  const double fraction = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  const double dx = point.along - p.along - fraction * x;
  const double dy = point.height - p.height - fraction * y;
  return dx * dx + dy * dy;
}

/// Nearest distance to `edge`. Points are sorted by `along`, so the search goes outwards from the
/// point's own position and ends when the distance along the ground alone is longer.
double distance_to(const Skyline& edge, const OutlinePoint& point) {
  if (edge.size() == 1) return step_between(point, edge.front());
  const auto above = std::lower_bound(
      edge.begin(), edge.end(), point.along,
      [](const OutlinePoint& candidate, double along) { return candidate.along < along; });
  const auto start = std::clamp<std::ptrdiff_t>(above - edge.begin(), 1, std::ssize(edge) - 1);
  double nearest = std::numeric_limits<double>::infinity();
  const auto look = [&](std::ptrdiff_t i) {
    const auto at = static_cast<std::size_t>(i);
    nearest = std::min(nearest, squared_distance(point, edge[at - 1], edge[at]));
  };
  const auto is_near = [&](std::ptrdiff_t i) {
    const double way = edge[static_cast<std::size_t>(i)].along - point.along;
    return way * way < nearest;
  };
  look(start);
  for (std::ptrdiff_t i = start + 1; i < std::ssize(edge) && is_near(i - 1); ++i) look(i);
  for (std::ptrdiff_t i = start - 1; i > 0 && is_near(i); --i) look(i);
  return std::sqrt(nearest);
}

EdgeDistance directed(const Skyline& from, const Skyline& to) {
  std::vector<double> distances;
  for (const OutlinePoint& point : walked(from)) distances.push_back(distance_to(to, point));
  std::sort(distances.begin(), distances.end());
  const auto last = static_cast<double>(distances.size() - 1);
  return {distances.back(), distances[static_cast<std::size_t>(std::ceil(kMaxOfIt * last))]};
}

}  // namespace

EdgeDistance edge_distance(const Skyline& a, const Skyline& b) {
  const EdgeDistance there = directed(a, b);
  const EdgeDistance back = directed(b, a);
  return {std::max(there.largest, back.largest), std::max(there.most_of_it, back.most_of_it)};
}

namespace {

// The slab whose centroid is the axis, as fractions of the height.
constexpr double kSlabFrom = 0.2;
constexpr double kSlabTo = 0.8;

PictureLine line_through(const Segment& segment) {
  const double slope = (segment.to.y - segment.from.y) / (segment.to.x - segment.from.x);
  return {segment.from.y - slope * segment.from.x, slope};
}

/// On tilted ground a jump of the edge may run backwards: such points are hidden under it.
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

Coverage flank_cover(const Flank& first, const Flank& second) {
  const auto both = {&first, &second};
  if (std::any_of(both.begin(), both.end(),
                  [](const Flank* flank) { return flank->status == FlankStatus::absent; })) {
    return Coverage::none;
  }
  const bool is_cut = first.leaves_frame || second.leaves_frame;
  return is_cut ? Coverage::part : Coverage::whole;
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
  // Large grains give a heap an upright end, higher than where the slab begins.
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
  if (cover[at] == Coverage::none) return {0, 0};
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
