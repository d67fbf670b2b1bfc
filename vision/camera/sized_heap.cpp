#include "vision/camera/sized_heap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "vision/camera/board_pose.h"
#include "vision/camera/heap_view.h"
#include "vision/camera/sizing.h"

namespace repose::vision {
namespace {

constexpr double kNormal95 = 1.96;
constexpr double kDegree = std::numbers::pi / 180;

// Half-widths of what a person does by eye.
constexpr double kLean_rad = 1 * kDegree;    // a board stood upright
constexpr double kPlaced_mm = 10;            // ... where the heap's middle is
constexpr double kPrinted = 0.005;           // of its size
constexpr double kTurned_rad = 3 * kDegree;  // ... and parallel to the heap's middle plane
constexpr double kNoLens = 0.02;             // of a scale, beside where it was taken
constexpr double kByEye_rad = 2 * kDegree;   // pitch of a camera that was taken for level

constexpr double kUsefulPitch_rad = 3 * kDegree;      // half-width above which it says nothing
constexpr double kRollTolerance_rad = 1.5 * kDegree;  // of the ground from the board's level

constexpr int kPoseNumbers = 9;

/// How much of the sheet is left out around the board, in squares: what is printed below it is
/// part of the sheet.
constexpr double kBeside = 1.25, kAbove = 0.6, kBelow = 1.4;

/// What of the board is seen: all of it, or what the heap leaves.
Segment part_seen(const std::vector<SeenCorner>& corners) {
  Segment part{{1e9, 1e9}, {-1e9, -1e9}};
  for (const SeenCorner& corner : corners) {
    const Point place = board_corner(corner.number);
    part.from = {std::min(part.from.x, place.x), std::min(part.from.y, place.y)};
    part.to = {std::max(part.to.x, place.x), std::max(part.to.y, place.y)};
  }
  return {{part.from.x - 1 - kBeside, part.from.y - 1 - kAbove},
          {part.to.x + 1 + kBeside, part.to.y + 1 + kBelow}};
}

std::vector<Point> sheet_outline(const BoardPose& pose, const std::vector<SeenCorner>& corners) {
  const auto& [from, to] = part_seen(corners);
  std::vector<Point> outline;
  for (const Point corner : {from, Point{to.x, from.y}, to, Point{from.x, to.y}}) {
    outline.push_back(seen_at(pose.numbers, corner));
  }
  return outline;
}

/// The box around it, inside the picture.
std::optional<Box> box_around(const std::vector<Point>& outline, int width, int height) {
  double left = width;
  double top = height;
  double right = 0;
  double bottom = 0;
  for (const Point& point : outline) {
    left = std::min(left, point.x);
    top = std::min(top, point.y);
    right = std::max(right, point.x);
    bottom = std::max(bottom, point.y);
  }
  const auto pixel = [](double value, int most) {
    return static_cast<int>(std::clamp(std::round(value), 0.0, static_cast<double>(most)));
  };
  const int x = pixel(left, width);
  const int y = pixel(top, height);
  const Box box{x, y, pixel(right, width) - x, pixel(bottom, height) - y};
  if (box.width < 1 || box.height < 1) return std::nullopt;
  return box;
}

/// The board's pose with what a person does to it: lean and distance behind the heap's plane.
struct BoardInputs {
  Inputs inputs;
  double square_mm = 0;

  enum : int { k_lean = kPoseNumbers, k_tilt, k_turn, k_behind, k_count };

  BoardInputs(const BoardPose& pose, const ScaleOptions& scale)
      : inputs{.values = Eigen::VectorXd::Zero(k_count),
               .covariance = Eigen::MatrixXd::Zero(k_count, k_count)},
        square_mm(scale.square_mm) {
    inputs.values.head<kPoseNumbers>() = pose.numbers;
    inputs.covariance.topLeftCorner<kPoseNumbers, kPoseNumbers>() = pose.covariance;
    inputs.values[k_behind] = scale.behind_mm;
    inputs.covariance(k_lean, k_lean) = std::pow(kLean_rad / kNormal95, 2);
    inputs.covariance(k_tilt, k_tilt) = std::pow(kLean_rad / kNormal95, 2);
    inputs.covariance(k_turn, k_turn) = std::pow(kTurned_rad / kNormal95, 2);
    inputs.covariance(k_behind, k_behind) = std::pow(kPlaced_mm / kNormal95, 2);
  }

  HeapView view(const Eigen::VectorXd& values) const {
    return view_by_board(values.head<kPoseNumbers>(), {.square_mm = square_mm,
                                                       .behind_mm = values[k_behind],
                                                       .lean_rad = values[k_lean],
                                                       .tilt_rad = values[k_tilt],
                                                       .turn_rad = values[k_turn]});
  }
  HeapView view() const { return view(inputs.values); }

  /// The pitch is told: the board leans by what it differs.
  void take_pitch(double pitch_rad) {
    constexpr double kTold_rad = 0.25 * kDegree;
    inputs.values[k_lean] += pitch_rad - view().pitch_rad();
    // The corners' own say of it is in the lean now.
    inputs.covariance(k_lean, k_lean) = std::pow(kTold_rad / kNormal95, 2);
  }

