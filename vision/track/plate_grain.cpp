#include "vision/track/plate_grain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "vision/film/film_reader.h"
#include "vision/film/scene_change.h"
#include "vision/track/blobs.h"

namespace repose::vision {

namespace {

/// Where something seen before is found again.
struct TemplateMatch {
  cv::Point2d moved;      ///< [px]
  double turned_rad = 0;  ///< clockwise
  double likeness = 0;    ///< 1: it looks the same; 0: no better than anything else
};

/// A piece of a picture that is located in others to a fraction of a pixel, by least squares of its
/// colours, each minus its mean. Source: S. Baker, I. Matthews, Lucas-Kanade 20 years on, Int. J.
/// Comput. Vision 56 (2004) 221-255, section 3.2 (the inverse compositional algorithm), for a shift
/// and a rotation about the piece's centre. Valid for shifts of about a pixel from the start, which
/// is first searched for in whole pixels. Checked by track_tilt_test.cpp of tests/vision.
class GrainTemplate {
 public:
  /// @param mask  of the picture's size: the pixels that belong to it
  GrainTemplate(const cv::Mat& bgr, const cv::Mat& mask);

  /// With the expected rotation.
  /// @param expected  where to begin
  /// @param reach_px  how far from there it may be along the rows
  TemplateMatch find(const cv::Mat& bgr, const TemplateMatch& expected, int reach_px) const;
  /// Starts from a place already found and fits the rotation, too.
  TemplateMatch find_turned(const cv::Mat& bgr, const TemplateMatch& found) const;

 private:
  struct Pixel {
    cv::Point2d place;  ///< from the centre
    cv::Vec3f colour;   ///< minus the mean
    cv::Vec3f across, down;
  };

  bool sample(const cv::Mat& bgr, const TemplateMatch& match, std::vector<cv::Vec3f>& seen) const;
  double squares(const std::vector<cv::Vec3f>& seen) const;
  TemplateMatch refined(const cv::Mat& bgr, TemplateMatch match, bool turns) const;

