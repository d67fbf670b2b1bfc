#include "vision/scan/scanned_heap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/distributions.h"
#include "base/input_error.h"
#include "base/units.h"
#include "vision/measure/line_fit.h"
#include "vision/scan/ground_plane.h"
#include "vision/scan/heap_search.h"
#include "vision/scan/height_map.h"
#include "vision/scan/scan_verdict.h"
#include "vision/scan/slices.h"
#include "vision/scan/survey.h"

namespace repose::vision {

namespace {

constexpr std::size_t kFewestPointsOfScan = 2000;
constexpr double kFewestAcross = 50;  // 12 points in a slice's window

/// The same heap on a map of half of its points, with cells twice as large in area, so that each
/// has as many points.
StandingScan half_of(const std::vector<Eigen::Vector3d>& points, const Survey& survey,
                     Points which) {
  const MapPlan& plan = survey.heap.map.plan;
  MapPlan wider = plan;
  wider.side = static_cast<int>(std::ceil(plan.side / std::numbers::sqrt2));
  wider.cell = plan.side * plan.cell / wider.side;
  const double lowest = -std::max(survey.heap.height, 8 * survey.plane.noise);
  StandingScan half{.map = height_map(points, survey.frame, wider, lowest, which),
                    .base = {},
                    .axis = survey.heap.axis,
                    .height = survey.heap.height};
  for (std::size_t k = 0; k < half.map.height.size(); ++k) {
    half.base.push_back(survey.heap.base[survey.heap.map.cell_of(half.map.middle(k))]);
  }
  return half;
}

/// Standard error of the mean angle from the points' noise: half of the difference between the two
/// halves of the points has the error of the whole. The azimuths' scatter is estimated robustly,
/// since an outlier in a slice of half of the points need not occur in the whole.
double noise_error_rad(const std::vector<Eigen::Vector3d>& points, const Survey& survey,
                       const ScanOptions& options) {
  const Slices one = slices_of(half_of(points, survey, Points::even), options);
  const Slices other = slices_of(half_of(points, survey, Points::odd), options);
  std::vector<double> differences, sizes;
  for (std::size_t k = 0; k < kAzimuths; ++k) {
    const auto& first = one.all[k].azimuth.angle_rad;
    const auto& second = other.all[k].azimuth.angle_rad;
    if (!first || !second) continue;
    differences.push_back((*first - *second) / 2);
    sizes.push_back(std::abs(differences.back()));
  }
  if (differences.empty()) return 0;
  const auto n = static_cast<double>(differences.size());
  return std::hypot(kMadToSigma * median(sizes) / std::sqrt(n), median(differences));
}

/// Half-width of the mean's 95 % interval due to azimuths that were not seen.
double unseen_95(const Slices& slices) {
  std::vector<double> octants;
  constexpr std::size_t kEach = kAzimuths / kSectors;
  std::size_t seen = 0;
  for (std::size_t octant = 0; octant < kSectors; ++octant) {
    std::vector<double> angles;
    for (std::size_t k = octant * kEach; k < (octant + 1) * kEach; ++k) {
      const auto& angle = slices.all[k].azimuth.angle_rad;
      if (angle) angles.push_back(*angle);
    }
    seen += angles.size();
    if (!angles.empty()) octants.push_back(mean_of(angles));
  }
  if (seen == kAzimuths || octants.size() < 2) return 0;
  const double unseen = 1 - static_cast<double>(seen) / kAzimuths;
  const auto n = static_cast<double>(octants.size());
  return base::student_t_quantile(.975, n - 1) * sd_of(octants) * std::sqrt(unseen / n);
}

/// Uncertainty of the surface between the grains: what a stand sees of the gaps depends on its
/// viewpoint. A quarter of the robust standard deviation of the heights around their mean over a
/// tenth of the base's radius: our own convention, from the deviations of noise-free scans of
/// simulated heaps with higher and lower stands (bench scan_accuracy).
double skin_of(const Survey& survey) {
  constexpr double kOfRadius = 0.1, kOfRelief = 0.25;
  const HeightMap& map = survey.heap.map;
  const double radius = survey.base_radius() / map.plan.cell;
  const std::vector<float> smooth =
      smoothed(map, std::max(2, static_cast<int>(std::lround(kOfRadius * radius))));
  std::vector<double> relief;
  for (std::size_t k = 0; k < smooth.size(); ++k) {
    if (survey.heap.base[k] == 0 || map.kind[k] != CellKind::seen) continue;
    relief.push_back(std::abs(static_cast<double>(map.height[k] - smooth[k])));
  }
  return relief.empty() ? 0 : kOfRelief * kMadToSigma * median(relief);
}

double half_width_rad(const std::vector<Eigen::Vector3d>& points, const Survey& survey,
                      const ScanOptions& options, const Slices& slices) {
  constexpr double kFloor_rad = 0.06 * kDegree;
  const double level = survey.level_95();
  const double mean = *slices.mean();
  const double run =
      (options.window_to - options.window_from) * survey.heap.height / std::tan(mean);
  double squares = kFloor_rad * kFloor_rad;
  const auto add = [&](double part) { squares += part * part; };
  add(base::kNormal95 * noise_error_rad(points, survey, options));
  add(unseen_95(slices));
  add(skin_of(survey) / run * std::cos(mean) * std::cos(mean));
  // The bow's slope, 2 c r, where the window ends.
  const double low_end = (1 - options.window_from) * survey.base_radius();
  add(2 * survey.bow * low_end * std::cos(mean) * std::cos(mean));
  if (level > 1e-5 * survey.heap.height) {
    const auto up = slices_of(lifted(survey.heap, level), options).mean();
    const auto down = slices_of(lifted(survey.heap, -level), options).mean();
    if (up && down) add((*up - *down) / 2);
    // The same scatter over the length of the window, as a tilt.
    add(level / run * std::cos(mean) * std::cos(mean));
  }
  return std::sqrt(squares) + slices.mean_of([](const FlankFit& fit) { return fit.apron_rad; });
}

struct Volume {
  double volume = 0;
  double half_width = 0;
  double area = 0;
};

/// See measure_scan().
Volume volume_of(const Survey& survey, double angle_rad) {
  constexpr double kHoleDoubt = 0.1;  // of the filled-in volume
  constexpr double kGridDoubt = 0.002;
  constexpr double kFlattestToe_rad = 8 * kDegree, kToeReach = 1.5;
  const HeightMap& map = survey.heap.map;
  const double toe = survey.threshold / std::tan(std::max(angle_rad / 2, kFlattestToe_rad));
  const int reach = 1 + static_cast<int>(std::ceil(kToeReach * toe / map.plan.cell));
  const auto base = dilated(map, survey.heap.base, reach);
  const double cell = map.plan.cell * map.plan.cell;
  Volume found;
  double holes = 0;
  for (std::size_t k = 0; k < base.size(); ++k) {
    if (base[k] == 0 || map.kind[k] == CellKind::outside) continue;
    const double part = static_cast<double>(map.height[k]) * cell;
    found.volume += part;
    found.area += survey.heap.base[k] != 0 ? cell : 0;
    holes += map.kind[k] == CellKind::hole ? std::abs(part) : 0;
  }
  const double level = (survey.level_95() + survey.sunk) * found.area;
  const double skin = skin_of(survey) * found.area;
  found.half_width =
      std::sqrt(std::pow(level, 2) + std::pow(skin, 2) + std::pow(kHoleDoubt * holes, 2) +
                std::pow(kGridDoubt * found.volume, 2));
  return found;
}

void check_options(const ScanOptions& options) {
  MeasureOptions window;
  window.window_from = options.window_from;
  window.window_to = options.window_to;
  base::Faults faults;
  faults.add_all(window.problems());
  faults.require(!options.unit_mm || *options.unit_mm > 0,
                 {.subject = "unit",
                  .value = fmt::format("is {:g} mm", options.unit_mm.value_or(0)),
                  .rule = "above 0",
                  .fix = "the length of one unit of the file."});
  faults.throw_if_any();
}

std::optional<GroundPlane> told_plane(const ScanOptions& options) {
  if (!options.ground) return std::nullopt;
  const auto at = [&](std::size_t k) { return Eigen::Vector3d::Map((*options.ground)[k].data()); };
  const Eigen::Vector3d one = at(1) - at(0), other = at(2) - at(0);
  GroundPlane plane;
  const Eigen::Vector3d normal = one.cross(other);
  if (!(normal.norm() > 1e-3 * std::max(one.squaredNorm(), other.squaredNorm()))) {
    throw base::InputError({.subject = "ground plane",
                            .value = "has its three points on one line",
                            .rule = "three points far apart, around the heap",
                            .fix = "read them off the scan in a viewer, such as MeshLab."});
  }
  plane.normal = normal.normalized();
  plane.offset = plane.normal.dot(at(0));
  return plane;
}

/// The usable points: scanners write points they did not see as 0,0,0.
std::vector<Eigen::Vector3d> usable_points(const Scan& scan, ScannedHeap& result) {
  constexpr std::size_t kMostAtOrigin = 10;
  const auto is_origin = [](const base::Corner& at) {
    return at[0] == 0 && at[1] == 0 && at[2] == 0;
  };
  const auto at_origin =
      static_cast<std::size_t>(std::count_if(scan.points.begin(), scan.points.end(), is_origin));
  const bool drops_origin = !scan.is_surface && at_origin > kMostAtOrigin;
  std::vector<Eigen::Vector3d> points;
  points.reserve(scan.points.size());
  for (const base::Corner& at : scan.points) {
    if (drops_origin && is_origin(at)) continue;
    points.emplace_back(at[0], at[1], at[2]);
  }
  result.points = points.size();
  result.points_left_out = scan.not_finite + (drops_origin ? at_origin : 0);
  return points;
}

void describe_ground(const Survey& survey, ScannedHeap& result) {
  const GroundPlane& plane = survey.plane;
  result.ground = ScanGround{.normal = {plane.normal.x(), plane.normal.y(), plane.normal.z()},
                             .offset = plane.offset,
                             .noise = plane.noise,
                             .level_sd = survey.level_sd(),
                             .sectors = static_cast<int>(survey.levels.size())};
  const Eigen::Vector3d foot =
      survey.frame.outside({survey.heap.axis.x(), survey.heap.axis.y(), 0});
  result.axis = base::Corner{foot.x(), foot.y(), foot.z()};
}

void draw_for_plots(const Survey& survey, const ScanOptions& options, ScannedHeap& result) {
  const HeightMap& map = survey.heap.map;
  result.map = ScanMap{.side = map.side(),
                       .cell = map.plan.cell,
                       .height = map.height,
                       .is_heap = survey.heap.base,
                       .is_hole = {},
                       .axis = {}};
  std::size_t base = 0, holes = 0;
  for (std::size_t k = 0; k < map.kind.size(); ++k) {
    const bool is_hole = map.kind[k] == CellKind::hole;
    result.map.is_hole.push_back(is_hole ? 1 : 0);
    base += survey.heap.base[k] != 0 ? 1 : 0;
    holes += survey.heap.base[k] != 0 && is_hole ? 1 : 0;
  }
  result.hole_share = base > 0 ? static_cast<double>(holes) / static_cast<double>(base) : 0;
  const Eigen::Vector2d axis = survey.heap.axis - map.plan.corner;
  result.map.axis = {axis.x(), axis.y()};
  result.mean_profile = mean_profile(survey.heap);
  std::vector<double> along, height;
  for (const Point& point : result.mean_profile) {
    if (point.y < options.window_from * survey.heap.height ||
        point.y > options.window_to * survey.heap.height) {
      continue;
    }
    along.push_back(point.x);
    height.push_back(point.y);
  }
  if (along.size() < 2) return;
  const LineFit line = least_squares_line(along, height);
  result.mean_line =
      Segment{{along.front(), line.y(along.front())}, {along.back(), line.y(along.back())}};
}

/// Sizes in millimetres, or why there are none.
void add_sizes(const Survey& survey, const Volume& volume, double angle_rad, ScannedHeap& result) {
  if (!result.unit_mm) {
    result.size_reason = fmt::format("the file does not say what its unit is. Fix: give the {}.",
                                     base::field("unit"));
    return;
  }
  constexpr double kMmPerCell = 0.5;  // rounding to cells, at each end
  constexpr double kMm3PerMl = 1000;
  const double cell = survey.heap.map.plan.cell, mm = *result.unit_mm;
  const double level = survey.level_95() + survey.sunk;
  const double grid = kMmPerCell * cell * std::tan(angle_rad);
  const double height_doubt = std::hypot(level, 2 * survey.plane.noise, grid);
  result.height_mm = Estimate{survey.heap.height * mm, height_doubt * mm};
  const double width = 2 * std::sqrt(volume.area / std::numbers::pi);
  const double toe = survey.threshold / std::tan(angle_rad);
  const double width_doubt = 2 * (kMmPerCell * cell + level / std::tan(angle_rad));
  if (survey.cut > kMostRimCut) {
    result.size_reason =
        "the scan's edge cuts the base off. Fix: scan the heap with ground on every side.";
    return;
  }
  result.base_mm = Estimate{(width + 2 * toe) * mm, std::hypot(width_doubt, toe) * mm};
  const double ml = mm * mm * mm / kMm3PerMl;
  result.volume_ml = Estimate{volume.volume * ml, volume.half_width * ml};
}

/// Inserts the user's names for the options into all messages.
void name_fields(base::FieldNames names, ScannedHeap& result) {
  result.angle.reason = base::with_names(result.angle.reason, names);
  result.size_reason = base::with_names(result.size_reason, names);
  for (Warning& warning : result.angle.warnings) {
    warning.message = base::with_names(warning.message, names);
  }
}

ScannedHeap refused(ScannedHeap result, std::string reason) {
  result.angle.status = MeasureStatus::refused;
  result.angle.reason = std::move(reason);
  return result;
}

/// Measures the heap found on a plane; `result` has the numbers of points.
ScannedHeap measured_on(const std::vector<Eigen::Vector3d>& points, const HeapSearch& search,
                        const ScanOptions& options, ScannedHeap result) {
  if (!search.heap) return refused(std::move(result), search.reason);
  if (2 * search.heap->radius / plan_around(*search.heap).cell < kFewestAcross) {
    return refused(std::move(result),
                   few_points_reason(static_cast<std::size_t>(search.heap->points)));
  }
  Survey survey{.plane = search.heap->plane,
                .frame = ScanFrame(search.heap->plane, search.heap->middle),
                .heap = {},
                .threshold = 0,
                .cut = 0,
                .levels = {},
                .bow = 0,
                .sunk = 0};
  if (!survey_heap(points, *search.heap, options.ground.has_value(), survey)) {
    return refused(
        std::move(result),
        "nothing stands clear of the ground's roughness. Fix: scan the heap from nearer, "
        "or with less noise.");
  }
  describe_ground(survey, result);
  draw_for_plots(survey, options, result);
  const Slices slices = slices_of(survey.heap, options, true);
  for (const Slice& slice : slices.all) result.azimuths.push_back(slice.azimuth);
  if (const auto reason = reason_against(slices, result)) {
    return refused(std::move(result), *reason);
  }
  ReposeAngle& angle = result.angle;
  angle.status = MeasureStatus::ok;
  angle.angle_rad = slices.mean();
  angle.uncertainty_rad = half_width_rad(points, survey, options, slices);
  angle.own_uncertainty_rad = angle.uncertainty_rad;
  angle.camera_uncertainty_rad = 0;
  angle.definitions = slices.definitions;
  result.azimuth_sd_rad = sd_of(slices.angles());
  const double toe = survey.threshold / std::tan(*angle.angle_rad);
  result.map.with_toe = dilated(survey.heap.map, survey.heap.base,
                                static_cast<int>(std::ceil(toe / survey.heap.map.plan.cell)));
  add_sizes(survey, volume_of(survey, *angle.angle_rad), *angle.angle_rad, result);
  std::optional<double> ledge = ledge_around(survey);
  if (ledge) *ledge /= survey.heap.height;
  warn_of_scan(slices, search.heap->others, ledge, result);
  return result;
}

ScannedHeap measured(const Scan& scan, const ScanOptions& options) {
  constexpr double kNearTold = 1.0 / 300;  // of the extent
  std::optional<GroundPlane> told = told_plane(options);
  ScannedHeap result;
  result.angle.window = {options.window_from, options.window_to};
  if (result.angle.window == base::kUsualDefinition.window) {
    result.angle.definition = base::kUsualDefinition.name;
  }
  if (options.unit_mm && scan.unit_mm && *options.unit_mm != *scan.unit_mm) {
    throw base::InputError(
        {.subject = "unit",
         .value = fmt::format("= {:g} mm", *options.unit_mm),
         .rule = fmt::format("the file says that one unit is {:g} mm", *scan.unit_mm),
         .fix = "leave it out."});
  }
  result.unit_mm = options.unit_mm ? options.unit_mm : scan.unit_mm;
  const std::vector<Eigen::Vector3d> points = usable_points(scan, result);
  if (points.size() < kFewestPointsOfScan) {
    return refused(std::move(result), few_points_reason(points.size()));
  }
  const CloudExtent extent = extent_of(points);
  if (!(extent.length > 0)) {
    return refused(std::move(result), "all points are at one place. Fix: export the scan again.");
  }
  if (told) told->noise = refined(*told, points, kNearTold * extent.length).noise;
  std::optional<ScannedHeap> first;
  for (const HeapSearch& search : find_heaps(points, extent, told)) {
    ScannedHeap found = measured_on(points, search, options, result);
    if (found.angle.status != MeasureStatus::refused) return found;
    if (!first) first = std::move(found);
  }
  return std::move(*first);
}

}  // namespace

ScannedHeap measure_scan(const Scan& scan, const ScanOptions& options) {
  check_options(options);
  ScannedHeap result = measured(scan, options);
  name_fields(options.names, result);
  return result;
}

}  // namespace repose::vision
