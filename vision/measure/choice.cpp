#include "vision/measure/choice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/measure/refinement.h"
#include "vision/measure/regions.h"
#include "vision/measure/segmentation.h"
#include "vision/measure/traced_edge.h"

namespace repose::vision {

namespace {

/// 0 outside the heap.
double height_at(const Profile& profile, double along) {
  const auto after = std::lower_bound(profile.along.begin(), profile.along.end(), along);
  if (after == profile.along.end()) return 0;
  if (after == profile.along.begin() && along < *after) return 0;
  return profile.height[static_cast<std::size_t>(after - profile.along.begin())];
}

}  // namespace

double edge_distance(const Reading& one, const Reading& other) {
  const double crest = one.profile.along[one.profile.crest];
  double squares = 0;
  std::size_t points = 0;
  for (const Side side : {Side::left, Side::right}) {
    const FlankFit& flank = one.flank(side);
    for (std::size_t i = 0; i < flank.along.size(); ++i) {
      const double along = side == Side::left ? crest - flank.along[i] : crest + flank.along[i];
      const double away = height_at(other.profile, along) - flank.height[i];
      squares += away * away;
    }
    points += flank.along.size();
  }
  if (points == 0) return 0;
  return std::sqrt(squares / static_cast<double>(points)) / one.profile.crest_height;
}

namespace {

constexpr double kNearlyAsGood = 0.85;  // of the best score
constexpr double kEquallyGood = 0.9;    // of the best score: a difference due to chance
constexpr double kClearlyGood = 0.6;    // score above which GrabCut has nothing to add

constexpr double kAgreement_rad = 0.3 * std::numbers::pi / 180;
constexpr double kFairlyGood = 0.5;     // score below which texture is tried, and no foot is seen
constexpr double kHardlyAnEdge = 0.25;  // score of a chance line through clutter
constexpr double kSeesTheHeap = 0.5;    // of the best score: such a reading knows where the foot is
constexpr double kCrossed = 0.1;        // of the heap's height above its foot: not a line's error
constexpr double kSameLine_px = 3;      // ground lines of two segmentations this close are the same
constexpr double kSameEdgeTolerance =
    0.06;  // of the height, root mean square: above this, edges are different ones
constexpr double kCarried = 0.8;  // of a body's columns, under which another body begins

/// A body with upright sides: more significant than a chance line through clutter.
bool is_upright(const Reading& reading) {
  return !reading.has_flank() && (reading.left.vertical || reading.right.vertical);
}

/// Root mean square distance of the rivals from the best.
double rms(const std::vector<double>& distance) {
  double sum = 0;
  for (const double d : distance) sum += d * d;
  return distance.empty() ? 0 : std::sqrt(sum / static_cast<double>(distance.size()));
}

/// For readings, or for their flanks by one definition.
template <class Flanks>
Disagreement disagreement_of(const Flanks& best, const std::vector<const Flanks*>& rivals) {
  const auto of_side = [&](Side side) {
    std::vector<double> distance;
    for (const Flanks* rival : rivals) {
      const FlankFit& mine = best.flank(side);
      const FlankFit& other = rival->flank(side);
      if (mine.status != FlankStatus::ok || other.status != FlankStatus::ok) continue;
      distance.push_back(other.angle_rad - mine.angle_rad);
    }
    return rms(distance);
  };
  std::vector<double> distance;
  for (const Flanks* rival : rivals) distance.push_back(rival->angle_rad() - best.angle_rad());
  return {.left_rad = of_side(Side::left),
          .right_rad = of_side(Side::right),
          .mean_rad = rms(distance)};
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

/// One segmentation shows everything, or several show the same sharp edge: a second look would add
/// nothing.
bool is_settled(const Reading& best, const std::vector<Reading>& readings) {
  if (best.segmentation.name == kTwoTones) return true;
  const std::vector<const Reading*> rivals = rivals_of(best, readings);
  return best.score > kClearlyGood && rivals.size() >= 2 &&
         disagreement_of(best, rivals).mean_rad < kAgreement_rad;
}

const Reading& best_of(const std::vector<Reading>& readings) {
  return *std::max_element(readings.begin(), readings.end(),
                           [](const Reading& a, const Reading& b) { return a.score < b.score; });
}

/// The one that finds most of the object in the user's box.
const Reading& largest_of(const std::vector<Reading>& readings) {
  const auto area = [](const Reading& reading) {
    return reading.body.mask.empty() ? 0 : cv::countNonZero(reading.body.mask);
  };
  return *std::max_element(readings.begin(), readings.end(),
                           [&](const Reading& a, const Reading& b) { return area(a) < area(b); });
}

/// Of the readings with scores that differ only by chance, the one with the median angle: swapping
/// their order then changes little.
const Reading& middle_of_best(const std::vector<Reading>& readings) {
  const double enough = kEquallyGood * best_of(readings).score;
  std::vector<const Reading*> good;
  for (const Reading& reading : readings) {
    if (reading.score >= enough) good.push_back(&reading);
  }
  std::stable_sort(good.begin(), good.end(), [](const Reading* a, const Reading* b) {
    return a->angle_rad() < b->angle_rad();
  });
  const Reading* upper = good[good.size() / 2];
  const Reading* lower = good[(good.size() - 1) / 2];
  return lower->score > upper->score ? *lower : *upper;
}

/// Whether the heap of another reading begins below the middle of the upper one's: the heap stands
/// on it, or the upper reading includes both.
/// @param below  the other's body, column by column; no columns if it has none
bool stands_on(const Reading& upper, const Spans& below) {
  if (upper.body.mask.empty() || below.top.empty()) return false;
  const GroundFrame ground(upper.body.ground);
  const Profile& profile = upper.profile;
  int columns = 0;
  int carried = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    if (profile.height[i] < profile.crest_height / 2) continue;  // its own plate, perhaps
    ++columns;
    const Point middle = ground.picture(profile.along[i], profile.height[i] / 2);
    const double last = static_cast<double>(below.top.size()) - 1;
    const auto col = static_cast<std::size_t>(std::clamp(middle.x, 0.0, last));
    carried += below.top[col] > middle.y ? 1 : 0;
  }
  return carried >= kCarried * columns;
}

/// Whatever carries a heap is not a heap: a plate seen from slightly above has flanks, too, where
/// the frame or its own corners end it, and often a sharper edge than the grains.
void leave_out_plates(std::vector<Reading>& readings) {
  std::vector<Reading> heaps;
  for (const Reading& reading : readings) {
    const Spans spans = spans_of(reading.body.mask);
    const bool carries = std::any_of(readings.begin(), readings.end(), [&](const Reading& other) {
      return other.score >= kSeesTheHeap * reading.score && other.score > kHardlyAnEdge &&
             !other.profile.leaves_frame_top && stands_on(other, spans);
    });
    if (!carries) heaps.push_back(reading);
  }
  if (!heaps.empty()) readings = std::move(heaps);
}

/// Whether a reading shows the foot of a heap seen from slightly above: a round base, which bows.
bool sees_round_foot(const Reading& reading) {
  const Ground& ground = reading.body.ground;
  const Profile& profile = reading.profile;
  return reading.score >= kFairlyGood && !ground.behind && ground.bow.value_or(0) > kFlatBase &&
         !reading.left.apron && !reading.right.apron && !profile.leaves_frame_left &&
         !profile.leaves_frame_right;
}

/// Where the reading's ground line passes below its crest.
Point below_crest(const Reading& reading) {
  const Profile& profile = reading.profile;
  return GroundFrame(reading.body.ground).picture(profile.along[profile.crest], 0);
}

/// Lines that cross a heap whose round foot another reading shows are behind it, as is any line
/// close to one that another reading marks as behind.
void mark_edges_behind(std::vector<Reading>& readings) {
  const std::vector<Reading> witnesses = readings;
  for (const Reading& witness : witnesses) {
    if (witness.score < kFairlyGood) continue;
    const Point foot = below_crest(witness);
    const double crossed = kCrossed * witness.profile.crest_height;
    for (Reading& reading : readings) {
      const double above = foot.y - reading.body.ground.y(foot.x);
      const bool is_crossed = sees_round_foot(witness) && above > crossed;
      const bool is_same = witness.body.ground.behind && std::abs(above) < kSameLine_px;
      if (is_crossed || is_same) reading.body.ground.behind = true;
    }
  }
}

/// A line that crosses the heap is not what it stands on. It is left out if a reading shows the
/// heap down to its foot; otherwise only the flanks above the line are visible, and they are
/// measured from it.
void prefer_seen_feet(std::vector<Reading>& readings) {
  mark_edges_behind(readings);
  const bool is_foot_seen =
      std::any_of(readings.begin(), readings.end(), [](const Reading& reading) {
        return reading.score >= kFairlyGood && !reading.body.ground.behind;
      });
  if (!is_foot_seen) return;
  std::erase_if(readings, [](const Reading& reading) { return reading.body.ground.behind; });
}

bool is_same_line(const PictureLine& a, const PictureLine& b) {
  return a.y_at_0 == b.y_at_0 && a.slope == b.slope;
}

/// Reads the heap again, with every segmentation that shows it, on their common ground.
void agree_on_ground(std::vector<Reading>& readings, const WorkingPicture& work,
                     const MeasureOptions& options) {
  const Reading& best = best_of(readings);
  const GroundFrame frame(best.body.ground);
  const Base base{frame.picture(best.profile.along.front(), 0).x,
                  frame.picture(best.profile.along.back(), 0).x};
  std::vector<Ground> candidates;
  for (const Reading& reading : readings) {
    if (reading.score >= kSeesTheHeap * best.score) candidates.push_back(reading.body.ground);
  }
  Ground ground = best_ground(candidates, base, work);
  ground.bow = best.body.ground.bow;  // of the base that the sharpest edge belongs to
  const double enough = kNearlyAsGood * best.score;
  std::vector<Reading> anew;
  for (const Reading& reading : readings) {
    if (reading.score < enough) continue;
    Reading moved = reading;
    moved.body.ground = ground;
    const bool stands_there = is_same_line(reading.body.ground, ground);
    anew.push_back(stands_there ? std::move(moved)
                                : read_again(moved, reading.segmentation, work, options));
  }
  // A reading that makes sense only on its own ground is discarded, unless all of them do.
  if (best_of(anew).score >= enough) readings = std::move(anew);
}

/// Adds readings from segmentations that start from the best body so far.
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

/// Between a box and a ground line there is one heap. Readings of another edge than the traced one
/// show something else.
void keep_what_is_traced(std::vector<Reading>& readings) {
  const auto traced = std::find_if(readings.begin(), readings.end(), [](const Reading& reading) {
    return reading.segmentation.name == kTraced && reading.has_flank();
  });
  if (traced == readings.end() || traced->score < kSeesTheHeap * best_of(readings).score) return;
  std::vector<Reading> same;
  for (const Reading& reading : readings) {
    if (reading.has_flank() && edge_distance(*traced, reading) <= kSameEdgeTolerance)
      same.push_back(reading);
  }
  readings = std::move(same);
}

/// Readings that need only the picture and the user's hints.
std::vector<Reading> first_readings(const WorkingPicture& work, const MeasureOptions& options) {
  if (work.tones && work.told.empty()) {
    return {read_heap(two_tone_segmentation(work, *work.tones), work, options)};
  }
  std::vector<Reading> readings;
  for (const Segmentation& segmentation : unsupervised_segmentations(work)) {
    readings.push_back(read_heap(segmentation, work, options));
  }
  if (best_of(readings).score < kFairlyGood) {
    readings.push_back(read_heap(rough_segmentation(work), work, options));
  }
  if (work.told.has_box || work.told.has_places()) {
    readings.push_back(read_heap(seeded_segmentation(work, options.seed), work, options));
  }
  if (work.told.has_box && work.told.ground) {
    readings.push_back(read_heap(traced_segmentation(work), work, options));
    keep_what_is_traced(readings);
  }
  return readings;
}

std::vector<DefinedFlanks> other_flanks_of(const Reading& reading) {
  return other_flanks({.profile = reading.profile,
                       .left = reading.left,
                       .right = reading.right,
                       .grain = reading.grain});
}

std::vector<SelectedFlanks> select_others(const Reading& best,
                                          const std::vector<const Reading*>& rivals) {
  std::vector<std::vector<DefinedFlanks>> theirs;
  for (const Reading* rival : rivals) theirs.push_back(other_flanks_of(*rival));
  std::vector<SelectedFlanks> others;
  for (DefinedFlanks& mine : other_flanks_of(best)) {
    std::vector<const DefinedFlanks*> same;
    for (const auto& all : theirs) {
      for (const DefinedFlanks& flanks : all) {
        if (flanks.definition == mine.definition) same.push_back(&flanks);
      }
    }
    const Disagreement disagreement = disagreement_of(mine, same);
    others.push_back({.flanks = std::move(mine), .disagreement = disagreement});
  }
  return others;
}

}  // namespace

const SelectedFlanks* SelectedCandidate::by(std::string_view definition) const {
  for (const SelectedFlanks& other : others) {
    if (other.flanks.definition->name == definition) return &other;
  }
  return nullptr;
}

SelectedCandidate choose_reading(const WorkingPicture& work, const MeasureOptions& options) {
  std::vector<Reading> readings = first_readings(work, options);
  const bool knows_ground = work.told.ground.has_value();
  if (!knows_ground) {
    leave_out_plates(readings);
    prefer_seen_feet(readings);
  }
  SelectedCandidate choice;
  choice.is_pointed_at = !work.told.on_heap.empty();
  if (best_of(readings).score < kHardlyAnEdge && work.told.has_box) {
    choice.best = largest_of(readings);  // explains best why there is no angle
    if (!choice.best.has_flank()) return choice;
  } else if (best_of(readings).score < kHardlyAnEdge) {
    const auto upright = std::find_if(readings.begin(), readings.end(), is_upright);
    if (upright != readings.end()) {
      choice.best = *upright;
      return choice;
    }
  }
  if (best_of(readings).score > 0 && !knows_ground) agree_on_ground(readings, work, options);
  const bool is_traced = best_of(readings).segmentation.name == kTraced;
  if (best_of(readings).score > 0 && !is_traced && !is_settled(best_of(readings), readings)) {
    look_again(readings, work, options);
    keep_what_is_traced(readings);
  }
  const Reading& best = middle_of_best(readings);
  const std::vector<const Reading*> rivals = rivals_of(best, readings);
  choice.disagreement = disagreement_of(best, rivals);
  choice.others = select_others(best, rivals);
  choice.best = best;
  if (best.has_flank()) choice.likeness = likeness_of(best, work);
  return choice;
}

}  // namespace repose::vision
