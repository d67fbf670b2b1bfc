#include "vision/camera/lens_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "base/distributions.h"
#include "base/units.h"
#include "vision/camera/lens_correction.h"

/// What is wrong with the fit of a lens, and how to fix it.

namespace repose::vision {

namespace {

constexpr double kMinTurn_rad = 15 * kDegree;  // between two of the boards

constexpr double kMinCoverage = 0.3;  // of the picture's area

constexpr double kGoodCoverage = 0.5;

constexpr double kLargestError = 0.0006;  // of the picture's longest side ...

constexpr double kLargestError_px = 1;  // ... but for small ones no less than this

constexpr double kUncertainFocal = 0.03;  // half-width / value

constexpr int kGoodNumber = 8;  // of pictures

std::string worst_of(const std::vector<BoardPicture>& pictures,
                     const std::vector<FittedPicture>& fitted_pictures) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < fitted_pictures.size(); ++i) {
    if (fitted_pictures[i].error_px.value_or(0) > fitted_pictures[worst].error_px.value_or(0)) {
      worst = i;
    }
  }
  return fmt::format("{} ({:.2f} px)", pictures[worst].file,
                     fitted_pictures[worst].error_px.value_or(0));
}

double largest_error_px(const Lens& lens) {
  return std::max(kLargestError_px, kLargestError * std::max(lens.width, lens.height));
}

/// Why pictures of several sizes cannot be fitted together; empty if they have one size.
std::string sizes_differ(const std::vector<BoardPicture>& pictures,
                         const std::vector<std::size_t>& used) {
  std::map<std::pair<int, int>, std::vector<std::string>> files;
  for (const std::size_t place : used) {
    files[{pictures[place].width, pictures[place].height}].push_back(pictures[place].file);
  }
  if (files.size() < 2) return {};
  std::vector<std::string> parts;
  for (const auto& [size, names] : files) {
    parts.push_back(fmt::format("{} x {}: {}", size.first, size.second, fmt::join(names, ", ")));
  }
  return fmt::format(
      "the pictures have different sizes ({}). Rule: one camera, one zoom, all upright or all on "
      "their side. Fix: leave out those of another size.",
      fmt::join(parts, "; "));
}

/// Why the fit cannot be used; empty if it can.
std::vector<std::string> reasons_against(const LensFit& fit,
                                         const std::vector<BoardPicture>& pictures) {
  std::vector<std::string> reasons;
  if (*fit.turned_rad < kMinTurn_rad) {
    reasons.push_back(fmt::format(
        "all boards face the same way, within {:.0f} degrees, which does not tell how far away "
        "they are. Rule: at least {:.0f} degrees between two of them. Fix: tilt the board, or walk "
        "around it, by 20 to 40 degrees to each side, up and down.",
        *fit.turned_rad / kDegree, kMinTurn_rad / kDegree));
  }
  if (*fit.coverage < kMinCoverage) {
    reasons.push_back(fmt::format(
        "the boards cover only {:.0f} % of the picture. Rule: at least {:.0f} %. Fix: go closer, "
        "and take the board in every corner of the picture.",
        100 * *fit.coverage, 100 * kMinCoverage));
  }
  if (*fit.error_px > largest_error_px(fit.lens)) {
    reasons.push_back(fmt::format(
        "the corners lie {:.2f} px from where any lens would have them, most in {}. Rule: at most "
        "{:.2f} px. Fix: keep the board flat and still, the zoom and focus as they are, and leave "
        "out blurred pictures.",
        *fit.error_px, worst_of(pictures, fit.pictures), largest_error_px(fit.lens)));
  }
  const LensNumber& focal = fit.lens.focal_px;
  // Written so that NaN fails.
  if (reasons.empty() && !(focal.uncertainty <= kUncertainFocal * focal.value)) {
    reasons.push_back(fmt::format(
        "the focal length remains uncertain: {:.0f} ± {:.0f} px. Rule: ± {:.0f} % at most. Fix: "
        "take more pictures, with the board tilted by 20 to 40 degrees and filling the picture.",
        focal.value, focal.uncertainty, 100 * kUncertainFocal));
  }
  return reasons;
}

