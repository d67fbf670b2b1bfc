#include "vision/measure/repose_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/angle_definition.h"
#include "base/units.h"
#include "vision/measure/camera_pitch.h"
#include "vision/measure/choice.h"
#include "vision/measure/definitions.h"
#include "vision/measure/reading.h"
#include "vision/measure/uncertainty.h"
#include "vision/measure/verdict.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

/// The procedure of the published hazelnut study, for comparison: grey picture, Otsu's threshold,
/// largest region with its holes filled, upper edge, ordinary least squares through each side, mean
/// of the two sides' absolute slopes. Angles are relative to the picture's horizontal; toe and
/// crest are left out only by the window.
SelectedCandidate read_by_paper(const WorkingPicture& work, const MeasureOptions& options) {
  SelectedCandidate choice;
  Reading& reading = choice.best;
  reading.segmentation = grey_otsu(work);
  reading.body = largest_region(reading.segmentation, work);
  if (reading.body.mask.empty()) return choice;
  reading.profile = upper_profile(reading.body, reading.segmentation, work);
  if (reading.profile.size() < 10) return choice;
  const FlankOptions flank{.window_from = options.window_from,
                           .window_to = options.window_to,
                           .leave_apron_out = false,
                           .is_robust = false,
                           .grain = {},
                           .seed = options.seed};
  reading.left = fit_flank(reading.profile, Side::left, flank);
  reading.right = fit_flank(reading.profile, Side::right, flank);
  leave_out_wall(reading, options.hints);
  score(reading, work);
  for (DefinedFlanks& flanks :
       other_flanks({reading.profile, reading.left, reading.right, std::nullopt})) {
    choice.others.push_back({.flanks = std::move(flanks), .disagreement = {}});
  }
  return choice;
}

constexpr double kNarrowestWindow = 0.1;
constexpr double kLargestPitch_rad = 30 * std::numbers::pi / 180;
constexpr int kSmallestSide = 64;

// Assumed: pitch below which 95 of 100 cameras stay that were levelled by eye, and that of cameras
// that see an edge behind the heap cross it.
constexpr double kPitchByEye_rad = 2 * std::numbers::pi / 180;
constexpr double kPitchOverEdge_rad = 5 * std::numbers::pi / 180;

void check(const Picture& picture, const MeasureOptions& options) {
  std::vector<base::Fault> errors = options.problems();
  if (picture.empty())
    errors.push_back({.value = "the picture is empty", .fix = "read one first."});
  for (base::Fault& fault : options.problems_in(picture.width, picture.height)) {
    errors.push_back(std::move(fault));
  }
  if (!errors.empty()) throw base::InputError(std::move(errors));
}

/// Pitch that a camera assumed level may have: from the base's bow, if the base is the heap's own
/// (a plate's front edge is straight from any viewpoint).
double assumed_pitch_rad(const Reading& reading) {
  const Ground& ground = reading.body.ground;
  const Profile& profile = reading.profile;
  if (ground.behind) return kPitchOverEdge_rad;
  const bool goes_beyond_heap = profile.leaves_frame_left || profile.leaves_frame_right ||
                                reading.left.apron || reading.right.apron;
  if (goes_beyond_heap || !ground.bow) return kPitchByEye_rad;
  return pitch_from_bow(*ground.bow);
}

/// Corrects the angles of one reading for the camera's pitch, if it is known.
class PitchCorrection {
 public:
  PitchCorrection(const Reading& reading, const WorkingPicture& work, const MeasureOptions& options)
      : pitch_rad_(options.camera_pitch_rad),
        deviation_rad_(options.camera_pitch_uncertainty_rad),
        assumed_rad_(assumed_pitch_rad(reading)) {
    const Profile& profile = reading.profile;
    const GroundFrame ground(reading.body.ground);
    const Point crest = ground.picture(profile.along[profile.crest], profile.crest_height);
    const double middle = work.frame.y + work.frame.height / 2.0;
    const double radius = (profile.along.back() - profile.along.front()) / 2;
    if (radius > 0) crest_rise_ = (middle - crest.y) / radius;
    if (!options.pinhole) return;
    const double below = work.in_picture(crest).y - options.pinhole->centre.y;
    const double aside = work.in_picture(crest).x - options.pinhole->centre.x;
    below_axis_rad_ = std::atan(below / options.pinhole->focal_px);
    aside_rad_ = std::atan(aside / options.pinhole->focal_px);
  }