  std::vector<Pixel> pixels_;
  cv::Point2d centre_;
  double contrast_ = 0;         ///< sum of the squared colours
  double mean_square_px2_ = 0;  ///< of the distances from the centre
};

cv::Vec3f at(const cv::Mat& bgr, double x, double y) {
  const int column = cvFloor(x), row = cvFloor(y);
  const auto fx = static_cast<float>(x - column), fy = static_cast<float>(y - row);
  const auto* above = bgr.ptr<cv::Vec3b>(row);
  const auto* below = bgr.ptr<cv::Vec3b>(row + 1);
  return (1 - fy) * ((1 - fx) * cv::Vec3f(above[column]) + fx * cv::Vec3f(above[column + 1])) +
         fy * ((1 - fx) * cv::Vec3f(below[column]) + fx * cv::Vec3f(below[column + 1]));
}

void take_out_mean(std::vector<cv::Vec3f>& colours) {
  cv::Vec3f mean(0, 0, 0);
  const auto count = static_cast<float>(colours.size());
  for (const cv::Vec3f& one : colours) mean += one / count;
  for (cv::Vec3f& one : colours) one -= mean;
}

GrainTemplate::GrainTemplate(const cv::Mat& bgr, const cv::Mat& mask) {
  std::vector<cv::Vec3f> colours;
  for (int y = 1; y + 1 < bgr.rows; ++y) {
    for (int x = 1; x + 1 < bgr.cols; ++x) {
      if (mask.at<uchar>(y, x) == 0) continue;
      const auto colour = [&](int row, int column) {
        return cv::Vec3f(bgr.at<cv::Vec3b>(row, column));
      };
      colours.push_back(colour(y, x));
      pixels_.push_back({.place = cv::Point2d(x, y),
                         .colour = {},
                         .across = .5F * (colour(y, x + 1) - colour(y, x - 1)),
                         .down = .5F * (colour(y + 1, x) - colour(y - 1, x))});
      centre_ += cv::Point2d(x, y);
    }
  }
  if (pixels_.empty()) return;
  centre_ /= static_cast<double>(pixels_.size());
  take_out_mean(colours);
  for (std::size_t k = 0; k < pixels_.size(); ++k) {
    pixels_[k].place -= centre_;
    pixels_[k].colour = colours[k];
    contrast_ += colours[k].dot(colours[k]);
    mean_square_px2_ +=
        pixels_[k].place.dot(pixels_[k].place) / static_cast<double>(pixels_.size());
  }
}

/// False if its centre would lie outside.
bool GrainTemplate::sample(const cv::Mat& bgr, const TemplateMatch& match,
                           std::vector<cv::Vec3f>& seen) const {
  const double c = std::cos(match.turned_rad), s = std::sin(match.turned_rad);
  const cv::Point2d centre = centre_ + match.moved;
  if (centre.x < 1 || centre.y < 1 || centre.x > bgr.cols - 2 || centre.y > bgr.rows - 2)
    return false;
  seen.clear();
  for (const Pixel& pixel : pixels_) {
    const double x = centre.x + c * pixel.place.x - s * pixel.place.y;
    const double y = centre.y + s * pixel.place.x + c * pixel.place.y;
    seen.push_back(
        at(bgr, std::clamp(x, 0.0, bgr.cols - 1.001), std::clamp(y, 0.0, bgr.rows - 1.001)));
  }
  take_out_mean(seen);
  return true;
}

double GrainTemplate::squares(const std::vector<cv::Vec3f>& seen) const {
  double sum = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const cv::Vec3f off = seen[k] - pixels_[k].colour;
    sum += off.dot(off);
  }
  return sum;
}

TemplateMatch GrainTemplate::refined(const cv::Mat& bgr, TemplateMatch match, bool turns) const {
  constexpr int kRounds = 12;
  constexpr double kEnough_px = .002, kLongest_px = 1.5;
  cv::Matx33d normal = cv::Matx33d::zeros();
  const auto terms_of = [&](const Pixel& pixel, int channel) {
    const double across = pixel.across[channel], down = pixel.down[channel];
    return cv::Vec3d(across, down, turns ? down * pixel.place.x - across * pixel.place.y : 0);
  };
  for (const Pixel& pixel : pixels_) {
    for (int channel = 0; channel < 3; ++channel) {
      const cv::Vec3d terms = terms_of(pixel, channel);
      normal += terms * terms.t();
    }
  }
  // A round object's rotation is undetermined, and stays unchanged.
  constexpr double kRidge = 1e-3, kTurnRidge = .02;
  const double spread = normal(0, 0) + normal(1, 1);
  normal(0, 0) += kRidge * spread;
  normal(1, 1) += kRidge * spread;
  normal(2, 2) += kTurnRidge * spread * mean_square_px2_ + kRidge * spread;
  std::vector<cv::Vec3f> seen;
  for (int round = 0; round < kRounds; ++round) {
    if (!sample(bgr, match, seen)) break;
    cv::Vec3d right(0, 0, 0);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const cv::Vec3f off = seen[k] - pixels_[k].colour;
      for (int channel = 0; channel < 3; ++channel) {
        right += off[channel] * terms_of(pixels_[k], channel);
      }
    }
    const cv::Vec3d step = normal.solve(right, cv::DECOMP_CHOLESKY);
    const double c = std::cos(match.turned_rad), s = std::sin(match.turned_rad);
    cv::Point2d moved(c * step[0] - s * step[1], s * step[0] + c * step[1]);
    const double length = std::hypot(moved.x, moved.y);
    if (length > kLongest_px) moved *= kLongest_px / length;
    match.moved -= moved;
    match.turned_rad -= step[2];
    if (length < kEnough_px) break;
  }
  match.likeness = 0;
  if (contrast_ > 0 && sample(bgr, match, seen)) match.likeness = 1 - squares(seen) / contrast_;
  return match;
}

TemplateMatch GrainTemplate::find(const cv::Mat& bgr, const TemplateMatch& expected,
                                  int reach_px) const {
  constexpr int kRise_px = 1;
  TemplateMatch best = expected;
  double least = std::numeric_limits<double>::infinity();
  std::vector<cv::Vec3f> seen;
  for (int rise = -kRise_px; rise <= kRise_px; ++rise) {
    for (int along = -reach_px; along <= reach_px; ++along) {
      const TemplateMatch one{.moved = expected.moved + cv::Point2d(along, rise),
                              .turned_rad = expected.turned_rad};
      if (!sample(bgr, one, seen)) continue;
      const double off = squares(seen);
      if (off >= least) continue;
      least = off;
      best = one;
    }
  }
  return refined(bgr, best, false);
}

TemplateMatch GrainTemplate::find_turned(const cv::Mat& bgr, const TemplateMatch& found) const {
  return refined(bgr, found, true);
}

/// The backdrop as if nothing stood in front of it: along each row, the median of the surroundings,
/// which extend farther than grains do.
cv::Mat backdrop_of(const cv::Mat& strip) {
  constexpr int kStep_px = 8;
  const int reach = std::max(1, strip.cols / 4);
  const int columns = strip.cols / kStep_px + 1;
  cv::Mat coarse(strip.rows, columns, CV_8UC3);
  std::vector<uchar> values;
  for (int y = 0; y < strip.rows; ++y) {
    for (int k = 0; k < columns; ++k) {
      const int from = std::max(0, k * kStep_px - reach);
      const int to = std::min(strip.cols, k * kStep_px + reach + 1);
      for (int channel = 0; channel < 3; ++channel) {
        values.clear();
        for (int x = from; x < to; ++x) values.push_back(strip.at<cv::Vec3b>(y, x)[channel]);
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        coarse.at<cv::Vec3b>(y, k)[channel] = *middle;
      }
    }
  }
  cv::Mat backdrop;
  cv::resize(coarse, backdrop, strip.size(), 0, 0, cv::INTER_LINEAR);
  return backdrop;
}