/// Adds warnings that require a check by the user.
void warn_of_lens(LensFit& fit, const std::vector<BoardPicture>& pictures) {
  const auto add = [&](const char* code, std::string message) {
    fit.warnings.push_back({code, std::move(message)});
    fit.status = MeasureStatus::flagged;
  };
  if (*fit.coverage < kGoodCoverage) {
    add("little_covered",
        fmt::format("The boards cover {:.0f} % of the picture: distortion elsewhere is a guess. "
                    "Take the board in every corner too.",
                    100 * *fit.coverage));
  }
  const auto used = std::count_if(fit.pictures.begin(), fit.pictures.end(),
                                  [](const FittedPicture& picture) { return picture.is_used; });
  if (used < kGoodNumber) {
    add("few_pictures",
        fmt::format("Only {} pictures: uncertainties are themselves uncertain. Ten are better.",
                    used));
  }
  if (*fit.error_px > largest_error_px(fit.lens) / 2) {
    add("large_error",
        fmt::format("The corners lie {:.2f} px from the fit, most in {}: is the board flat?",
                    *fit.error_px, worst_of(pictures, fit.pictures)));
  }
}

constexpr int kFewestInPicture = 12;  // in a picture: nearly a quarter of the board

using Points = std::vector<cv::Point2f>;
using Places = std::vector<cv::Point3f>;

/// Data for the fit.
struct Seen {
  std::vector<Places> on_board;
  std::vector<Points> in_picture;
  cv::Size size;

  std::size_t corners() const {
    std::size_t count = 0;
    for (const Points& points : in_picture) count += points.size();
    return count;
  }
  Seen without(std::size_t place) const {
    Seen rest = *this;
    rest.on_board.erase(rest.on_board.begin() + static_cast<std::ptrdiff_t>(place));
    rest.in_picture.erase(rest.in_picture.begin() + static_cast<std::ptrdiff_t>(place));
    return rest;
  }
};

Seen seen_in(const std::vector<BoardPicture>& pictures, const std::vector<std::size_t>& used) {
  Seen seen;
  for (const std::size_t place : used) {
    const BoardPicture& picture = pictures[place];
    seen.size = {picture.width, picture.height};
    Places on_board;
    Points in_picture;
    for (const SeenCorner& corner : picture.corners) {
      const Point place_on_board = board_corner(corner.number);
      on_board.emplace_back(static_cast<float>(place_on_board.x),
                            static_cast<float>(place_on_board.y), 0.F);
      in_picture.emplace_back(static_cast<float>(corner.place.x - kPixelCentre),
                              static_cast<float>(corner.place.y - kPixelCentre));
    }
    seen.on_board.push_back(std::move(on_board));
    seen.in_picture.push_back(std::move(in_picture));
  }
  return seen;
}

/// The lens's numbers in OpenCV's order, but with one focal length.
constexpr std::size_t kLensNumbers = 8;
using Numbers = std::array<double, kLensNumbers>;  // f, cx, cy, k1, k2, p1, p2, k3

struct Model {
  int coefficients = 0;  // of the distortion
  int flags = 0;
};

constexpr int kPlain = cv::CALIB_FIX_ASPECT_RATIO;
constexpr int kNoTangent = cv::CALIB_ZERO_TANGENT_DIST;
constexpr std::array<Model, 5> kModels = {
    Model{0, kPlain | kNoTangent | cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3},
    Model{1, kPlain | kNoTangent | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3},
    Model{2, kPlain | kNoTangent | cv::CALIB_FIX_K3},
    Model{4, kPlain | cv::CALIB_FIX_K3},
    Model{5, kPlain},
};