  double angle_rad(double apparent_rad) const {
    return without_pitch(apparent_rad, pitch_rad_.value_or(0));
  }
  /// Effect of the camera's unknown distance or pitch, half-width.
  double camera_rad(double apparent_rad) const {
    if (!pitch_rad_) return assumed_pitch_error(apparent_rad, assumed_rad_);
    const double distance_rad =
        below_axis_rad_ ? 0 : far_camera_error(apparent_rad, *pitch_rad_, crest_rise_);
    return std::hypot(distance_rad, pitch_error_rad(apparent_rad));
  }
  /// Including that. An unknown pitch always lowers the angle, so it is not random and not added in
  /// quadrature.
  double half_width_rad(double apparent_rad, double own_rad) const {
    const double camera = camera_rad(apparent_rad);
    return pitch_rad_ ? std::hypot(own_rad, camera) : own_rad + camera;
  }

 private:
  double without_pitch(double apparent_rad, double pitch_rad) const {
    if (!pitch_rad_ || !below_axis_rad_) return angle_without_pitch(apparent_rad, pitch_rad);
    return angle_without_pitch(angle_without_aside(apparent_rad, aside_rad_), pitch_rad,
                               pitch_rad + *below_axis_rad_);
  }
  /// Change of the angle for a pitch at either end of its interval.
  double pitch_error_rad(double apparent_rad) const {
    if (deviation_rad_ <= 0) return 0;
    const double here = angle_rad(apparent_rad);
    return std::max(std::abs(without_pitch(apparent_rad, *pitch_rad_ + deviation_rad_) - here),
                    std::abs(without_pitch(apparent_rad, *pitch_rad_ - deviation_rad_) - here));
  }

  std::optional<double> pitch_rad_;       // as given
  double deviation_rad_;                  // its half-width
  double assumed_rad_;                    // that a camera assumed level may have
  std::optional<double> below_axis_rad_;  // the crest's direction, for a known lens
  double aside_rad_ = 0;                  // likewise
  double crest_rise_ = 0;                 // above the picture's middle / the base's radius
};

/// The side in the picture's own pixels, with its angle corrected for the camera's pitch.
/// @param fit  of the reading's edge, by whichever definition
Flank flank_of(const FlankFit& fit, const Reading& reading, Side side, const WorkingPicture& work,
               double half_width_rad, const PitchCorrection& correction) {
  Flank flank;
  flank.status = fit.status;
  flank.reason = fit.reason;
  flank.leaves_frame =
      side == Side::left ? reading.profile.leaves_frame_left : reading.profile.leaves_frame_right;
  if (fit.status != FlankStatus::ok) return flank;
  flank.angle_rad = correction.angle_rad(fit.angle_rad);
  flank.uncertainty_rad = correction.half_width_rad(fit.angle_rad, half_width_rad);
  flank.window_used = {fit.window_from, fit.window_to};
  flank.least_squares_rad = correction.angle_rad(std::atan(-fit.least_squares.slope));
  flank.robust_rad = correction.angle_rad(std::atan(-fit.robust.slope));
  flank.r2 = fit.least_squares.r2;
  flank.points = static_cast<int>(fit.counted());
  flank.bend_rad = fit.bend_rad;
  flank.other_windows = fit.other_windows;
  for (WindowAngle& window : flank.other_windows) {
    window.angle_rad = correction.angle_rad(window.angle_rad);
  }

  const GroundFrame ground(reading.body.ground);
  const double crest = reading.profile.along[reading.profile.crest];
  const auto place = [&](double out, double height) {
    const double along = side == Side::left ? crest - out : crest + out;
    return work.in_picture(ground.picture(along, height));
  };
  for (std::size_t i = 0; i < fit.counted(); ++i) {
    flank.edge.push_back(place(fit.along[i], fit.height[i]));
  }
  const auto segment = [&](const LineFit& line, double end) {
    const double begin = fit.along.front();
    return Segment{place(begin, line.y(begin)), place(end, line.y(end))};
  };
  flank.line = segment(fit.shown, fit.along[fit.counted() - 1]);
  if (fit.apron) {
    flank.apron = FlankApron{.from = fit.apron->from,
                             .length_px = fit.apron->length * work.shrink,
                             .angle_with_rad = correction.angle_rad(fit.apron->angle_with_rad),
                             .line_with = segment(fit.apron->line_with, fit.along.back())};
  }
  return flank;
}

std::vector<Point> outline_of(const cv::Mat1b& mask, const WorkingPicture& work) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Point> outline;
  if (contours.empty()) return outline;
  std::size_t longest = 0;
  for (std::size_t i = 1; i < contours.size(); ++i) {
    if (contours[i].size() > contours[longest].size()) longest = i;
  }
  for (const cv::Point& p : contours[longest]) {
    outline.push_back(work.in_picture({p.x + 0.5, p.y + 0.5}));
  }
  return outline;
}

