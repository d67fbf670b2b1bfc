#include "calibrate/experiment/scan_angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/bench/read_bench.h"
#include "calibrate/experiment/heap_angle.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/study.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/drawn_scan.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "vision/scan/scan_file.h"
#include "vision/scan/scan_silhouette.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using testing::cone_surface;
using testing::drawn_scan;
using ::testing::HasSubstr;
using testing::ply_of;
using testing::ScanDraft;
using testing::TemporaryFolder;
using vision::MeasureStatus;

constexpr double kHeight = 80;  // mm
constexpr double kLong = 180, kShort = 140;

vision::ScannedHeap scan_of(const ScanDraft& draft, std::optional<double> unit_mm = 1) {
  vision::Scan scan;
  scan.points = drawn_scan(draft);
  return vision::measure_scan(scan, {.unit_mm = unit_mm});
}

/// A cone with an elliptical base.
double oval_cone(double x, double y) {
  return std::max(0.0, kHeight * (1 - std::hypot(x / kLong, y / kShort)));
}

/// Where its silhouette ends, viewed horizontally: the support function of the ellipse.
double seen_reach(double azimuth_rad) {
  return std::hypot(kLong * std::cos(azimuth_rad), kShort * std::sin(azimuth_rad));
}

double mean_over_views_deg(double (*reach)(double)) {
  double sum = 0;
  for (int view = 0; view < kHeapViews; ++view) {
    sum += to_degrees(std::atan(kHeight / reach(std::numbers::pi * view / kHeapViews)));
  }
  return sum / kHeapViews;
}

double within_deg(const vision::ReposeAngle& angle) {
  return to_degrees(angle.uncertainty_rad.value());
}

TEST(ScanAngle, ARoundConesSilhouettesShowItsSlope) {
  const ScanViews seen = measure_scan_views(scan_of({.surface = cone_surface(27, kHeight)}));
  ASSERT_TRUE(seen.angle.angle_rad.has_value()) << seen.angle.reason;
  EXPECT_EQ(seen.angle.status, MeasureStatus::ok);
  EXPECT_NEAR(to_degrees(*seen.angle.angle_rad), 27, within_deg(seen.angle));
  EXPECT_LT(within_deg(seen.angle), .5);
  EXPECT_EQ(seen.views.size(), static_cast<std::size_t>(kHeapViews));
  EXPECT_FALSE(seen.typical_picture.empty());
}

TEST(ScanAngle, OfAnOvalConeItIsNotThatOfItsSlices) {
  const vision::ScannedHeap scan = scan_of({.surface = oval_cone});
  const ScanViews seen = measure_scan_views(scan);
  const auto slice_reach = [](double azimuth_rad) {
    return 1 / std::hypot(std::cos(azimuth_rad) / kLong, std::sin(azimuth_rad) / kShort);
  };
  const double silhouettes_deg = mean_over_views_deg(seen_reach);
  const double slices_deg = mean_over_views_deg(slice_reach);
  ASSERT_GT(std::abs(slices_deg - silhouettes_deg), .3);
  // All sides of an oval are present, so their scatter is part of the interval, like that of views.
  EXPECT_NEAR(to_degrees(seen.angle.angle_rad.value()), silhouettes_deg, .2);
  EXPECT_NEAR(to_degrees(scan.angle.angle_rad.value()), slices_deg, .2);
  for (int view = 0; view < kHeapViews; ++view) {
    const double azimuth_rad = std::numbers::pi * view / kHeapViews;
    const vision::ReposeAngle& one = seen.views[static_cast<std::size_t>(view)];
    EXPECT_GT(one.base_px.value(), 0);
    EXPECT_NEAR(*one.base_px * seen.m_per_px.value() / kMPerMm, 2 * seen_reach(azimuth_rad), 6);
  }
}

TEST(ScanAngle, TheScansOwnDoubtIsInTheInterval) {
  vision::ScannedHeap scan = scan_of({.surface = cone_surface(27, kHeight)});
  const double before = within_deg(measure_scan_views(scan).angle);
  scan.angle.uncertainty_rad = 3 * kDegree;
  scan.angle.status = MeasureStatus::flagged;
  scan.angle.warnings.push_back({.code = "holes", .message = "There are holes."});
  const ScanViews doubted = measure_scan_views(scan);
  EXPECT_NEAR(within_deg(doubted.angle), std::hypot(before, 3), .05);
  EXPECT_EQ(doubted.angle.status, MeasureStatus::flagged);
  EXPECT_TRUE(std::ranges::any_of(doubted.angle.warnings,
                                  [](const auto& warning) { return warning.code == "holes"; }));
}

TEST(ScanAngle, WithoutAUnitThereIsNoScale) {
  const ScanViews seen = measure_scan_views(scan_of({.surface = cone_surface(27, kHeight)}, {}));
  EXPECT_TRUE(seen.angle.angle_rad.has_value());
  EXPECT_FALSE(seen.m_per_px.has_value());
}