struct Fit {
  Numbers values{};
  Numbers deviations{};
  double error_px = 0;
  std::vector<cv::Vec3d> turns;
  std::vector<cv::Vec3d> places;
  std::vector<double> errors_px;  // of each picture
};

Fit fitted(const Seen& seen, int flags) {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat distortion = cv::Mat::zeros(1, 5, CV_64F);
  std::vector<cv::Mat> turns;
  std::vector<cv::Mat> places;
  cv::Mat deviations;
  cv::Mat errors;
  Fit fit;
  const cv::TermCriteria enough(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-12);
  fit.error_px =
      cv::calibrateCamera(seen.on_board, seen.in_picture, seen.size, matrix, distortion, turns,
                          places, deviations, cv::noArray(), errors, flags, enough);
  const auto k = [&](int i) { return distortion.at<double>(i); };
  const auto sd = [&](int i) { return deviations.at<double>(i); };
  fit.values = {matrix.at<double>(1, 1),
                matrix.at<double>(0, 2) + kPixelCentre,
                matrix.at<double>(1, 2) + kPixelCentre,
                k(0),
                k(1),
                k(2),
                k(3),
                k(4)};
  // The two focal lengths are one number, which OpenCV stores as the second.
  fit.deviations = {sd(1), sd(2), sd(3), sd(4), sd(5), sd(6), sd(7), sd(8)};
  for (std::size_t i = 0; i < turns.size(); ++i) {
    fit.turns.emplace_back(turns[i].reshape(1, 3));
    fit.places.emplace_back(places[i].reshape(1, 3));
    fit.errors_px.push_back(errors.at<double>(static_cast<int>(i)));
  }
  return fit;
}

/// Up to a constant: n ln(sum of squares) + parameters ln n, for n coordinates.
double information(const Fit& fit, const Seen& seen, const Model& model) {
  const auto n = static_cast<double>(2 * seen.corners());
  constexpr double kExact_px = 1e-6;
  const double error_px = std::max(fit.error_px, kExact_px);
  return 2 * n * std::log(error_px) + model.coefficients * std::log(n);
}

std::pair<Fit, Model> best_fit(const Seen& seen) {
  std::pair<Fit, Model> best{fitted(seen, kModels.front().flags), kModels.front()};
  double least = information(best.first, seen, kModels.front());
  for (std::size_t i = 1; i < kModels.size(); ++i) {
    Fit fit = fitted(seen, kModels[i].flags);
    const double here = information(fit, seen, kModels[i]);
    if (here >= least) continue;
    least = here;
    best = {std::move(fit), kModels[i]};
  }
  return best;
}

/// Standard deviations from leaving out one picture at a time.
Numbers jackknife(const Seen& seen, int flags) {
  const std::size_t n = seen.in_picture.size();
  std::vector<Numbers> all;
  Numbers mean{};
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back(fitted(seen.without(i), flags).values);
    for (std::size_t k = 0; k < kLensNumbers; ++k)
      mean[k] += all.back()[k] / static_cast<double>(n);
  }
  Numbers squares{};
  for (const Numbers& values : all) {
    for (std::size_t k = 0; k < kLensNumbers; ++k) {
      squares[k] += (values[k] - mean[k]) * (values[k] - mean[k]);
    }
  }
  for (double& square : squares) {
    square = std::sqrt(square * static_cast<double>(n - 1) / static_cast<double>(n));
  }
  return squares;
}

Lens lens_of(const Fit& fit, const Seen& seen, int flags) {
  const Numbers left_out = jackknife(seen, flags);
  const double student =
      base::student_t_quantile(.975, static_cast<double>(seen.in_picture.size() - 1));
  Lens lens{.width = seen.size.width, .height = seen.size.height};
  const std::array<LensNumber*, kLensNumbers> numbers = {
      &lens.focal_px, &lens.centre_x_px, &lens.centre_y_px, &lens.k1,
      &lens.k2,       &lens.p1,          &lens.p2,          &lens.k3};
  for (std::size_t k = 0; k < kLensNumbers; ++k) {
    *numbers[k] = {fit.values[k],
                   std::max(base::kNormal95 * fit.deviations[k], student * left_out[k])};
  }
  return lens;
}

