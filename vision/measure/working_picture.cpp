#include "vision/measure/working_picture.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/picture/opencv.h"

namespace repose::vision {

std::optional<Tones> tones_of(const cv::Mat3b& bgr) {
  if (bgr.empty()) return std::nullopt;
  Tones tones = {bgr(0, 0), bgr(0, 0)};
  bool has_two = false;
  for (int row = 0; row < bgr.rows; ++row) {
    const cv::Vec3b* const end = bgr[row] + bgr.cols;
    const cv::Vec3b* at = bgr[row];
    const auto is_known = [&](const cv::Vec3b& colour) {
      return colour == tones[0] || colour == tones[1];
    };
    while ((at = std::find_if_not(at, end, is_known)) != end) {
      if (has_two) return std::nullopt;
      has_two = true;
      tones[1] = *at;
    }
  }
  if (!has_two) return std::nullopt;
  return tones;
}

bool is_grey(const Tones& tones) {
  return std::all_of(tones.begin(), tones.end(), [](const cv::Vec3b& tone) {
    return tone[0] == tone[1] && tone[0] == tone[2];
  });
}

namespace {

constexpr double kBarBlack = 24;      // a bar's brightest pixel, of 255: JPEG ringing stays below
constexpr double kBarContent = 0.25;  // of a bar's row may be a logo or an overlaid timer
constexpr double kPictureContent = 0.5;  // of the row after a bar that must be picture

/// Rows of a black bar at the top of `grey`, 0 if there is none. A dark backdrop is not a bar: its
/// rows become lighter gradually, where the heap is, not almost everywhere at once.
int bar_height(const cv::Mat1b& grey) {
  for (int row = 0; row < grey.rows; ++row) {
    if (cv::countNonZero(grey.row(row) > kBarBlack) <= kBarContent * grey.cols) continue;
    const int after = std::min(row + 2, grey.rows - 1);  // resizing blurs the bar's edge
    return cv::countNonZero(grey.row(after) > kBarBlack) >= kPictureContent * grey.cols ? row : 0;
  }
  return 0;
}

/// Bars come in pairs; a single one is more likely a dark table or ceiling.
cv::Rect without_letterbox(const cv::Mat1b& grey) {
  const auto pair_of_bars = [](const cv::Mat1b& upright) {
    cv::Mat1b flipped;
    cv::flip(upright, flipped, 0);
    const int first = bar_height(upright);
    const int last = bar_height(flipped);
    if (first == 0 || last == 0) return std::pair{0, 0};
    return std::pair{first + 1, last + 1};
  };
  const auto [top, bottom] = pair_of_bars(grey);
  const auto [left, right] = pair_of_bars(grey.t());
  const cv::Rect inner(left, top, grey.cols - left - right, grey.rows - top - bottom);
  return inner.width > 0 && inner.height > 0 ? inner : cv::Rect({}, grey.size());
}

/// Resizes a picture, only one channel of it if all are equal.
cv::Mat3b reduced(const cv::Mat3b& bgr, const cv::Size& size, bool is_grey) {
  cv::Mat small = bgr;
  if (is_grey) cv::extractChannel(bgr, small, 0);
  cv::resize(small, small, size, 0, 0, cv::INTER_AREA);
  if (is_grey) cv::cvtColor(small, small, cv::COLOR_GRAY2BGR);
  return small;
}

cv::Rect shrunk(const Box& box, double shrink) {
  const auto floored = [&](int value) { return static_cast<int>(std::floor(value / shrink)); };
  const auto ceiled = [&](int value) { return static_cast<int>(std::ceil(value / shrink)); };
  const cv::Point first(floored(box.x), floored(box.y));
  const cv::Point last(ceiled(box.x + box.width), ceiled(box.y + box.height));
  return {first, last};
}

/// L*a*b* of a picture with blue, green and red from 0 to 1.
cv::Mat3f lab_of_colours(const cv::Mat3f& bgr) {
  // OpenCV builds its tables at the first conversion, without a lock, so only one thread may do
  // that.
  static const bool tables_ready = [] {
    cv::Mat3f lab;
    cv::cvtColor(cv::Mat3f(1, 1, cv::Vec3f()), lab, cv::COLOR_BGR2Lab);
    return true;
  }();
  static_cast<void>(tables_ready);
  cv::Mat3f lab;
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  return lab;
}

/// The same for a picture of only 256 greys.
cv::Mat3f lab_of_greys(const cv::Mat3b& bgr) {
  static const cv::Mat3f table = [] {
    cv::Mat3f greys(1, 256);
    for (int level = 0; level < 256; ++level) {
      greys(level) = cv::Vec3f::all(static_cast<float>(level) / 255);
    }
    return lab_of_colours(greys);
  }();
  cv::Mat3f lab(bgr.size());
  for (int row = 0; row < bgr.rows; ++row) {
    const cv::Vec3b* greys = bgr[row];
    std::transform(
        greys, greys + bgr.cols, lab[row],
        [lab_of_grey = table[0]](const cv::Vec3b& grey) { return lab_of_grey[grey[0]]; });
  }
  return lab;
}

cv::Mat3f lab_of(const cv::Mat3b& bgr, bool is_grey) {
  if (is_grey) return lab_of_greys(bgr);
  cv::Mat3f scaled;
  bgr.convertTo(scaled, CV_32F, 1 / 255.0);
  return lab_of_colours(scaled);
}

constexpr double kPointed_px = 2;  // working px: how accurately a person marks a line
constexpr double kPlace = 0.008;   // of the picture's longest side: radius of a place
constexpr double kLight = 192;     // lightness of 255 from which a mask means heap
constexpr double kTooDark = 64;    // ... below which it means not heap

PictureLine line_of(const Segment& segment, double shrink) {
  const double slope = (segment.to.y - segment.from.y) / (segment.to.x - segment.from.x);
  return {(segment.from.y - slope * segment.from.x) / shrink, slope};
}

/// Discs around the places.
cv::Mat1b marked(const std::vector<Point>& places, const WorkingPicture& work) {
  if (places.empty()) return {};
  cv::Mat1b mask = cv::Mat1b::zeros(work.bgr.size());
  const int radius = std::max(2, static_cast<int>(kPlace * std::max(work.bgr.cols, work.bgr.rows)));
  for (const Point& place : places) {
    const cv::Point at(static_cast<int>(place.x / work.shrink),
                       static_cast<int>(place.y / work.shrink));
    cv::circle(mask, at, radius, 255, cv::FILLED);
  }
  return mask;
}

void add_mask(UserHints& told, const Picture& picture, const WorkingPicture& work) {
  cv::Mat1b grey;
  cv::cvtColor(mat_of(picture), grey, cv::COLOR_BGR2GRAY);
  cv::resize(grey, grey, work.bgr.size(), 0, 0, cv::INTER_AREA);
  const auto add = [](cv::Mat1b& places, const cv::Mat1b& more) {
    // A mask may mark only one of the two.
    if (cv::countNonZero(more) == 0) return;
    places = places.empty() ? more : cv::Mat1b(places | more);
  };
  add(told.on_heap, grey >= kLight);
  add(told.beside_heap, grey < kTooDark);
}

UserHints identified_by(const Hints& hints, const WorkingPicture& work) {
  UserHints told;
  if (hints.ground) {
    told.ground = line_of(*hints.ground, work.shrink);
    const double length = std::abs(hints.ground->to.x - hints.ground->from.x) / work.shrink;
    told.ground_deviation_rad = std::sqrt(2) * kPointed_px / length;
  }
  told.on_heap = marked(hints.keep, work);
  told.beside_heap = marked(hints.drop, work);
  if (!hints.mask.empty()) add_mask(told, hints.mask, work);
  return told;
}

/// The ground is not the heap, and says nothing about what lies behind it.
void leave_ground_out(WorkingPicture& work) {
  if (!work.told.ground) return;
  for (int col = 0; col < work.valid_mask.cols; ++col) {
    const double level = std::ceil(work.told.ground->y(col + 0.5));
    const int first = std::clamp(static_cast<int>(level), 0, work.valid_mask.rows);
    work.valid_mask(cv::Range(first, work.valid_mask.rows), cv::Range(col, col + 1)) = 0;
  }
}

}  // namespace

WorkingPicture working_picture(const Picture& picture, const std::vector<Box>& excluded,
                               const Hints& hints) {
  const Box seen =
      hints.heap.value_or(Box{.x = 0, .y = 0, .width = picture.width, .height = picture.height});
  const cv::Mat full = mat_of(picture)(cv::Rect(seen.x, seen.y, seen.width, seen.height));
  const int longest = std::max(seen.width, seen.height);
  WorkingPicture work;
  work.origin = {static_cast<double>(seen.x), static_cast<double>(seen.y)};
  work.tones = tones_of(full);
  const bool has_greys = work.tones && is_grey(*work.tones);
  work.shrink = std::max(1.0, static_cast<double>(longest) / kWorkingSide);
  if (work.shrink > 1) {
    const double scale = 1 / work.shrink;
    const cv::Size size(std::max(1, static_cast<int>(std::lround(seen.width * scale))),
                        std::max(1, static_cast<int>(std::lround(seen.height * scale))));
    work.bgr = reduced(full, size, has_greys);
  } else {
    full.copyTo(work.bgr);
  }
  work.lab = lab_of(work.bgr, has_greys);
  cv::Mat1b grey;
  cv::cvtColor(work.bgr, grey, cv::COLOR_BGR2GRAY);
  work.frame = hints.heap ? cv::Rect({}, grey.size()) : without_letterbox(grey);
  work.valid_mask = cv::Mat1b::zeros(work.bgr.size());
  work.valid_mask(work.frame) = 255;
  for (Box box : excluded) {
    box.x -= seen.x;
    box.y -= seen.y;
    work.valid_mask(shrunk(box, work.shrink) & cv::Rect({}, work.bgr.size())) = 0;
  }
  work.told = identified_by(hints.heap ? hints_within(hints, *hints.heap) : hints, work);
  work.told.has_box = hints.heap.has_value();
  leave_ground_out(work);
  return work;
}

}  // namespace repose::vision