  Estimate estimate(const std::function<double(const HeapView&)>& number) const {
    const Eigen::MatrixXd covariance =
        propagated(inputs, [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
          return Eigen::VectorXd::Constant(1, number(view(values)));
        });
    return {number(view()), kNormal95 * std::sqrt(covariance(0, 0))};
  }
};

SeenBoard described(const BoardInputs& board, const BoardPose& pose,
                    const std::vector<SeenCorner>& corners, bool has_lens) {
  SeenBoard seen{.outline = sheet_outline(pose, corners),
                 .corners = static_cast<int>(corners.size()),
                 .error_px = pose.error_px,
                 .roll_rad = board.estimate([](const HeapView& view) { return view.roll_rad(); }),
                 .pitch_rad = {},
                 .missing = {},
                 .distance_mm = {}};
  if (!has_lens) {
    seen.missing =
        "the camera's pitch and distance need its focal length. Fix: give a camera file.";
    return seen;
  }
  const Estimate pitch = board.estimate([](const HeapView& view) { return view.pitch_rad(); });
  // Written so that NaN fails.
  if (pitch.uncertainty <= kUsefulPitch_rad) {
    seen.pitch_rad = pitch;
    seen.distance_mm = board.estimate([](const HeapView& view) { return view.distance_mm; });
    return seen;
  }
  seen.missing = fmt::format(
      "the board tells the camera's pitch within ± {:.0f} degrees only. Fix: let it fill more of "
      "the picture.",
      pitch.uncertainty / kDegree);
  return seen;
}

void flag(ReposeAngle& angle, const char* code, std::string message) {
  angle.warnings.push_back({code, std::move(message)});
  if (angle.status == MeasureStatus::ok) angle.status = MeasureStatus::flagged;
}

/// Pitch of options that told none: the board's.
void take_pitch(const SeenBoard& board, MeasureOptions& options) {
  if (!board.pitch_rad || options.camera_pitch_rad) return;
  options.camera_pitch_rad = board.pitch_rad->value;
  options.camera_pitch_uncertainty_rad = board.pitch_rad->uncertainty;
}

void warn_of_board(const SeenBoard& board, const MeasureOptions& told, ReposeAngle& angle) {
  if (angle.status == MeasureStatus::refused) return;
  if (told.camera_pitch_rad && board.pitch_rad &&
      std::abs(*told.camera_pitch_rad - board.pitch_rad->value) > board.pitch_rad->uncertainty) {
    flag(angle, "board_pitch_disagrees",
         fmt::format("The board shows a pitch of {:.1f} ± {:.1f} degrees, not the {:.1f} given, "
                     "which was used: does it stand upright?",
                     board.pitch_rad->value / kDegree, board.pitch_rad->uncertainty / kDegree,
                     *told.camera_pitch_rad / kDegree));
  }
  if (angle.ground_tilt_rad && std::abs(*angle.ground_tilt_rad - board.roll_rad.value) >
                                   kRollTolerance_rad + board.roll_rad.uncertainty) {
    flag(angle, "board_tilted",
         fmt::format("The ground is tilted by {:.1f} degrees in the picture and the board by "
                     "{:.1f}: one of them is not level.",
                     *angle.ground_tilt_rad / kDegree, board.roll_rad.value / kDegree));
  }
}

/// A measured heap and all that its sizes follow from.
struct Sizing {
  const Picture& picture;  ///< corrected
  const MeasureOptions& told;
  const ScaleOptions& scale;
  double working_px = 1;
};

HeapSizes sizes_by_board(const BoardInputs& board, const SeenBoard& seen, const Sizing& sizing,
                         const ReposeAngle& angle) {
  if (!seen.pitch_rad) {
    Estimate scale = board.estimate(
        [](const HeapView& view) { return view.distance_mm / view.normal.z() / view.focal_px; });
    scale.uncertainty = std::hypot(scale.uncertainty, scale.value * std::hypot(kPrinted, kNoLens));
    return sizes_by_scale(angle, scale, sizing.working_px);
  }
  BoardInputs inputs = board;
  if (sizing.told.camera_pitch_rad) inputs.take_pitch(*sizing.told.camera_pitch_rad);
  return sizes_by_view(
      angle, inputs.inputs, [&](const Eigen::VectorXd& values) { return inputs.view(values); },
      kPrinted, sizing.working_px);
}

/// By two points and a known lens.
HeapSizes sizes_by_bar(const ScaleBar& bar, const Lens& lens, const Sizing& sizing,
                       const ReposeAngle& angle) {
  if (!angle.ground_tilt_rad) return sizes_by_scale(angle, mm_per_px(bar), sizing.working_px);
  const Estimate scale = mm_per_px(bar);
  const std::optional<double>& told = sizing.told.camera_pitch_rad;
  enum : int { k_scale, k_pitch, k_focal, k_x, k_y, k_count };
  Inputs inputs{.values = Eigen::VectorXd::Zero(k_count),
                .covariance = Eigen::MatrixXd::Zero(k_count, k_count)};
  inputs.values << scale.value, told.value_or(0), lens.focal_px.value, lens.centre_x_px.value,
      lens.centre_y_px.value;
  Eigen::VectorXd half_widths(static_cast<int>(k_count));
  half_widths << scale.uncertainty, told ? 0.25 * kDegree : kByEye_rad, lens.focal_px.uncertainty,
      lens.centre_x_px.uncertainty, lens.centre_y_px.uncertainty;
  inputs.covariance.diagonal() = (half_widths / kNormal95).cwiseAbs2();
  const Point middle{(bar.line.from.x + bar.line.to.x) / 2, (bar.line.from.y + bar.line.to.y) / 2};
  const auto view_of = [&](const Eigen::VectorXd& values) {
    Lens here = lens;
    here.focal_px.value = values[k_focal];
    here.centre_x_px.value = values[k_x];
    here.centre_y_px.value = values[k_y];
    return view_by_scale(here, values[k_scale], values[k_pitch], *angle.ground_tilt_rad, middle);
  };
  return sizes_by_view(angle, inputs, view_of, 0, sizing.working_px);
}

std::optional<ScaleBar> corrected_bar(const ScaleOptions& scale, const std::optional<Lens>& lens) {
  std::optional<ScaleBar> bar = scale.scale;
  if (bar && lens) {
    bar->line = {lens->corrected(bar->line.from), lens->corrected(bar->line.to)};
  }
  return bar;
}

void require(bool holds, const char* error) {
  if (!holds) throw std::invalid_argument(error);
}

void check(const Picture& picture, const MeasureOptions& options, const ScaleOptions& scale) {
  require(!(scale.behind_mm != 0 && !scale.lens),
          "the board's distance behind the heap says nothing without the camera's focal length. "
          "Fix: give a camera file, or put the board in the plane of the heap's middle.");
  std::string errors;
  for (const std::string& problem : options.problems_in(picture.width, picture.height)) {
    errors += (errors.empty() ? "" : "\n") + problem;
  }
  if (!errors.empty()) throw std::invalid_argument(errors);
}

}  // namespace

SizedHeap measure_sized_heap(const Picture& picture, const MeasureOptions& options,
                             const ScaleOptions& scale) {
  check(picture, options, scale);
  SizedHeap heap;
  heap.options = options;
  if (scale.lens) {
    heap.lens = lens_for(*scale.lens, picture.width, picture.height);
    if (heap.lens->is_distorted()) {
      heap.corrected = corrected_picture(picture, *heap.lens);
      heap.options = corrected_options(options, *heap.lens);
    }
    heap.options.pinhole =
        Pinhole{.focal_px = heap.lens->focal_px.value,
                .centre = {heap.lens->centre_x_px.value, heap.lens->centre_y_px.value}};
  }
  const Picture& measured = heap.corrected.empty() ? picture : heap.corrected;
  std::vector<SeenCorner> corners;
  if (scale.finds_board) corners = find_board(measured);
  std::optional<BoardInputs> board;
  if (!corners.empty()) {
    const BoardPose pose = fit_pose(corners, heap.lens, measured.width, measured.height);
    board.emplace(pose, scale);
    heap.board = described(*board, pose, corners, heap.lens.has_value());
    const auto box = box_around(heap.board->outline, measured.width, measured.height);
    if (box) heap.options.excluded.push_back(*box);
    take_pitch(*heap.board, heap.options);
  }
  heap.angle = measure_repose_angle(measured, heap.options);

  const Sizing sizing{measured, options, scale,
                      working_pixel(measured.width, measured.height, heap.options.hints)};
  const std::optional<ScaleBar> bar = corrected_bar(scale, heap.lens);
  heap.has_scale = bar || heap.board;
  if (heap.board) {
    warn_of_board(*heap.board, options, heap.angle);
    heap.sizes = sizes_by_board(*board, *heap.board, sizing, heap.angle);
  } else if (bar) {
    heap.sizes = heap.lens ? sizes_by_bar(*bar, *heap.lens, sizing, heap.angle)
                           : sizes_of_measured(heap.angle, heap.options, measured.width,
                                               measured.height, *bar);
  } else if (scale.finds_board) {
    heap.sizes.reason =
        "no board was found. Fix: let it face the camera, sharp and evenly lit, at least 10 pixels "
        "a square.";
    if (heap.angle.status != MeasureStatus::refused) {
      flag(heap.angle, "no_board", "No board was found: there are no sizes in millimetres.");
    }
  }
  return heap;
}

HeapSizes sizes_of_measured(const ReposeAngle& measured, const MeasureOptions& options, int width,
                            int height, const ScaleBar& scale) {
  Estimate known = mm_per_px(scale);
  known.uncertainty = std::hypot(known.uncertainty, kNoLens * known.value);
  return sizes_by_scale(measured, known, working_pixel(width, height, options.hints));
}

}  // namespace repose::vision
