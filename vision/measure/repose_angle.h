#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/input_error.h"
#include "vision/measure/hints.h"
#include "vision/picture/picture.h"

/// Static angle of repose of a heap from one side-view photograph or rendered silhouette.
///
/// Angles are radians, from the ground line, positive; uncertainties are half-widths of 95 %
/// intervals. A number that does not exist is an empty optional, never 0.

namespace repose::vision {

enum class Method {
  automatic,  ///< candidate segmentations, ground line, crest left out, apron weighed, robust line
  paper,      ///< grey, Otsu, holes filled, edge, ordinary least squares on each side
};

/// A lens without distortion.
struct Pinhole {
  double focal_px = 0;
  Point centre;  ///< where its axis meets the picture [px]
};

struct MeasureOptions {
  Method method = Method::automatic;
  /// Stretch of the flank that is fitted: between the points where the edge, smoothed over three
  /// grains, has these fractions of the heap's height above the ground line. Lower values let in
  /// the spreading toe, higher ones the rounded crest; both flatten the line.
  double window_from = 0.2;
  double window_to = 0.8;
  /// Which definition of base/angle_definition.h to use; empty: the default. Each other definition
  /// has its own window and its own lines.
  std::string definition;
  /// Parts of the picture to ignore: timers, labels, hands [px of the picture].
  std::vector<Box> excluded;
  /// User hints for pictures that the program cannot read unaided.
  Hints hints;
  /// Camera's downward pitch; the angle is corrected for it as for a distant camera. The interval
  /// allows for cameras down to 6 base radii away, with the picture's middle on the lens's axis.
  /// std::nullopt: not given, and assumed level; the interval then allows for the pitch implied by
  /// the bow of the base.
  std::optional<double> camera_pitch_rad = {};
  /// Half-width of the pitch's 95 % interval if it was measured; 0: treated as exact.
  double camera_pitch_uncertainty_rad = 0;
  /// If given, the angle is corrected for the pitch as this lens sees the heap, from any distance.
  std::optional<Pinhole> pinhole = {};
  /// Same picture + same seed = same bytes (bootstrap, GrabCut).
  std::uint64_t seed = 1;
  /// The user's names for "camera pitch", "excluded box" and "heap box", for reasons and warnings
  /// that suggest them.
  base::FieldNames names = {};

