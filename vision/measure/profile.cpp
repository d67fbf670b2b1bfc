#include "vision/measure/profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "vision/measure/line_fit.h"

namespace repose::vision {
namespace {

/// Where the field crosses 0 above the topmost inside pixel, as a picture y.
double edge_y(const cv::Mat1f& inside, int row, int col) {
  if (row == 0) return 0;
  const double below = inside(row, col);
  const double above = inside(row - 1, col);
  if (below <= 0 || above > 0) return row;  // moved by morphology: the pixel's upper side
  return row + 0.5 - below / (below - above);
}

/// Middle of the stretch within 3 % of the top: a flat crest has no single highest point.
std::size_t crest_middle(const std::vector<double>& smooth, double top) {
  std::size_t first = smooth.size();
  std::size_t last = 0;
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    if (smooth[i] < 0.97 * top) continue;
    first = std::min(first, i);
    last = std::max(last, i);
  }
  return (first + last) / 2;
}

constexpr double kTowerStep = 0.5;     // of the median height: a jump that no heap of grains makes
constexpr double kTowerWidth = 0.25;   // of the profile: anything wider is not a tower
constexpr std::size_t kStepWidth = 3;  // columns within which the jump happens

/// One column of the picture in which the body has an upper edge.
struct Column {
  double along;
  double height;
  bool at_top;  ///< it touches the frame's top
};

/// Columns of walls, rulers and tubes that stand on or touch the heap: narrow stretches bounded by
/// a jump on one side and a jump or the profile's end on the other.
std::vector<bool> tower_columns(const std::vector<Column>& columns) {
  const std::size_t n = columns.size();
  std::vector<double> heights;
  for (const Column& column : columns) heights.push_back(column.height);
  const double step = kTowerStep * median(heights);
  const auto leaps_up = [&](std::size_t i) {  // between i - 1 and i, or a little before
    return i >= kStepWidth && heights[i] - heights[i - kStepWidth] > step &&
           heights[i] - heights[i - 1] > step / kStepWidth;
  };
  const auto leaps_down = [&](std::size_t i) {
    return i + kStepWidth < n && heights[i] - heights[i + kStepWidth] > step &&
           heights[i] - heights[i + 1] > step / kStepWidth;
  };
  std::vector<bool> tower(n, false);
  const auto widest = static_cast<std::size_t>(kTowerWidth * static_cast<double>(n));
  const auto mark = [&](std::size_t first, std::size_t last) {
    if (last - first > widest) return;
    const std::size_t from = first > kStepWidth ? first - kStepWidth : 0;
    for (std::size_t i = from; i < std::min(n, last + kStepWidth); ++i) tower[i] = true;
  };
  std::size_t rise = 0;  // the profile's start counts as a jump
  bool risen = true;
  for (std::size_t i = 0; i < n; ++i) {
    if (leaps_up(i)) {
      rise = i;
      risen = true;
    }
    if (risen && leaps_down(i)) {
      mark(rise, i + 1);
      risen = false;
    }
  }
  if (risen && rise > 0) mark(rise, n);
  return tower;
}

/// Number of points at one end that are a strip of the plate segmented with the heap: long, and
/// lower than any toe of grains can be. `at` indexes the points from that end.
template <typename At>
std::size_t strip_length(const Profile& profile, const At& at) {
  constexpr double kHighest_px = 2, kShortest_px = 10;
  std::size_t count = 0;
  while (count < profile.size() && profile.height[at(count)] < kHighest_px) ++count;
  if (count == 0 || count == profile.size()) return 0;
  const double length_px = std::abs(profile.along[at(count)] - profile.along[at(0)]);
  return length_px < kShortest_px ? 0 : count;
}

/// The foot behind such a strip is visible, wherever the strip ends.
void cut_strips(Profile& profile) {
  const std::size_t last = profile.size() - 1;
  const std::size_t left = strip_length(profile, [](std::size_t i) { return i; });
  const std::size_t right = strip_length(profile, [last](std::size_t i) { return last - i; });
  const auto cut = [&](std::vector<double>& values) {
    values.resize(values.size() - right);
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(left));
  };
  cut(profile.along);
  cut(profile.height);
  profile.leaves_frame_left = profile.leaves_frame_left && left == 0;
  profile.leaves_frame_right = profile.leaves_frame_right && right == 0;
}

}  // namespace

std::vector<double> moving_average(const std::vector<double>& values, std::size_t width) {
  std::vector<double> sums(values.size() + 1, 0);
  for (std::size_t i = 0; i < values.size(); ++i) sums[i + 1] = sums[i] + values[i];
  std::vector<double> smooth(values.size());
  const std::size_t half = width / 2;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t reach = std::min({half, i, values.size() - 1 - i});
    smooth[i] = (sums[i + reach + 1] - sums[i - reach]) / static_cast<double>(2 * reach + 1);
  }
  return smooth;
}

void set_crest(Profile& profile) {
  const std::size_t width = std::max<std::size_t>(3, profile.size() / 40);
  const std::vector<double> smooth = moving_average(profile.height, width);
  profile.crest_height = *std::max_element(smooth.begin(), smooth.end());
  profile.crest = crest_middle(smooth, profile.crest_height);
}

Profile upper_profile(const Body& body, const Segmentation& segmentation,
                      const WorkingPicture& work) {
  const GroundFrame ground(body.ground);
  std::vector<Column> columns;
  Profile profile;
  for (int col = 0; col < body.mask.cols; ++col) {
    int row = 0;
    while (row < body.mask.rows && body.mask(row, col) == 0) ++row;
    if (row == body.mask.rows) continue;
    if (col <= work.frame.x + 1) profile.leaves_frame_left = true;
    if (col >= work.frame.br().x - 2) profile.leaves_frame_right = true;
    const bool at_top = row <= work.frame.y;
    if (!at_top && work.valid_mask(row - 1, col) == 0) continue;  // the edge is hidden by a box
    const Point edge{col + 0.5, edge_y(segmentation.inside, row, col)};
    columns.push_back({ground.along(edge), ground.height(edge), at_top});
  }
  const std::vector<bool> tower = tower_columns(columns);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (tower[i]) continue;
    profile.along.push_back(columns[i].along);
    profile.height.push_back(columns[i].height);
    if (columns[i].at_top) profile.leaves_frame_top = true;
  }
  if (profile.size() == 0) return profile;
  cut_strips(profile);
  set_crest(profile);
  return profile;
}

}  // namespace repose::vision
