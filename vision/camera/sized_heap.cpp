#include "vision/camera/sized_heap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "base/units.h"
#include "vision/camera/board_pose.h"
#include "vision/camera/board_view.h"
#include "vision/camera/heap_view.h"
#include "vision/camera/sizing.h"

namespace repose::vision {
namespace {

constexpr double kByEye_rad = 2 * kDegree;  // half-width: pitch of a camera levelled by eye

constexpr double kUsefulPitch_rad = 3 * kDegree;      // half-width above which it is useless
constexpr double kRollTolerance_rad = 1.5 * kDegree;  // of the ground relative to the board's level

/// The bounding box of an outline, inside the picture.
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

SeenBoard described(const BoardView& board, const BoardPose& pose,
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

/// Uses the board's pitch if the options have none.
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

/// A measured heap and everything its sizes depend on.
struct Sizing {
  const Picture& picture;  ///< corrected
  const MeasureOptions& told;
  const ScaleOptions& scale;
  double working_px = 1;
};

HeapSizes sizes_by_board(const BoardView& board, const SeenBoard& seen, const Sizing& sizing,
                         const ReposeAngle& angle) {
  if (!seen.pitch_rad) {
    Estimate scale = board.estimate(
        [](const HeapView& view) { return view.distance_mm / view.normal.z() / view.focal_px; });
    scale.uncertainty = std::hypot(scale.uncertainty, scale.value * std::hypot(kPrinted, kNoLens));
    return sizes_by_scale(angle, scale, sizing.working_px);
  }
  BoardView view = board;
  if (sizing.told.camera_pitch_rad) view.take_pitch(*sizing.told.camera_pitch_rad);
  return sizes_by_view(
      angle, view.inputs(), [&](const Eigen::VectorXd& values) { return view.view(values); },
      kPrinted, sizing.working_px);
}

/// From two points alone.
HeapSizes sizes_by_bar(const ScaleBar& bar, const Sizing& sizing, const ReposeAngle& angle) {
  Estimate scale = mm_per_px(bar);
  scale.uncertainty = std::hypot(scale.uncertainty, kNoLens * scale.value);
  return sizes_by_scale(angle, scale, sizing.working_px);
}

/// From two points and a known lens.
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
  inputs.covariance.diagonal() = (half_widths / base::kNormal95).cwiseAbs2();
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

void check(const Picture& picture, const MeasureOptions& options, const ScaleOptions& scale) {
  base::Faults faults;
  faults.require(scale.board_offset_mm == 0 || scale.lens,
                 {.value = "the board's distance behind the heap says nothing without the camera's "
                           "focal length",
                  .fix = fmt::format("give a {}, or put the board in the plane of the heap's "
                                     "middle.",
                                     base::field("camera file"))});
  faults.add_all(options.problems_in(picture.width, picture.height));
  if (scale.scale) {
    if (auto fault = problem_in(*scale.scale, picture.width, picture.height)) {
      faults.add(*std::move(fault));
    }
  }
  faults.throw_if_any();
}

}  // namespace

SizedHeap measure_sized_heap(const Picture& picture, const MeasureOptions& options,
                             const ScaleOptions& scale) {
  check(picture, options, scale);
  SizedHeap heap;
  heap.options = options;
  if (scale.lens) {
    heap.lens =
        lens_for(turned(*scale.lens, options.hints.turn_deg), picture.width, picture.height);
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
  std::optional<BoardView> board;
  if (!corners.empty()) {
    const BoardPose pose = fit_pose(corners, heap.lens, measured.width, measured.height);
    board.emplace(pose, BoardPlacing{scale.square_mm, scale.board_offset_mm});
    heap.board = described(*board, pose, corners, heap.lens.has_value());
    const auto box = box_around(heap.board->outline, measured.width, measured.height);
    if (box) heap.options.excluded.push_back(*box);
    take_pitch(*heap.board, heap.options);
  }
  heap.angle = measure_repose_angle(measured, heap.options);

  const Sizing sizing{measured, options, scale,
                      working_pixel(measured.width, measured.height, heap.options.hints)};
  std::optional<ScaleBar> bar = scale.scale;
  if (bar && heap.lens) bar = corrected_bar(*bar, *heap.lens);
  heap.has_scale = bar || heap.board;
  if (heap.board) {
    warn_of_board(*heap.board, options, heap.angle);
    heap.sizes = sizes_by_board(*board, *heap.board, sizing, heap.angle);
  } else if (bar) {
    heap.sizes = heap.lens ? sizes_by_bar(*bar, *heap.lens, sizing, heap.angle)
                           : sizes_by_bar(*bar, sizing, heap.angle);
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

}  // namespace repose::vision
