#include "vision/measure/reading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "vision/measure/grain.h"
#include "vision/measure/ground.h"

namespace repose::vision {

namespace {

constexpr int kBandBegins = 2;           // px from the edge at which the bands beside it begin
constexpr int kBandFar = 8;              // and end
constexpr double kUsualBase = 0.25;      // of the frame's width: the subject is hardly ever smaller
constexpr double kUsualPartOfBox = 0.4;  // of its width or its height
constexpr double kCrestUnseen = 0.3;     // a body that touches the frame's top is hardly the heap
constexpr std::size_t kChunks = 10;

struct EdgePoint {
  int col;
  double row;
};

struct EdgeQuality {
  double contrast = 0;
  double sharpness = 0;
};

cv::Vec3f colour_at(const WorkingPicture& work, double row, int col) {
  const int r = std::clamp(static_cast<int>(std::floor(row)), 0, work.lab.rows - 1);
  return work.lab(r, col);
}

EdgeQuality chunk_quality(const std::vector<EdgePoint>& edge, std::size_t first, std::size_t last,
                          const WorkingPicture& work) {
  Band outside;
  Band inside;
  for (std::size_t i = first; i < last; ++i) {
    for (int away = kBandBegins; away <= kBandFar; ++away) {
      outside.add(colour_at(work, edge[i].row - away, edge[i].col));
      inside.add(colour_at(work, edge[i].row + away, edge[i].col));
    }
  }
  const cv::Vec3d step = inside.mean() - outside.mean();
  const double length = cv::norm(step);
  if (length < 1e-6) return {};
  double near_step = 0;
  for (std::size_t i = first; i < last; ++i) {
    const cv::Vec3d near = cv::Vec3d(colour_at(work, edge[i].row + 1.5, edge[i].col)) -
                           cv::Vec3d(colour_at(work, edge[i].row - 1.5, edge[i].col));
    near_step += near.dot(step) / (length * length) / static_cast<double>(last - first);
  }
  return {step_contrast(outside, inside), std::clamp(near_step, 0.0, 1.0)};
}

std::vector<EdgePoint> edge_of(const FlankFit& flank, Side side, const Reading& reading,
                               const WorkingPicture& work) {
  const GroundFrame ground(reading.body.ground);
  const double crest = reading.profile.along[reading.profile.crest];
  std::vector<EdgePoint> edge;
  for (std::size_t i = 0; i < flank.along.size(); ++i) {
    const double along = side == Side::left ? crest - flank.along[i] : crest + flank.along[i];
    const Point p = ground.picture(along, flank.height[i]);
    const int col = std::clamp(static_cast<int>(p.x), 0, work.lab.cols - 1);
    edge.push_back({col, p.y});
  }
  return edge;
}

double fraction_of(const cv::Mat1b& places, const cv::Mat1b& mask) {
  return static_cast<double>(cv::countNonZero(places & mask)) /
         std::max(1, cv::countNonZero(places));
}

/// How far the body agrees with the user's marks on and beside the heap, 0 to 1.
double agreement_with(const UserHints& told, const Body& body) {
  const double kept = told.on_heap.empty() ? 1 : fraction_of(told.on_heap, body.mask);
  const double dropped = told.beside_heap.empty() ? 1 : fraction_of(told.beside_heap, ~body.mask);
  return kept * dropped;
}

/// How far a heap's size and place in the frame suggest that it is the subject.
double subject_score(const Reading& reading, const WorkingPicture& work) {
  const double base = reading.profile.along.back() - reading.profile.along.front();
  if (work.told.has_box) {
    const double part =
        std::max(base / work.frame.width, reading.profile.crest_height / work.frame.height);
    return std::pow(std::min(1.0, part / kUsualPartOfBox), 4);
  }
  const double fraction = std::min(1.0, base / (kUsualBase * work.frame.width));
  return fraction * fraction * (reading.profile.leaves_frame_top ? kCrestUnseen : 1);
}

}  // namespace

void score(Reading& reading, const WorkingPicture& work) {
  if (!reading.has_flank()) return;
  std::vector<double> contrast;
  double sharpness = 0;
  double fit = 1;
  for (const Side side : {Side::left, Side::right}) {
    const FlankFit& flank = reading.flank(side);
    if (flank.status != FlankStatus::ok) continue;
    const std::vector<EdgePoint> edge = edge_of(flank, side, reading, work);
    for (std::size_t chunk = 0; chunk < kChunks; ++chunk) {
      const EdgeQuality q = chunk_quality(edge, chunk * edge.size() / kChunks,
                                          (chunk + 1) * edge.size() / kChunks, work);
      contrast.push_back(q.contrast);
      sharpness += q.sharpness;
    }
    fit = std::min(fit, flank.least_squares.r2);
  }
  sharpness /= static_cast<double>(contrast.size());
  std::sort(contrast.begin(), contrast.end());
  reading.edge_contrast = contrast[contrast.size() / 4];  // most of the edge, not its best part
  reading.edge_sharpness = sharpness;
  reading.score = saturated(reading.edge_contrast, 1) * saturated(sharpness, 0.3) * fit * fit *
                  subject_score(reading, work) * agreement_with(work.told, reading.body);
}

double Reading::angle_rad() const { return mean_angle_rad(left, right); }

void leave_out_wall(Reading& reading, const Hints& hints) {
  if (!hints.half) return;
  reading.walled = *hints.half == Side::left ? Side::right : Side::left;
  FlankFit& wall = reading.walled == Side::left ? reading.left : reading.right;
  constexpr double kWall_rad = 60 * std::numbers::pi / 180;  // steeper than loose grains lie
  reading.is_wall_a_flank = wall.status == FlankStatus::ok && wall.angle_rad < kWall_rad;
  wall = {};
  wall.reason = "the heap is said to end at a wall there";
}

namespace {

Reading read_body(const Segmentation& segmentation, Body body, const WorkingPicture& work,
                  const MeasureOptions& options) {
  Reading reading;
  reading.segmentation = segmentation;
  reading.body = std::move(body);
  reading.profile = upper_profile(reading.body, segmentation, work);
  if (reading.profile.size() < 10) return reading;
  reading.grain = grain_size(work, reading.body.mask);
  FlankOptions flank{.window_from = options.window_from,
                     .window_to = options.window_to,
                     .grain = reading.grain,
                     .seed = options.seed};
  reading.left = fit_flank(reading.profile, Side::left, flank);
  ++flank.seed;
  reading.right = fit_flank(reading.profile, Side::right, flank);
  leave_out_wall(reading, options.hints);
  score(reading, work);
  return reading;
}

}  // namespace

Reading read_heap(const Segmentation& segmentation, const WorkingPicture& work,
                  const MeasureOptions& options) {
  Reading best;
  best.segmentation = segmentation;
  for (Body& body : find_bodies(segmentation, work)) {
    Reading reading = read_body(segmentation, std::move(body), work, options);
    if (best.profile.size() == 0 || reading.score > best.score) best = std::move(reading);
  }
  return best;
}

Reading read_again(const Reading& earlier, const Segmentation& segmentation,
                   const WorkingPicture& work, const MeasureOptions& options) {
  Body body = body_on(earlier.body, segmentation, work);
  if (body.mask.empty()) return {};
  return read_body(segmentation, std::move(body), work, options);
}

}  // namespace repose::vision