OnPlate thing_of(const cv::Mat& mask, const cv::Rect& box) {
  OnPlate thing{.mask = mask};
  const cv::Moments moments = cv::moments(mask, true);
  thing.centre = {moments.m10 / moments.m00, moments.m01 / moments.m00};
  thing.width_px = box.width;
  thing.height_px = box.height;
  const double half_sum = .5 * (moments.mu20 + moments.mu02);
  const double spread = std::hypot(.5 * (moments.mu20 - moments.mu02), moments.mu11);
  thing.elongation = std::sqrt((half_sum + spread) / std::max(1e-9, half_sum - spread));
  thing.touches_edge = box.x <= 1 || box.br().x >= mask.cols - 1 || box.y <= 1;
  return thing;
}

/// Objects that differ from the backdrop to their left and right and reach down to the plate,
/// largest first.
/// @param strip  see strip_picture()
std::vector<OnPlate> standing_things(const cv::Mat& strip) {
  constexpr double kMinDifference = 22, kPartOfMost = .35, kLongest = .5;
  constexpr int kMin_px = 4, kGap_px = 3;
  constexpr std::size_t kMax = 8;
  cv::Mat difference = greatest_difference(strip, backdrop_of(strip));
  cv::GaussianBlur(difference, difference, {3, 3}, 0);
  double most = 0;
  cv::minMaxLoc(difference, nullptr, &most);
  const cv::Mat differs = difference > std::max(kMinDifference, kPartOfMost * most);
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(differs, labels, stats, centres);
  std::vector<std::pair<int, OnPlate>> things;
  for (int label = 1; label < count; ++label) {
    const cv::Rect box(
        stats.at<int>(label, cv::CC_STAT_LEFT), stats.at<int>(label, cv::CC_STAT_TOP),
        stats.at<int>(label, cv::CC_STAT_WIDTH), stats.at<int>(label, cv::CC_STAT_HEIGHT));
    if (box.width < kMin_px || box.height < kMin_px || box.width > kLongest * strip.cols ||
        box.br().y < strip.rows - kGap_px)
      continue;
    things.emplace_back(stats.at<int>(label, cv::CC_STAT_AREA), thing_of(labels == label, box));
  }
  std::stable_sort(things.begin(), things.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<OnPlate> largest;
  for (auto& [area, thing] : things) {
    if (largest.size() < kMax) largest.push_back(std::move(thing));
  }
  return largest;
}

/// A thing with its appearance.
struct FollowedGrain {
  OnPlateTrack track;
  GrainTemplate looks;
  TemplateMatch last = {};
  TemplateMatch before = {};
  double last_s = 0;
  bool is_over = false;
};

/// The strip before anything can have slid: the median of frames up to a few degrees.
cv::Mat first_strip(const FilmFile& file, const PlateMotion& motion, const PlateStrip& strip) {
  constexpr double kBefore_rad = 4 * kDegree;
  constexpr std::size_t kMax = 25;
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < motion.seen.size(); ++k) {
    if (motion.turned_at(motion.seen[k]) > kBefore_rad) break;
    numbers.push_back(k);
  }
  const std::size_t stride = numbers.size() / kMax + 1;
  std::vector<cv::Mat> strips;
  FilmReader film(file);
  FilmFrame frame;
  int at = 0;
  for (std::size_t k = 0; k < numbers.size(); k += stride) {
    const PlateSighting& plate = motion.seen[numbers[k]];
    bool has_more = true;
    for (; at < plate.frame && has_more; ++at) has_more = film.skip(frame);
    if (!has_more || !film.next(frame)) break;
    ++at;
    strips.push_back(
        strip_picture(reduced_frame(frame.bgr, motion.reduction), motion, plate.line, strip));
  }
  return strips.empty() ? cv::Mat() : median_of(strips);
}

/// The area that stays above the plate and everything on it, in the first frame's columns.
cv::Mat above_plate(const PlateMotion& motion, const PlateStrip& strip, const cv::Size& size) {
  cv::Mat above(size, CV_8U, cv::Scalar(0));
  for (int x = 0; x < size.width; ++x) {
    double highest = size.height;
    for (const PlateSighting& one : motion.seen) {
      highest = std::min(highest, one.line.row_at(x));
    }
    const int rows = std::clamp(cvFloor(highest) - strip.size.height / 2, 0, size.height);
    above.col(x).rowRange(0, rows).setTo(255);
  }
  return above;
}