cv::Vec3d normal_of(const cv::Vec3d& turn) {
  cv::Matx33d rotation;
  cv::Rodrigues(turn, rotation);
  return {rotation(0, 2), rotation(1, 2), rotation(2, 2)};
}

double angle_between(const cv::Vec3d& a, const cv::Vec3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

double largest_turn(const Fit& fit) {
  double largest = 0;
  for (std::size_t i = 0; i < fit.turns.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest = std::max(largest, angle_between(normal_of(fit.turns[i]), normal_of(fit.turns[j])));
    }
  }
  return largest;
}

double coverage_of(const Seen& seen) {
  constexpr int kSide = 200;
  const double shrink =
      std::max(1.0, static_cast<double>(std::max(seen.size.width, seen.size.height)) / kSide);
  cv::Mat1b covered =
      cv::Mat1b::zeros(cvCeil(seen.size.height / shrink), cvCeil(seen.size.width / shrink));
  for (const Points& points : seen.in_picture) {
    std::vector<cv::Point> small;
    for (const cv::Point2f& point : points) {
      small.emplace_back(cvRound(point.x / shrink), cvRound(point.y / shrink));
    }
    std::vector<cv::Point> hull;
    cv::convexHull(small, hull);
    cv::fillConvexPoly(covered, hull, 255);
  }
  return static_cast<double>(cv::countNonZero(covered)) / static_cast<double>(covered.total());
}

void describe(const Fit& fit, const std::vector<std::size_t>& used, LensFit& result) {
  const cv::Vec3d middle(kBoardColumns / 2.0, kBoardRows / 2.0, 0);
  for (std::size_t i = 0; i < used.size(); ++i) {
    FittedPicture& picture = result.pictures[used[i]];
    picture.error_px = fit.errors_px[i];
    picture.tilt_rad = angle_between(normal_of(fit.turns[i]), {0, 0, 1});
    cv::Matx33d rotation;
    cv::Rodrigues(fit.turns[i], rotation);
    picture.distance = cv::norm(rotation * middle + fit.places[i]);
  }
}

}  // namespace

LensFit fit_lens(const std::vector<BoardPicture>& pictures) {
  LensFit result;
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const int corners = static_cast<int>(pictures[i].corners.size());
    result.pictures.push_back({.corners = corners, .is_used = corners >= kFewestInPicture});
    if (result.pictures.back().is_used) used.push_back(i);
  }
  std::vector<std::string> reasons;
  if (static_cast<int>(used.size()) < kFewestPictures) {
    reasons.push_back(fmt::format(
        "{} of {} pictures show{} at least {} corners of the board. Rule: {} pictures or more. "
        "Fix: take ten, with the whole board sharp and evenly lit, from different sides.",
        used.size(), pictures.size(), used.size() == 1 ? "s" : "", kFewestInPicture,
        kFewestPictures));
  }
  if (std::string differ = sizes_differ(pictures, used); !differ.empty()) {
    reasons.push_back(std::move(differ));
  }
  if (reasons.empty()) {
    const Seen seen = seen_in(pictures, used);
    const auto [fit, model] = best_fit(seen);
    describe(fit, used, result);
    result.error_px = fit.error_px;
    result.coverage = coverage_of(seen);
    result.turned_rad = largest_turn(fit);
    result.lens = lens_of(fit, seen, model.flags);
    reasons = reasons_against(result, pictures);
  }
  result.reason = fmt::format("{}", fmt::join(reasons, "\n"));
  if (!reasons.empty()) return result;
  result.status = MeasureStatus::ok;
  warn_of_lens(result, pictures);
  return result;
}

}  // namespace repose::vision