  /// Name in base/angle_definition.h of the definition in use; empty: none of them, because of a
  /// custom window or another method.
  std::string named_definition() const;
  /// The same in words, for results by other than the default definition: "height_over_base: crest
  /// height over ...", "line at 10-90 % of the height". Empty: the default.
  std::string definition_text() const;
  /// Empty if usable; otherwise one entry per error.
  std::vector<base::Fault> problems() const;
  /// The same for what is invalid in a picture of that size.
  std::vector<base::Fault> problems_in(int width, int height) const;
};

enum class MeasureStatus {
  ok,       ///< the number and its interval can be used
  flagged,  ///< a number, but a warning says why a person must check it first
  refused,  ///< no number; `reason` says why and what to do
};

enum class FlankStatus { ok, absent, truncated };

/// Something the user should know. `code` is stable (snake_case), `message` is a sentence.
struct Warning {
  std::string code;
  std::string message;
};

/// The line's angle over another stretch of the same flank.
struct WindowAngle {
  double window_from = 0;
  double window_to = 0;
  double angle_rad = 0;
};

/// A foot so much flatter than the flank above it that it has less than half weight in the line.
struct FlankApron {
  double from = 0;            ///< where it begins, as a fraction of the heap's height
  double length_px = 0;       ///< from there to the foot
  double angle_with_rad = 0;  ///< of this side if the apron counted in full
  Segment line_with = {};     ///< the line that would give it, over the whole window [px]
};

struct Flank {
  FlankStatus status = FlankStatus::absent;
  std::string reason;               ///< why it is absent or truncated
  bool leaves_frame = false;        ///< the picture's edge hides its foot
  std::optional<double> angle_rad;  ///< the method's angle of this side
  /// Stretch that was fitted, as fractions of the heap's height: the window of the options,
  /// shortened if the frame cuts the side off or an apron begins.
  std::optional<std::array<double, 2>> window_used;
  std::optional<double> uncertainty_rad;    ///< 95 % half-width
  std::optional<double> least_squares_rad;  ///< ordinary least squares, y on x
  std::optional<double> robust_rad;         ///< Tukey loss
  std::optional<double> r2;                 ///< of the least-squares line
  int points = 0;                           ///< edge points in the line
  /// Angle of the window's upper half minus that of its lower half: > 0 is a hollow (concave)
  /// flank.
  std::optional<double> bend_rad;
  std::vector<WindowAngle> other_windows;
  std::optional<FlankApron> apron;  ///< std::nullopt: none within the window
  std::optional<Segment> line;      ///< the fitted line over the stretch that was fitted [px]
  std::vector<Point> edge;          ///< the edge points it was fitted to [px]
};

/// The angle by another common definition. Always named beside the number.
struct NamedAngle {
  std::string name;         ///< of base/angle_definition.h: "height_over_base"
  std::string description;  ///< one line: what is divided by what
  double angle_rad = 0;
  std::optional<double> uncertainty_rad = {};         ///< these three as in ReposeAngle;
  std::optional<double> own_uncertainty_rad = {};     ///< std::nullopt for an outline
  std::optional<double> camera_uncertainty_rad = {};  ///<
};

struct ReposeAngle {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason;               ///< if refused: what is wrong and how to fix it
  bool outline_valid = false;       ///< if refused: only the angle was, not the outline
  std::optional<double> angle_rad;  ///< mean of the sides that exist
  std::optional<double> uncertainty_rad;
  /// Its parts, also half-widths: this picture's own uncertainty, and that of the camera's pitch
  /// and distance, which all pictures taken the same way have in common.
  std::optional<double> own_uncertainty_rad;
  std::optional<double> camera_uncertainty_rad;
  Flank left;
  Flank right;
  std::optional<double>
      ground_tilt_rad;            ///< of the ground line in the picture, > 0: right end lower
  std::optional<Segment> ground;  ///< ground line over the heap's base [px]
  /// One of base/angle_definition.h; empty: a custom window, or another method.
  std::string definition;
  std::array<double, 2> window = {0.2, 0.8};
  Method method = Method::automatic;
  std::optional<double> camera_pitch_rad;  ///< as given
  std::string segmentation;                ///< name of the chosen segmentation
  double confidence = 0;                   ///< 0 to 1
  std::vector<Warning> warnings;
  std::vector<Point> outline;       ///< silhouette of the heap's body, closed [px]
  std::vector<Point> upper_edge;    ///< ... its upper side, left to right, subpixel [px]
  std::optional<Point> crest;       ///< middle of the highest part, on the lightly smoothed edge
  std::optional<double> height_px;  ///< crest above the ground line
  std::optional<double> base_px;    ///< width of the base along the ground line
  std::optional<double> base_bow;   ///< downward bow of the base / base_px; std::nullopt: not seen
  bool foot_occluded = false;       ///< the ground line is an edge behind the heap
  std::optional<double> grain_px;   ///< typical grain size, from the body's pattern
  int loose_particles = 0;          ///< grains lying apart from the body
  std::vector<NamedAngle> definitions;  ///< the same heap by the other definitions
};

/// The angle by a definition of base/angle_definition.h; empty: the one it was measured by.
/// std::nullopt if it could not be measured, as in refused pictures.
std::optional<double> angle_by(const ReposeAngle& measured, std::string_view definition);

/// Measures one picture. Deterministic; safe to call from several threads at once. The first call
/// sets OpenCV to one thread for the whole process.
/// @throws base::InputError  options.problems() is not empty, the picture is empty, or an
///   excluded box or a hint lies outside it.
ReposeAngle measure_repose_angle(const Picture& picture, const MeasureOptions& options = {});

inline constexpr std::array<std::pair<MeasureStatus, const char*>, 3> kStatusNames = {
    {{MeasureStatus::ok, "ok"},
     {MeasureStatus::flagged, "flagged"},
     {MeasureStatus::refused, "refused"}}};

inline constexpr const auto& names_for(MeasureStatus) { return kStatusNames; }

inline const char* name_of(MeasureStatus status) {
  for (const auto& [known, name] : kStatusNames) {
    if (known == status) return name;
  }
  return "refused";
}

inline const char* name_of(FlankStatus status) {
  switch (status) {
    case FlankStatus::ok:
      return "ok";
    case FlankStatus::truncated:
      return "truncated";
    case FlankStatus::absent:
      break;
  }
  return "absent";
}

inline const char* name_of(Method method) { return method == Method::paper ? "paper" : "auto"; }

}  // namespace repose::vision