bool has_usual_window(const MeasureOptions& options) {
  const MeasureOptions usual;
  return options.window_from == usual.window_from && options.window_to == usual.window_to;
}

std::array<double, 2> window_of(const MeasureOptions& options) {
  if (base::is_usual_definition(options.definition)) {
    return {options.window_from, options.window_to};
  }
  return base::find_definition(options.definition)->window;
}

/// A reading's angle with its interval.
NamedAngle named_angle(const base::AngleDefinition& definition, double apparent_rad, double own_rad,
                       const PitchCorrection& correction) {
  return {.name = std::string(definition.name),
          .description = std::string(definition.description),
          .angle_rad = correction.angle_rad(apparent_rad),
          .uncertainty_rad = correction.half_width_rad(apparent_rad, own_rad),
          .own_uncertainty_rad = own_rad,
          .camera_uncertainty_rad = correction.camera_rad(apparent_rad)};
}

/// The angle and its sides by the requested definition, and by all others. Left empty if the edge
/// has no angle by the requested one.
void add_angles(ReposeAngle& result, const SelectedCandidate& choice, const WorkingPicture& work,
                const PitchCorrection& correction) {
  const Reading& best = choice.best;
  const auto show = [&](const FlankFit& left, const FlankFit& right, const Uncertainty& u) {
    result.left = flank_of(left, best, Side::left, work, u.left_rad, correction);
    result.right = flank_of(right, best, Side::right, work, u.right_rad, correction);
    if (!best.has_flank()) return;
    const double apparent_rad = mean_angle_rad(left, right);
    result.angle_rad = correction.angle_rad(apparent_rad);
    result.uncertainty_rad = correction.half_width_rad(apparent_rad, u.mean_rad);
    result.own_uncertainty_rad = u.mean_rad;
    result.camera_uncertainty_rad = correction.camera_rad(apparent_rad);
  };
  const Uncertainty usual = uncertainty_of(choice);
  if (base::is_usual_definition(result.definition)) {
    show(best.left, best.right, usual);
  } else if (best.has_flank()) {
    result.definitions.push_back(
        named_angle(base::kUsualDefinition, best.angle_rad(), usual.mean_rad, correction));
  }
  for (const SelectedFlanks& other : choice.others) {
    const DefinedFlanks& flanks = other.flanks;
    const Uncertainty u = uncertainty_of(other, best);
    if (flanks.definition->name == result.definition) {
      show(flanks.left, flanks.right, u);
    } else {
      result.definitions.push_back(
          named_angle(*flanks.definition, flanks.angle_rad(), u.mean_rad, correction));
    }
  }
}

/// Everything found, in the picture's own pixels; judged later.
ReposeAngle described(const SelectedCandidate& choice, const WorkingPicture& work,
                      const MeasureOptions& options) {
  const Reading& best = choice.best;
  ReposeAngle result;
  result.method = options.method;
  result.definition = options.named_definition();
  result.window = window_of(options);
  result.camera_pitch_rad = options.camera_pitch_rad;
  result.segmentation = best.segmentation.name;
  if (best.body.mask.empty() || best.profile.size() == 0) return result;
  const PitchCorrection correction(best, work, options);
  add_angles(result, choice, work, correction);
  result.ground_tilt_rad = best.body.ground.tilt_rad();
  const GroundFrame ground(best.body.ground);
  result.ground = Segment{work.in_picture(ground.picture(best.profile.along.front(), 0)),
                          work.in_picture(ground.picture(best.profile.along.back(), 0))};
  result.outline = outline_of(best.body.mask, work);
  for (std::size_t i = 0; i < best.profile.size(); ++i) {
    const Point edge = ground.picture(best.profile.along[i], best.profile.height[i]);
    result.upper_edge.push_back(work.in_picture(edge));
  }
  const double crest = best.profile.along[best.profile.crest];
  result.crest = work.in_picture(ground.picture(crest, best.profile.crest_height));
  result.height_px = best.profile.crest_height * work.shrink;
  result.base_bow = best.body.ground.bow;
  result.foot_occluded = best.body.ground.behind;
  result.base_px = (best.profile.along.back() - best.profile.along.front()) * work.shrink;
  if (best.grain) result.grain_px = *best.grain * work.shrink;
  result.loose_particles = count_strays(best.body, best.segmentation, work);
  return result;
}

ReposeAngle too_small(const Picture& picture, const MeasureOptions& options) {
  ReposeAngle result;
  result.method = options.method;
  result.definition = options.named_definition();
  result.window = window_of(options);
  result.camera_pitch_rad = options.camera_pitch_rad;
  result.reason = fmt::format(
      "too little of the {} x {} pixels remains to measure in. Fix: use a picture of at least {} "
      "pixels each way, not much longer than wide, with a heap 100 pixels high.",
      picture.width, picture.height, kSmallestSide);
  return result;
}

}  // namespace