cv::Mat around(const cv::Mat& mask) {
  constexpr int kMargin_px = 2;
  cv::Mat wide;
  cv::dilate(mask, wide, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}), {-1, -1}, kMargin_px);
  return wide;
}

/// Match with rotation: starts from the unrotated place, and for fast rotation also from where it
/// would be if it continued.
TemplateMatch turned_match(const FollowedGrain& followed, const cv::Mat& strip,
                           const TemplateMatch& unturned, int reach_px) {
  constexpr double kFast_rad = 2 * kDegree;
  TemplateMatch begin = unturned;
  begin.turned_rad = followed.last.turned_rad;
  const TemplateMatch near = followed.looks.find_turned(strip, begin);
  const double turns_on = 2 * followed.last.turned_rad - followed.before.turned_rad;
  if (std::abs(turns_on) < kFast_rad) return near;
  const TemplateMatch expected{.moved = 2 * followed.last.moved - followed.before.moved,
                               .turned_rad = turns_on};
  const TemplateMatch on =
      followed.looks.find_turned(strip, followed.looks.find(strip, expected, reach_px));
  return on.likeness > near.likeness ? on : near;
}

void follow(FollowedGrain& followed, const cv::Mat& strip, std::size_t plate, double time_s,
            double sense) {
  constexpr double kPatience_s = .3, kMinLikeness = .25, kMaxRise_px = 4;
  constexpr int kReach_px = 12;
  if (followed.is_over) return;
  const TemplateMatch expected{.moved = 2 * followed.last.moved - followed.before.moved};
  const TemplateMatch match = followed.looks.find(strip, expected, kReach_px);
  const TemplateMatch turned = turned_match(followed, strip, match, kReach_px);
  const TemplateMatch& best = turned.likeness > match.likeness ? turned : match;
  if (best.likeness < kMinLikeness || std::abs(best.moved.y) > kMaxRise_px) {
    followed.is_over = time_s - followed.last_s > kPatience_s;
    return;
  }
  const double unlike = 1 - match.likeness;
  // An object that rolls instead of sliding can be found only by its rotation after a while.
  const bool is_found = match.likeness >= kMinLikeness;
  const cv::Point2d moved = is_found ? match.moved : turned.moved;
  followed.before = followed.last;
  followed.last = {.moved = moved, .turned_rad = turned.turned_rad};
  followed.last_s = time_s;
  OnPlateTrack& track = followed.track;
  track.seen.push_back({.plate = plate,
                        .time_s = time_s,
                        .slid_px = sense * moved.x,
                        .rise_px = -moved.y,
                        .turned_rad = turned.turned_rad,
                        .turn_gain = unlike > 0 ? (turned.likeness - match.likeness) / unlike : 0});
  followed.is_over = track.seen.back().slid_px > track.most_px();
}

}  // namespace

double OnPlateTrack::least_px() const { return std::max(4.0, .2 * thing.height_px); }

double OnPlateTrack::most_px() const { return std::max(40.0, 2.5 * thing.height_px); }

double OnPlateTrack::slid_px() const {
  double most = 0;
  for (const OnPlateSighting& one : seen) most = std::max(most, one.slid_px);
  return most;
}

PlateGrains grains_on_plate(const FilmFile& file, const FilmSurvey& survey,
                            const PlateMotion& motion, const FilmProgress& progress) {
  const cv::Size size = survey.size / motion.reduction;
  PlateGrains grains{.strip = strip_above(motion, size)};
  const cv::Mat first = first_strip(file, motion, grains.strip);
  if (first.empty()) return grains;
  std::vector<FollowedGrain> all;
  for (OnPlate& thing : standing_things(first)) {
    const GrainTemplate looks(first, around(thing.mask));
    all.push_back({.track = {.thing = std::move(thing)}, .looks = looks});
  }
  FilmReader film(file);
  FilmFrame frame;
  std::optional<SceneShift> scene;
  int number = 0;
  for (std::size_t k = 0; k < motion.seen.size(); ++number) {
    if (!film.next(frame)) break;
    const PlateSighting& plate = motion.seen[k];
    if (number < plate.frame) continue;
    const cv::Mat small = reduced_frame(frame.bgr, motion.reduction);
    if (!scene) scene.emplace(small, above_plate(motion, grains.strip, size));
    const cv::Point2d shift = motion.reduction * scene->of(small);
    grains.moved_px = std::max(grains.moved_px, std::hypot(shift.x, shift.y));
    const cv::Mat strip = strip_picture(small, motion, plate.line, grains.strip);
    for (FollowedGrain& one : all) follow(one, strip, k, plate.time_s, motion.sense);
    ++k;
    if (progress) progress(static_cast<double>(k) / static_cast<double>(motion.seen.size()));
  }
  for (FollowedGrain& one : all) grains.tracks.push_back(std::move(one.track));
  return grains;
}

}  // namespace repose::vision
