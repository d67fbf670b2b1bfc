#include "vision/camera/sized_heap.h"

#include <cmath>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"
#include "tests/support/drawn_board.h"
#include "tests/support/heap_random.h"
#include "tests/support/temporary_folder.h"
#include "vision/film/film_angle.h"
#include "vision/picture/opencv.h"
#include "vision/video/film_writer.h"

namespace repose::vision {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A cone of fine grains on a plain plate, seen by a camera with a lens; drawn by one ray per
/// pixel.
struct Stage {
  double height_mm = 75;
  double radius_mm = 150;
  double distance_mm = 1200;  ///< of the lens from the axis, along the ground
  double lens_mm = 60;        ///< above the ground
  double aside_mm = 110;      ///< of the lens, from the axis
  double pitch_rad = 2 * kDegree;
  testing::BoardCamera camera = {
      .width = 1000, .height = 600, .focal_px = 1500, .centre_x_px = 500, .centre_y_px = 300};

  Eigen::Matrix3d view() const { return testing::camera_from_world(pitch_rad, 0); }
  Eigen::Vector3d eye() const { return {aside_mm, -distance_mm, lens_mm}; }

  /// Whether a ray meets the cone above the ground: a quadratic equation.
  bool meets_cone(const Eigen::Vector3d& ray) const {
    const double slope = height_mm / radius_mm;
    const Eigen::Vector3d from = eye() - Eigen::Vector3d(0, 0, height_mm);
    const double a = slope * slope * (ray.x() * ray.x() + ray.y() * ray.y()) - ray.z() * ray.z();
    const double b = slope * slope * (from.x() * ray.x() + from.y() * ray.y()) - from.z() * ray.z();
    const double c =
        slope * slope * (from.x() * from.x() + from.y() * from.y()) - from.z() * from.z();
    const double root = b * b - a * c;
    if (root < 0) return false;
    for (const double sign : {-1., 1.}) {
      const double z = eye().z() + (-b + sign * std::sqrt(root)) / a * ray.z();
      if (z >= 0 && z <= height_mm) return true;
    }
    return false;
  }

  Picture picture() const {
    Picture drawn = blank_picture(camera.width, camera.height);
    cv::Mat image = mat_of(drawn);
    testing::Random random(1);
    const Eigen::Matrix3d to_world = view().transpose();
    for (int row = 0; row < camera.height; ++row) {
      for (int col = 0; col < camera.width; ++col) {
        const Eigen::Vector3d ray = to_world * camera.direction({col + .5, row + .5});
        const bool is_heap = meets_cone(ray);
        const double light = (is_heap           ? 70
                              : ray.z() < -.012 ? 205
                                                : 215) +
                             random.normal(0, is_heap ? 14 : 1.5);
        image.at<cv::Vec3b>(row, col) = cv::Vec3b(cv::saturate_cast<unsigned char>(.7 * light),
                                                  cv::saturate_cast<unsigned char>(.85 * light),
                                                  cv::saturate_cast<unsigned char>(light));
      }
    }
    return drawn;
  }

  /// The board beside it, upright, in or behind the plane of its middle.
  Picture picture_with_board(double board_offset_mm = 0, double roll_rad = 0) const {
    Picture drawn = picture();
    Eigen::Matrix3d world_from_level;
    world_from_level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    const auto upright = testing::placed_board({0, 0, 0}, 0, roll_rad, 0);
    testing::BoardPlace place = upright;
    place.rotation = view() * world_from_level * upright.rotation;
    place.origin_mm = view() * (Eigen::Vector3d(radius_mm + 165, board_offset_mm, 116) - eye() +
                                world_from_level * upright.origin_mm);
    draw_board(camera, place, {}, drawn);
    return drawn;
  }

