#include "vision/compare/skyline.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace repose::vision {
namespace {

double between(const OutlinePoint& p, const OutlinePoint& q, double along) {
  return p.height + (q.height - p.height) * (along - p.along) / (q.along - p.along);
}

/// Heights at both ends of a stretch that no point of the skyline divides.
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

/// Adds a stretch in which a - b does not change sign and both are straight.
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

/// The skyline with points added where it crosses a height.
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

}  // namespace repose::vision
