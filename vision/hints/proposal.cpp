#include "vision/hints/proposal.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <string_view>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "vision/measure/body.h"
#include "vision/measure/regions.h"
#include "vision/measure/segmentation.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {
namespace {

constexpr std::size_t kMaxOfAKind = 4;   // candidates tried
constexpr int kSmallestFrame = 64;       // px: smaller frames are not measured
constexpr double kMargin = 0.06;         // of an object's size, left around it
constexpr double kSameBox = 0.7;         // boxes with more intersection over union count as one
constexpr double kSmallestThing = 0.05;  // of the frame's area
constexpr double kLargestThing = 0.9;

// Overlaid lettering: wide, low, and full of steep edges.
constexpr double kSteepEdge = 60;     // step in grey levels from one pixel to the next
constexpr double kWidestLabel = 0.4;  // of the frame's width
constexpr double kHighestLabel = 0.25;
constexpr double kLabelFilled = 0.55;  // of its own box
constexpr int kLetterGap = 9;          // working px; smaller gaps between letters are closed

double overlap(const cv::Rect& a, const cv::Rect& b) {
  const double both = (a & b).area();
  return both / std::max(1.0, a.area() + b.area() - both);
}

void add_new(std::vector<cv::Rect>& boxes, const cv::Rect& box) {
  const bool is_known = std::any_of(boxes.begin(), boxes.end(), [&](const cv::Rect& other) {
    return overlap(box, other) > kSameBox;
  });
  if (!is_known) boxes.push_back(box);
}

void keep_largest(std::vector<cv::Rect>& boxes) {
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const cv::Rect& a, const cv::Rect& b) { return a.area() > b.area(); });
  if (boxes.size() > kMaxOfAKind) boxes.resize(kMaxOfAKind);
}