  Lens lens() const {
    return {.width = camera.width,
            .height = camera.height,
            .focal_px = {camera.focal_px, 4},
            .centre_x_px = {camera.centre_x_px, 2},
            .centre_y_px = {camera.centre_y_px, 2},
            .k1 = {camera.k1, 0},
            .k2 = {},
            .p1 = {},
            .p2 = {},
            .k3 = {}};
  }
};

/// Fine powder shows no grains: a hint marks it as a heap.
const MeasureOptions kIsHeap = [] {
  MeasureOptions options;
  options.hints.keep = {{365, 270}};
  return options;
}();

void expect_holds(const std::optional<Estimate>& estimate, double truth, double most_part) {
  ASSERT_TRUE(estimate);
  EXPECT_NEAR(estimate->value, truth, estimate->uncertainty);
  EXPECT_LT(estimate->uncertainty, most_part * truth);
}

/// A drawn edge without grains is perfectly straight, so the interval is only its floor: a tenth of
/// a degree is allowed for the segmentations' placement of it.
void expect_holds_angle(const ReposeAngle& angle) {
  EXPECT_NEAR(*angle.angle_rad, std::atan2(75, 150), *angle.uncertainty_rad + .1 * kDegree);
}

TEST(SizedHeap, ABoardAndALensGivePitchAndSizes) {
  const Stage stage;
  const SizedHeap heap =
      measure_sized_heap(stage.picture_with_board(), kIsHeap,
                         {.lens = stage.lens(), .finds_board = true, .scale = {}});
  ASSERT_NE(heap.angle.status, MeasureStatus::refused) << heap.angle.reason;
  ASSERT_TRUE(heap.board && heap.board->pitch_rad);
  EXPECT_EQ(heap.board->corners, kBoardCorners);
  EXPECT_NEAR(heap.board->pitch_rad->value / kDegree, 2, .3);
  EXPECT_NEAR(heap.board->pitch_rad->uncertainty / kDegree, 1, .2);  // a board set upright by eye
  EXPECT_NEAR(heap.board->roll_rad.value / kDegree, 0, .1);
  EXPECT_NEAR(heap.board->distance_mm->value, 1200, 10);
  EXPECT_DOUBLE_EQ(*heap.angle.camera_pitch_rad, heap.board->pitch_rad->value);

  EXPECT_THAT(heap.sizes.reason, IsEmpty());
  expect_holds(heap.sizes.height_mm, 75, .12);
  expect_holds(heap.sizes.base_mm, 300, .04);
  expect_holds(heap.sizes.left_run_out_mm, 150, .06);
  expect_holds(heap.sizes.right_run_out_mm, 150, .06);
  expect_holds(heap.sizes.cone_volume_ml, cone_volume_ml(300, 75), .16);
  expect_holds_angle(heap.angle);
  // The ground line that was found lies at the heap's front rim, below its middle.
  EXPECT_GT(*heap.angle.height_px * heap.sizes.mm_per_px->value, 75 * 1.03);
}

TEST(SizedHeap, ABoardBehindTheHeapIsAllowedForByPerspective) {
  const Stage stage;
  const Picture picture = stage.picture_with_board(240);
  const ScaleOptions told{
      .lens = stage.lens(), .finds_board = true, .board_offset_mm = 240, .scale = {}};
  const SizedHeap heap = measure_sized_heap(picture, kIsHeap, told);
  expect_holds(heap.sizes.base_mm, 300, .04);
  ScaleOptions untold = told;
  untold.board_offset_mm = 0;
  const SizedHeap wrong = measure_sized_heap(picture, kIsHeap, untold);
  EXPECT_NEAR(wrong.sizes.base_mm->value / heap.sizes.base_mm->value, 1.2, .01);
  ScaleOptions no_lens = told;
  no_lens.lens.reset();
  EXPECT_THROW(measure_sized_heap(picture, kIsHeap, no_lens), base::InputError);
}

TEST(SizedHeap, TheLensOfAPictureThatLayOnItsSideIsTurnedWithIt) {
  Stage stage;
  stage.camera.centre_x_px = 470;
  stage.camera.centre_y_px = 330;
  stage.camera.k1 = -.1;
  const Picture picture = stage.picture_with_board();
  const auto measured = [&](const Lens& lens, int turn_deg) {
    MeasureOptions options = kIsHeap;
    options.hints.turn_deg = turn_deg;
    return measure_sized_heap(picture, options, {.lens = lens, .finds_board = true, .scale = {}});
  };
  const SizedHeap upright = measured(stage.lens(), 0);
  ASSERT_TRUE(upright.board && upright.board->pitch_rad) << upright.angle.reason;
  for (const int turn_deg : kTurns_deg) {
    const SizedHeap heap = measured(turned(stage.lens(), 360 - turn_deg), turn_deg);
    ASSERT_TRUE(heap.board && heap.board->pitch_rad) << turn_deg;
    EXPECT_NEAR(heap.board->pitch_rad->value, upright.board->pitch_rad->value, 1e-6) << turn_deg;
    EXPECT_NEAR(heap.sizes.base_mm->value, upright.sizes.base_mm->value, 1e-3) << turn_deg;
    EXPECT_NEAR(*heap.angle.angle_rad, *upright.angle.angle_rad, 1e-6) << turn_deg;
  }
}

TEST(SizedHeap, WithoutALensABoardGivesAScaleAndSaysWhatIsMissing) {
  const Stage stage;
  const SizedHeap heap = measure_sized_heap(stage.picture_with_board(), kIsHeap,
                                            {.lens = {}, .finds_board = true, .scale = {}});
  ASSERT_TRUE(heap.board);
  EXPECT_FALSE(heap.board->pitch_rad);
  EXPECT_THAT(heap.board->missing, HasSubstr("camera file"));
  EXPECT_FALSE(heap.angle.camera_pitch_rad);
  expect_holds(heap.sizes.base_mm, 300, .06);
  expect_holds(heap.sizes.height_mm, 75, .2);
}

TEST(SizedHeap, ADistortedPictureIsCorrectedBeforeItIsMeasured) {
  Stage stage;
  stage.camera.k1 = -.35;
  const SizedHeap heap =
      measure_sized_heap(stage.picture_with_board(), kIsHeap,
                         {.lens = stage.lens(), .finds_board = true, .scale = {}});
  EXPECT_FALSE(heap.corrected.empty());
  expect_holds(heap.sizes.base_mm, 300, .04);
  expect_holds(heap.sizes.height_mm, 75, .12);
  expect_holds_angle(heap.angle);
}

TEST(SizedHeap, TwoPointsAndALensGiveSizes) {
  const Stage stage;
  const auto seen = [&](double x) {
    return stage.camera.seen(stage.view() * (Eigen::Vector3d(x, 0, 0) - stage.eye()));
  };
  MeasureOptions told = kIsHeap;
  told.camera_pitch_rad = stage.pitch_rad;
  const ScaleOptions scale{.lens = stage.lens(),
                           .scale = ScaleBar{.line = {seen(-150), seen(150)}, .length_mm = 300}};
  const SizedHeap heap = measure_sized_heap(stage.picture(), told, scale);
  EXPECT_TRUE(heap.has_scale);
  expect_holds(heap.sizes.base_mm, 300, .03);
  expect_holds(heap.sizes.height_mm, 75, .08);
  ScaleOptions no_lens = scale;
  no_lens.lens.reset();
  const SizedHeap plain = measure_sized_heap(stage.picture(), told, no_lens);
  expect_holds(plain.sizes.base_mm, 300, .04);
  expect_holds(plain.sizes.height_mm, 75, .15);
}

TEST(SizedHeap, AToldPitchIsUsedAndAnotherOneOfTheBoardIsSaid) {
  const Stage stage;
  MeasureOptions told = kIsHeap;
  told.camera_pitch_rad = 6 * kDegree;
  const SizedHeap heap = measure_sized_heap(
      stage.picture_with_board(), told, {.lens = stage.lens(), .finds_board = true, .scale = {}});
  EXPECT_DOUBLE_EQ(*heap.angle.camera_pitch_rad, 6 * kDegree);
  EXPECT_THAT(heap.angle.warnings, Contains(Field(&Warning::code, "board_pitch_disagrees")));
  told.camera_pitch_rad = 2 * kDegree;
  const SizedHeap agreed = measure_sized_heap(
      stage.picture_with_board(), told, {.lens = stage.lens(), .finds_board = true, .scale = {}});
  EXPECT_THAT(agreed.angle.warnings, Not(Contains(Field(&Warning::code, "board_pitch_disagrees"))));
}

TEST(SizedHeap, ABoardThatIsNotThereIsSaidAndTheAngleStays) {
  const Stage stage;
  const SizedHeap heap =
      measure_sized_heap(stage.picture(), kIsHeap, {.lens = {}, .finds_board = true, .scale = {}});
  EXPECT_EQ(heap.angle.status, MeasureStatus::flagged);
  EXPECT_THAT(heap.angle.warnings, Contains(Field(&Warning::code, "no_board")));
  EXPECT_TRUE(heap.angle.angle_rad);
  EXPECT_FALSE(heap.sizes.height_mm);
  EXPECT_THAT(heap.sizes.reason, HasSubstr("Fix"));
}

TEST(SizedHeap, AGroundLineFarBelowTheFootGivesNoSizes) {
  MeasureOptions told = kIsHeap;
  const SizedHeap right = measure_sized_heap(Stage().picture(), told, {.lens = {}, .scale = {}});
  const double foot_y = right.angle.ground->from.y;
  const double height_px = foot_y - right.angle.crest->y;
  told.hints.ground = Segment{{100, foot_y + height_px}, {900, foot_y + height_px}};
  const SizedHeap heap = measure_sized_heap(
      Stage().picture(), told, {.lens = {}, .scale = ScaleBar{{{0, 0}, {300, 0}}, 300}});
  ASSERT_NE(heap.angle.status, MeasureStatus::refused) << heap.angle.reason;
  EXPECT_THAT(heap.sizes.reason, HasSubstr("the ground line lies far below the heap's foot"));
  EXPECT_FALSE(heap.sizes.height_mm);
}

TEST(SizedHeap, WithoutAnyScaleItIsWhatMeasuringGives) {
  const Stage stage;
  const Picture picture = stage.picture();
  const SizedHeap heap = measure_sized_heap(picture, kIsHeap, {.lens = {}, .scale = {}});
  const ReposeAngle plain = measure_repose_angle(picture, kIsHeap);
  EXPECT_EQ(heap.angle.angle_rad, plain.angle_rad);
  EXPECT_EQ(heap.angle.uncertainty_rad, plain.uncertainty_rad);
  EXPECT_FALSE(heap.sizes.mm_per_px);
  EXPECT_FALSE(heap.has_scale);
}

TEST(SizedHeap, OfAFilmHasItsBoardAndLensToo) {
  const Stage stage;
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "heap.mp4";
  vision::FilmWriter film(file, 12);
  const Picture picture = stage.picture_with_board();
  for (int frame = 0; frame < 14; ++frame) film.add(picture);
  film.close();
  const FilmAngle measured =
      measure_film(file, kIsHeap, {.lens = stage.lens(), .finds_board = true, .scale = {}});
  ASSERT_TRUE(measured.heap.board) << measured.heap.angle.reason;
  ASSERT_TRUE(measured.heap.board->pitch_rad);
  EXPECT_NEAR(measured.heap.board->pitch_rad->value, stage.pitch_rad, .5 * kDegree);
  expect_holds(measured.heap.sizes.height_mm, 75, .1);
  expect_holds(measured.heap.sizes.base_mm, 300, .05);
  expect_holds_angle(measured.heap.angle);
}

TEST(ConeVolume, OfALitreCone) {
  EXPECT_NEAR(cone_volume_ml(200, 95.493), 1000, .01);
  EXPECT_EQ(cone_volume_ml(0, 10), 0);
}

}  // namespace
}  // namespace repose::vision