TEST(ScanAngle, OfARefusedScanThereIsTheReason) {
  const vision::ScannedHeap flat = scan_of({.surface = [](double, double) { return 0.0; }});
  ASSERT_EQ(flat.angle.status, MeasureStatus::refused);
  const ScanViews seen = measure_scan_views(flat);
  EXPECT_EQ(seen.angle.status, MeasureStatus::refused);
  EXPECT_EQ(seen.angle.reason, flat.angle.reason);
  EXPECT_FALSE(seen.angle.angle_rad.has_value());
  EXPECT_THROW(vision::ScanSilhouettes{flat}, base::InputError);
}

TEST(ScanAngle, IsByTheDefinitionThatIsNamed) {
  // A concave flank: the chord from crest to foot is flatter than the line in the window.
  const auto hollow = [](double x, double y) {
    const double part = std::max(0.0, 1 - std::hypot(x, y) / 160);
    return kHeight * std::pow(part, 1.3);
  };
  const vision::ScannedHeap scan = scan_of({.surface = hollow});
  const ScanViews usual = measure_scan_views(scan);
  vision::MeasureOptions options;
  options.definition = "height_over_base";
  const ScanViews chord = measure_scan_views(scan, options);
  EXPECT_EQ(chord.angle.definition, "height_over_base");
  EXPECT_NEAR(to_degrees(chord.angle.angle_rad.value()), to_degrees(std::atan(kHeight / 160)), .7);
  EXPECT_GT(std::abs(*chord.angle.angle_rad - usual.angle.angle_rad.value()), .5 * kDegree);
}

/// A study with scans of the measured heap.
class ScannedBench : public ::testing::Test {
 protected:
  ScannedBench() {
    folder_.write("a.ply", ply_of(drawn_scan({.surface = cone_surface(26, kHeight), .seed = 1})));
    folder_.write("b.ply", ply_of(drawn_scan({.surface = cone_surface(28, kHeight), .seed = 2})));
    folder_.write("c.jpg", std::string("no picture"));
  }
  dem::Study study(const std::string& heap) const {
    const std::string text = test::kSphereStudy + "[experiment.heap]\n" + heap + "\n";
    return dem::read_study(folder_.write("study.toml", text), {});
  }
  Measurement read(const std::string& heap) const {
    std::vector<std::string> notes;
    return read_bench(study(heap), {}, notes);
  }
  std::string error(const std::string& heap) const {
    return error_of([&] { read(heap); });
  }
  TemporaryFolder folder_;
};

TEST_F(ScannedBench, GivesAnAngleOfEachHeap) {
  const Measurement bench = read("measured = { scans = [\"*.ply\"] }");
  ASSERT_EQ(bench.pictures.size(), 2U);
  EXPECT_EQ(bench.pictures[0].status, "ok");
  EXPECT_NEAR(bench.pictures[0].angle_deg.value(), 26, .3);
  EXPECT_NEAR(bench.pictures[1].angle_deg.value(), 28, .3);
  EXPECT_GT(bench.pictures[0].own_deg, 0);
  EXPECT_EQ(bench.pictures[0].camera_deg, 0);
  const dem::Study measured =
      with_pictures(study("measured = { scans = [\"*.ply\"] }"), bench.pictures);
  EXPECT_EQ(measured.experiments.at(&dem::pictured_experiment()).measured.values.size(), 2U);
}

TEST_F(ScannedBench, ScansAndPicturesAreNamedApart) {
  EXPECT_THAT(error("measured = { pictures = [\"a.ply\"] }"),
              AllOf(HasSubstr("a.ply: is a three-dimensional scan"), HasSubstr("scans = [...]")));
  EXPECT_THAT(error("measured = { scans = [\"a.ply\", \"c.jpg\"] }"),
              HasSubstr("c.jpg: is no three-dimensional scan"));
  EXPECT_THAT(error("measured = { scans = [\"a.ply\"], pictures = [\"c.jpg\"] }"),
              HasSubstr("more than one kind of values"));
}

TEST_F(ScannedBench, HasNoCamera) {
  EXPECT_THAT(error("camera_distance_mm = 900\ncamera_height_mm = 40\n"
                    "measured = { scans = [\"a.ply\"] }"),
              HasSubstr("has scans and a camera's distance"));
}

TEST_F(ScannedBench, OtherExperimentsHaveNone) {
  const auto file = folder_.write(
      "study.toml", test::kSphereStudy + "[experiment.roll]\nmeasured = { scans = [\"a.ply\"] }\n");
  EXPECT_THAT(error_of([&] { dem::read_study(file, {}); }),
              HasSubstr("only this is measured in scans: heap"));
}

}  // namespace
}  // namespace repose::calibrate
