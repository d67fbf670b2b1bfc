#include "vision/measure/hints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

constexpr double kSteepestGround_rad = 30 * std::numbers::pi / 180;
constexpr double kShortestGround = 0.1;  // of the picture's width, or of the box's

bool lies_inside(const Point& point, int width, int height) {
  // Written so that NaN fails.
  return point.x >= 0 && point.y >= 0 && point.x <= width && point.y <= height;
}

void check_points(const std::vector<Point>& points, const char* name, int width, int height,
                  std::vector<base::Fault>& errors) {
  for (const Point& point : points) {
    if (lies_inside(point, width, height)) continue;
    errors.push_back({.subject = name,
                      .value = fmt::format("= {:g},{:g}", point.x, point.y),
                      .rule = fmt::format("must lie inside the {} x {} picture", width, height),
                      .fix = "count pixels from its top left corner."});
  }
}

void check_ground(const Segment& ground, int width, int height, const std::optional<Box>& heap,
                  std::vector<base::Fault>& errors) {
  check_points({ground.from, ground.to}, "ground points", width, height, errors);
  const double dx = std::abs(ground.to.x - ground.from.x);
  const double dy = std::abs(ground.to.y - ground.from.y);
  const double shortest = kShortestGround * (heap ? heap->width : width);
  if (!(dx >= shortest) || !(std::atan2(dy, dx) <= kSteepestGround_rad)) {
    errors.push_back(
        {.subject = "ground points",
         .value = fmt::format("= {:g},{:g},{:g},{:g}", ground.from.x, ground.from.y, ground.to.x,
                              ground.to.y),
         .rule = fmt::format("must be at least {:.0f} pixels long and within 30 degrees of level",
                             shortest),
         .fix = "give two points far apart on the line that the heap stands on."});
  }
}

void check_heap(const Box& box, int width, int height, std::vector<base::Fault>& errors) {
  const bool is_inside = box.x >= 0 && box.y >= 0 && box.width >= 1 && box.height >= 1 &&
                         box.width <= width - box.x && box.height <= height - box.y;
  if (is_inside) return;
  errors.push_back({.subject = "heap box",
                    .value = fmt::format("= {},{},{},{}", box.x, box.y, box.width, box.height),
                    .rule = fmt::format("must lie inside the {} x {} picture", width, height),
                    .fix = "give the top-left pixel, width and height in pixels of the picture."});
}

Point moved(const Point& point, const Box& box) { return {point.x - box.x, point.y - box.y}; }

std::vector<Point> moved(const std::vector<Point>& points, const Box& box) {
  std::vector<Point> inside;
  for (const Point& point : points) {
    const Point here = moved(point, box);
    if (lies_inside(here, box.width, box.height)) inside.push_back(here);
  }
  return inside;
}

std::string count_of(std::size_t places, const char* where) {
  return fmt::format("{} point{} {} the heap", places, places == 1 ? "" : "s", where);
}

}  // namespace

bool Hints::empty() const {
  return turn_deg == 0 && !heap && !half && !ground && keep.empty() && drop.empty() && mask.empty();
}

std::string Hints::text() const {
  std::vector<std::string> parts;
  if (turn_deg != 0) parts.push_back(fmt::format("turned clockwise by {} degrees", turn_deg));
  if (heap) parts.emplace_back("box around the heap");
  if (half) parts.push_back(fmt::format("half a heap, with its {} flank", name_of(*half)));
  if (ground) parts.emplace_back("ground line");
  if (!keep.empty()) parts.push_back(count_of(keep.size(), "on"));
  if (!drop.empty()) parts.push_back(count_of(drop.size(), "off"));
  if (mask.width > 0) parts.emplace_back("mask");
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<base::Fault> problems_of(const Hints& hints, int width, int height) {
  std::vector<base::Fault> errors;
  if (hints.heap) check_heap(*hints.heap, width, height, errors);
  if (hints.ground) check_ground(*hints.ground, width, height, hints.heap, errors);
  check_points(hints.keep, "point to keep", width, height, errors);
  check_points(hints.drop, "point to drop", width, height, errors);
  const Picture& mask = hints.mask;
  if (!mask.empty() && (mask.width != width || mask.height != height)) {
    errors.push_back({.value = fmt::format("the mask is {} x {} and the picture {} x {}",
                                           mask.width, mask.height, width, height),
                      .rule = "as large as the picture",
                      .fix = "paint it on a copy of the picture."});
  }
  return errors;
}

Hints hints_within(const Hints& hints, const Box& box) {
  Hints inside{.turn_deg = hints.turn_deg,
               .heap = {},
               .half = hints.half,
               .ground = hints.ground,
               .keep = moved(hints.keep, box),
               .drop = moved(hints.drop, box),
               .mask = {},
               .mask_file = hints.mask_file,
               .source = hints.source};
  if (inside.ground) inside.ground = {moved(hints.ground->from, box), moved(hints.ground->to, box)};
  if (!hints.mask.empty()) inside.mask = part_of(hints.mask, box);
  return inside;
}

Picture part_of(const Picture& picture, const Box& box) {
  Picture part = blank_picture(box.width, box.height);
  cv::Mat target = mat_of(part);
  mat_of(picture)(cv::Rect(box.x, box.y, box.width, box.height)).copyTo(target);
  return part;
}

}  // namespace repose::vision
