#include "vision/measure/choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/measure/refinement.h"
#include "vision/measure/segmentation.h"

namespace repose::vision {
namespace {

constexpr double kNearlyAsGood = 0.85;  // of the best score
constexpr double kClearlyGood = 0.6;    // score above which GrabCut has nothing to add

constexpr double kAgreement_rad = 0.3 * std::numbers::pi / 180;
constexpr double kFairlyGood = 0.5;     // score below which texture is tried, too
constexpr double kHardlyAnEdge = 0.25;  // score of a chance line through clutter

/// A body whose sides stand upright: says more than a chance line through clutter.
bool is_upright(const Reading& reading) {
  return !reading.has_flank() && (reading.left.vertical || reading.right.vertical);
}

bool sees(const Reading& reading, Side side) {
  return reading.flank(side).status == FlankStatus::ok;
}

/// Root mean square distance of the rivals from the best.
double rms(const std::vector<double>& distance) {
  double sum = 0;
  for (const double d : distance) sum += d * d;
  return distance.empty() ? 0 : std::sqrt(sum / static_cast<double>(distance.size()));
}

double side_disagreement(const Reading& best, const std::vector<const Reading*>& rivals,
                         Side side) {
  std::vector<double> distance;
  for (const Reading* rival : rivals) {
    if (!sees(best, side) || !sees(*rival, side)) continue;
    distance.push_back(rival->flank(side).angle_rad - best.flank(side).angle_rad);
  }
  return rms(distance);
}

/// The others that score nearly as well.
std::vector<const Reading*> rivals_of(const Reading& best, const std::vector<Reading>& readings) {
  std::vector<const Reading*> rivals;
  for (const Reading& reading : readings) {
    if (&reading != &best && reading.score >= kNearlyAsGood * best.score) {
      rivals.push_back(&reading);
    }
  }
  return rivals;
}

double disagreement(const Reading& best, const std::vector<const Reading*>& rivals) {
  std::vector<double> distance;
  for (const Reading* rival : rivals) distance.push_back(rival->angle_rad() - best.angle_rad());
  return rms(distance);
}

/// Several segmentations see the same sharp edge: another look would tell nothing new.
bool is_settled(const Reading& best, const std::vector<Reading>& readings) {
  const std::vector<const Reading*> rivals = rivals_of(best, readings);
  return best.score > kClearlyGood && rivals.size() >= 2 &&
         disagreement(best, rivals) < kAgreement_rad;
}

const Reading& best_of(const std::vector<Reading>& readings) {
  return *std::max_element(readings.begin(), readings.end(),
                           [](const Reading& a, const Reading& b) { return a.score < b.score; });
}

/// Adds readings of segmentations that start from the best body so far.
void look_again(std::vector<Reading>& readings, const WorkingPicture& work,
                const MeasureOptions& options) {
  const Reading best = best_of(readings);
  Reading learned = read_again(best, learned_segmentation(work, best.body), work, options);
  const bool clear = std::max(best.score, learned.score) > kClearlyGood;
  if (learned.score > 0) readings.push_back(std::move(learned));
  if (clear) return;
  const Reading cut =
      read_again(best, grabcut_segmentation(work, best.body, options.seed), work, options);
  if (cut.body.mask.empty()) return;
  Segmentation fine = learned_segmentation(work, cut.body);
  fine.name = "grabcut, learned";
  Reading again = read_again(cut, fine, work, options);
  if (again.score > 0) readings.push_back(std::move(again));
}

}  // namespace

Choice choose_reading(const WorkingPicture& work, const MeasureOptions& options) {
  std::vector<Reading> readings;
  for (const Segmentation& segmentation : blind_segmentations(work)) {
    readings.push_back(read_heap(segmentation, work, options));
  }
  if (best_of(readings).score < kFairlyGood) {
    readings.push_back(read_heap(rough_segmentation(work), work, options));
  }
  Choice choice;
  if (best_of(readings).score < kHardlyAnEdge) {
    const auto upright = std::find_if(readings.begin(), readings.end(), is_upright);
    if (upright != readings.end()) {
      choice.best = *upright;
      return choice;
    }
  }
  if (best_of(readings).score > 0 && !is_settled(best_of(readings), readings)) {
    look_again(readings, work, options);
  }
  const Reading& best = best_of(readings);
  const std::vector<const Reading*> rivals = rivals_of(best, readings);
  choice.disagreement_rad = disagreement(best, rivals);
  choice.left_disagreement_rad = side_disagreement(best, rivals, Side::left);
  choice.right_disagreement_rad = side_disagreement(best, rivals, Side::right);
  choice.best = best;
  return choice;
}

}  // namespace repose::vision