std::string MeasureOptions::named_definition() const {
  const bool is_named = method == Method::automatic && has_usual_window(*this);
  return is_named ? std::string(base::definition_meant(definition)) : std::string();
}

std::string MeasureOptions::definition_text() const {
  const std::string name = named_definition();
  if (name == base::kUsualDefinition.name) return {};
  if (!name.empty()) return fmt::format("{}: {}", name, base::find_definition(name)->description);
  return fmt::format("{} at {:.0f}-{:.0f} % of the height",
                     method == Method::paper ? "the paper's line" : "line", 100 * window_from,
                     100 * window_to);
}

std::vector<base::Fault> MeasureOptions::problems() const {
  std::vector<base::Fault> errors;
  // Written so that NaN fails.
  if (!(window_from >= 0 && window_to <= 1 && window_to - window_from >= kNarrowestWindow)) {
    errors.push_back(
        {.subject = "window",
         .value = fmt::format("= {},{}", window_from, window_to),
         .rule = fmt::format(
             "must be two increasing fractions of the heap's height from 0 to 1, at least {} apart",
             kNarrowestWindow),
         .fix = "try 0.2,0.8."});
  }
  const auto add_definition = [&](std::string rule, std::string fix) {
    errors.push_back({.subject = "definition",
                      .value = fmt::format("= {}", definition),
                      .rule = std::move(rule),
                      .fix = std::move(fix)});
  };
  if (!definition.empty() && base::find_definition(definition) == nullptr) {
    add_definition(fmt::format("must be one of {}", base::definition_names()),
                   "give one of these.");
  } else if (!definition.empty() && method == Method::paper) {
    add_definition("the paper's method is a definition of its own",
                   "leave one of them out; whole_flank is the line through the whole edge.");
  } else if (!definition.empty() && !has_usual_window(*this)) {
    add_definition("each definition has its own window", "leave one of them out.");
  }
  if (camera_pitch_rad && !(std::abs(*camera_pitch_rad) <= kLargestPitch_rad)) {
    errors.push_back(
        {.subject = "camera pitch",
         .value = fmt::format("= {:.1f} degrees", to_degrees(*camera_pitch_rad)),
         .rule = "must lie within -30 and 30",
         .fix = "give the angle by which the camera looks down, or take the picture with a level "
                "camera."});
  }
  for (const Box& box : excluded) {
    if (box.x >= 0 && box.y >= 0 && box.width >= 1 && box.height >= 1) continue;
    errors.push_back({.subject = "excluded box",
                      .value = fmt::format("= {},{},{},{}", box.x, box.y, box.width, box.height),
                      .rule = "must begin at 0,0 or beyond, and be at least 1 pixel wide and high",
                      .fix = "count from the picture's top left corner."});
  }
  return errors;
}

std::vector<base::Fault> MeasureOptions::problems_in(int width, int height) const {
  std::vector<base::Fault> errors;
  for (const Box& box : excluded) {
    if (box.width <= width - box.x && box.height <= height - box.y) continue;
    errors.push_back(
        {.subject = "excluded box",
         .value = fmt::format("= {},{},{},{}", box.x, box.y, box.width, box.height),
         .rule = fmt::format("must lie inside the {} x {} picture", width, height),
         .fix = "give the top-left pixel, width and height in pixels of the picture."});
  }
  for (base::Fault& fault : problems_of(hints, width, height)) {
    errors.push_back(std::move(fault));
  }
  return errors;
}

std::optional<double> angle_by(const ReposeAngle& measured, std::string_view definition) {
  if (measured.status == MeasureStatus::refused) return std::nullopt;
  if (definition.empty() || definition == measured.definition) return measured.angle_rad;
  for (const NamedAngle& other : measured.definitions) {
    if (other.name == definition) return other.angle_rad;
  }
  return std::nullopt;
}

ReposeAngle measure_repose_angle(const Picture& picture, const MeasureOptions& options) {
  check(picture, options);
  keep_opencv_to_one_thread();
  const WorkingPicture work = working_picture(picture, options.excluded, options.hints);
  if (std::min(work.frame.width, work.frame.height) < kSmallestSide) {
    return too_small(picture, options);
  }
  const SelectedCandidate choice = options.method == Method::paper ? read_by_paper(work, options)
                                                                   : choose_reading(work, options);
  ReposeAngle result = described(choice, work, options);
  judge(result, choice, options);
  result.reason = base::with_names(result.reason, options.names);
  for (Warning& warning : result.warnings) {
    warning.message = base::with_names(warning.message, options.names);
  }
  return result;
}

}  // namespace repose::vision