/// Boxes around timers, labels and other lettering.
std::vector<cv::Rect> labels_in(const WorkingPicture& work) {
  cv::Mat1b grey;
  cv::cvtColor(work.bgr, grey, cv::COLOR_BGR2GRAY);
  cv::Mat1b steep;
  cv::morphologyEx(grey, steep, cv::MORPH_GRADIENT,
                   cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  steep = steep > kSteepEdge;
  cv::morphologyEx(steep, steep, cv::MORPH_CLOSE,
                   cv::getStructuringElement(cv::MORPH_RECT, {kLetterGap, kLetterGap / 2}));
  const Pieces pieces(steep);
  std::vector<cv::Rect> labels;
  for (int i = 1; i < pieces.count; ++i) {
    const cv::Rect box = pieces.box(i);
    const bool is_label = box.width > box.height && box.width < kWidestLabel * work.frame.width &&
                          box.height > kLetterGap &&
                          box.height < kHighestLabel * work.frame.height &&
                          pieces.area(i) > kLabelFilled * box.area();
    if (is_label) add_new(labels, box);
  }
  keep_largest(labels);
  return labels;
}

/// Boxes around the larger objects found by any segmentation.
std::vector<cv::Rect> things_in(const WorkingPicture& work) {
  std::vector<cv::Rect> things;
  for (const Segmentation& segmentation : unsupervised_segmentations(work)) {
    for (const Body& body : find_bodies(segmentation, work)) {
      const cv::Rect box = cv::boundingRect(body.mask);
      const double fraction = static_cast<double>(box.area()) / work.frame.area();
      if (fraction > kSmallestThing && fraction < kLargestThing) add_new(things, box);
    }
  }
  keep_largest(things);
  return things;
}

/// The box in the picture, with a margin.
Box in_picture(const cv::Rect& box, const WorkingPicture& work, const Picture& picture) {
  const double margin = kMargin * std::max(box.width, box.height);
  const Point from = work.in_picture({box.x - margin, box.y - margin});
  const Point to = work.in_picture({box.br().x + margin, box.br().y + margin});
  const int left = std::max(0, static_cast<int>(from.x));
  const int top = std::max(0, static_cast<int>(from.y));
  return {.x = left,
          .y = top,
          .width = std::min(picture.width, static_cast<int>(to.x)) - left,
          .height = std::min(picture.height, static_cast<int>(to.y)) - top};
}

bool has_warning(const ReposeAngle& result, std::string_view code) {
  return std::ranges::any_of(result.warnings,
                             [&](const Warning& warning) { return warning.code == code; });
}

/// Extends the box upwards, at most to the picture's edge.
Box twice_as_high(Box box) {
  const int grown = std::min(box.y, box.height);
  box.y -= grown;
  box.height += grown;
  return box;
}

/// Ranks results that have an angle: unflagged first, then by confidence relative to the width of
/// the interval.
struct Plausibility {
  bool is_ok = false;
  double clarity = 0;

  static Plausibility of(const ReposeAngle& result) {
    constexpr double kLeast_rad = 0.1 * kDegree;
    return {
        .is_ok = result.status == MeasureStatus::ok,
        .clarity = result.confidence / std::max(kLeast_rad, result.uncertainty_rad.value_or(1))};
  }
  auto operator<=>(const Plausibility&) const = default;
};

/// Tries proposals, and keeps the most plausible one.
class Trials {
 public:
  Trials(const Picture& picture, const MeasureOptions& options)
      : picture_(picture), options_(options) {}

  const std::optional<Proposal>& best() const { return best_; }

  void attempt(Proposal proposal) {
    ReposeAngle result = measured(proposal);
    while (proposal.heap && proposal.heap->y > 0 && has_warning(result, "crest_cut")) {
      // Only the lower part of the heap was found: its top looks different, for example in shadow.
      proposal.heap = twice_as_high(*proposal.heap);
      result = measured(proposal);
    }
    if (result.status == MeasureStatus::refused) return;
    // Almost any picture shows some slope in one of its turned positions.
    if (proposal.turn_deg != 0 && has_warning(result, "unlike_a_heap")) return;
    const Plausibility plausibility = Plausibility::of(result);
    if (best_ && !(plausibility > best_plausibility_)) return;
    proposal.angle_rad = result.angle_rad;
    proposal.uncertainty_rad = result.uncertainty_rad;
    best_ = proposal;
    best_plausibility_ = plausibility;
  }

 private:
  ReposeAngle measured(const Proposal& proposal) const {
    MeasureOptions changed = options_;
    if (proposal.excluded) changed.excluded.push_back(*proposal.excluded);
    if (proposal.heap) changed.hints.heap = proposal.heap;
    if (proposal.turn_deg == 0) return measure_repose_angle(picture_, changed);
    return measure_repose_angle(turned(picture_, proposal.turn_deg), changed);
  }

  const Picture& picture_;
  const MeasureOptions& options_;
  std::optional<Proposal> best_;
  Plausibility best_plausibility_;
};

/// Whether there are no positions and no lens that would have to be turned with the picture.
bool may_be_turned(const MeasureOptions& options) {
  return options.hints.empty() && options.excluded.empty() && !options.pinhole;
}

Proposal guess_around(const Box& box) {
  const double level = box.y + box.height / (1 + 2 * kMargin) * (1 + kMargin);
  Proposal guess;
  guess.heap = box;
  guess.ground = Segment{{static_cast<double>(box.x), std::round(level)},
                         {static_cast<double>(box.x + box.width), std::round(level)}};
  return guess;
}

}  // namespace

std::optional<Proposal> propose_hint(const Picture& picture, const MeasureOptions& options) {
  const WorkingPicture work = working_picture(picture, options.excluded, options.hints);
  if (std::min(work.frame.width, work.frame.height) < kSmallestFrame) return std::nullopt;
  Trials trials(picture, options);
  for (const cv::Rect& label : labels_in(work)) {
    Proposal proposal;
    proposal.excluded = in_picture(label, work, picture);
    trials.attempt(proposal);
  }
  if (options.hints.heap) return trials.best();
  const std::vector<cv::Rect> things = things_in(work);
  for (const cv::Rect& thing : things) {
    Proposal proposal;
    proposal.heap = in_picture(thing, work, picture);
    trials.attempt(proposal);
  }
  for (const int turn_deg : kTurns_deg) {
    if (!may_be_turned(options)) break;
    Proposal proposal;
    proposal.turn_deg = turn_deg;
    trials.attempt(proposal);
  }
  if (trials.best() || things.empty()) return trials.best();
  return guess_around(in_picture(things.front(), work, picture));
}

}  // namespace repose::vision
