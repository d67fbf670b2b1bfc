#include "render/run/filmed_run.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "dem/shape/clump/clump_shape.h"
#include "tests/render/drawn.h"

namespace repose::render {
namespace {

using ::testing::HasSubstr;

constexpr double kGravity_m_s2 = 9.81, kRadius_m = .005;

/// A ball that falls from .1 m onto an infinite plane, at a time since its release.
Scene falling(double time_s) {
  Scene scene{.shapes = {dem::sphere_shape(kRadius_m)}, .grains = {}, .walls = {}};
  PlacedGrain ball;
  ball.pose.position = {0, 0, .1 + kRadius_m - .5 * kGravity_m_s2 * time_s * time_s};
  ball.velocity = {0, 0, -kGravity_m_s2 * time_s};
  scene.grains = {ball};
  scene.walls = {{.shape = dem::Plane{}, .pose = {}}};
  return scene;
}

/// Its states at this interval.
RunStates states_of_fall(double interval_s) {
  constexpr double kFall_s = .135;
  RunStates states;
  for (double time_s = 0; time_s < kFall_s; time_s += interval_s) states.times_s.push_back(time_s);
  states.scene = [times_s = states.times_s](std::size_t number) {
    return falling(times_s[number]);
  };
  return states;
}

double height_in(const Scene& scene) { return scene.grains.front().pose.position.z(); }

TEST(Between, FollowsAFreeFallExactly) {
  constexpr double kFrom_s = .02, kTo_s = .1;
  const Scene a = falling(kFrom_s), b = falling(kTo_s);
  for (const double part : {0., .25, .5, .9, 1.}) {
    const double time_s = kFrom_s + part * (kTo_s - kFrom_s);
    EXPECT_NEAR(height_in(between(a, b, part, kTo_s - kFrom_s)), height_in(falling(time_s)), 1e-12);
  }
}

TEST(Between, TurnsGrainsAndWallsEvenly) {
  Scene a = falling(0), b = falling(0);
  const auto turned = [](double angle_rad) {
    return dem::Quaternion(Eigen::AngleAxisd(angle_rad, dem::Vector::UnitY()));
  };
  b.grains.front().pose.orientation = turned(.8);
  b.walls.front().pose.orientation = turned(.4);
  const Scene half = between(a, b, .5, 1);
  EXPECT_NEAR(half.grains.front().pose.orientation.angularDistance(turned(.4)), 0, 1e-9);
  EXPECT_NEAR(half.walls.front().pose.orientation.angularDistance(turned(.2)), 0, 1e-9);
}

TEST(Between, GrainsThatComeOrGoAreThoseOfTheEarlierState) {
  const Scene a = falling(0);
  Scene b = falling(.1);
  b.grains.push_back(b.grains.front());
  b.grains.back().number = 1;
  EXPECT_EQ(between(a, b, .5, .1).grains.size(), 1U);
  EXPECT_EQ(height_in(between(a, b, .5, .1)), height_in(a));
}

TEST(FilmedRun, HasFramesInRealTimeAndHoldsItsEnds) {
  FilmedRun run(states_of_fall(.01), {.frames_per_s = 100, .exposure_s = .002, .hold_s = .05});
  EXPECT_EQ(run.frames(), 24) << "0.13 s of states and twice 0.05 s";
  EXPECT_NEAR(run.time_s(0), -.049, 1e-12) << "half exposed";
  EXPECT_EQ(height_in(run.scene_at(run.time_s(0))), height_in(falling(0)));
  EXPECT_NEAR(run.time_s(9), .041, 1e-12);
  EXPECT_NEAR(height_in(run.scene_at(.041)), height_in(falling(.041)), 1e-12);
  EXPECT_NEAR(height_in(run.scene_at(9)), height_in(falling(.13)), 1e-12);
}

TEST(FilmedRun, MomentsAreSpreadOverTheExposure) {
  FilmedRun run(states_of_fall(.01), {.frames_per_s = 20, .exposure_s = .04});
  const std::vector<Scene> moments = run.moments(1, 4);
  ASSERT_EQ(moments.size(), 4U);
  for (int k = 0; k < 4; ++k) {
    const double time_s = .05 + .01 * k + .005;
    EXPECT_NEAR(height_in(moments[static_cast<std::size_t>(k)]), height_in(falling(time_s)), 1e-12);
  }
}

TEST(FilmedRun, TheBenchIsCutToTheGrainsWayAndStands) {
  FilmedRun run(states_of_fall(.01), {});
  const Scene& first = run.first();
  ASSERT_TRUE(first.setting);
  const auto& plate = std::get<dem::Box>(first.walls.front().shape);
  const dem::Pose& pose = first.walls.front().pose;
  EXPECT_NEAR(pose.position.z() + plate.half_size.z(), 0, 1e-12) << "its top is the plane's";
  EXPECT_GT(plate.half_size.x(), 4 * kRadius_m);
  EXPECT_LT(plate.half_size.x(), 1);
  EXPECT_NEAR(first.setting->extent.max().z(), .1 + 2 * kRadius_m, 1e-9);
  EXPECT_LE(first.setting->floor_m, pose.position.z() - plate.half_size.z() + 1e-12);
  const Scene last = run.scene_at(.13);
  EXPECT_EQ(last.setting->floor_m, first.setting->floor_m);
  EXPECT_EQ(last.walls.front().pose.position, pose.position);
}

TEST(FilmedRun, APlateThatTurnsReachesToItsHingeAndIsSeenWhole) {
  RunStates states;
  states.times_s = {0, 1};
  states.scene = [](std::size_t number) {
    Scene scene = falling(0);
    const dem::Quaternion turn(
        Eigen::AngleAxisd(.3 * static_cast<double>(number), dem::Vector::UnitY()));
    scene.walls.front().pose.orientation = turn;
    scene.grains.front().pose.position = turn * dem::Vector(-.1, 0, kRadius_m);
    return scene;
  };
  FilmedRun run(std::move(states), {});
  for (const double time_s : {0., .5, 1.}) {
    const Scene scene = run.scene_at(time_s);
    const auto& plate = std::get<dem::Box>(scene.walls.front().shape);
    const dem::Pose& pose = scene.walls.front().pose;
    const dem::Vector hinge = pose.orientation.conjugate() * (-pose.position);
    EXPECT_LT(std::abs(hinge.x()), plate.half_size.x());
    EXPECT_NEAR(hinge.z(), plate.half_size.z(), 1e-9) << "the hinge is in the plate's upper face";
    const dem::Vector end = pose.position + pose.orientation * dem::Vector(-plate.half_size.x(), 0,
                                                                           plate.half_size.z());
    EXPECT_TRUE(scene.setting->extent.contains(end)) << time_s;
  }
}

TEST(FilmedRun, ShuttersThatCannotBeAreRefused) {
  const auto refusal = [](const Shutter& shutter) {
    return error_of([&] { FilmedRun(states_of_fall(.01), shutter); });
  };
  EXPECT_THAT(refusal({.frames_per_s = 0}), HasSubstr("frames per second"));
  EXPECT_THAT(refusal({.frames_per_s = 60, .exposure_s = .02}), HasSubstr("exposed"));
  EXPECT_THAT(refusal({.frames_per_s = 60, .hold_s = -1}), HasSubstr("held"));
  EXPECT_THAT(error_of([] { FilmedRun(RunStates{}, {}); }), HasSubstr("no states"));
}

/// The number of rows that a ball covers in the middle column, compared with a picture without it.
int rows_touched(const vision::Picture& with, const vision::Picture& without) {
  int rows = 0;
  for (int row = 0; row < with.height; ++row) {
    const auto at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(with.width) +
                         static_cast<std::size_t>(with.width) / 2);
    rows += std::abs(with.bgr[at] - without.bgr[at]) > 12 ? 1 : 0;
  }
  return rows;
}

TEST(Exposure, BlursWhatMovesAndNothingElse) {
  FilmedRun sharp(states_of_fall(.01), {.frames_per_s = 20});
  FilmedRun blurred(states_of_fall(.01), {.frames_per_s = 20, .exposure_s = .03});
  const PictureSize size{.width = 96, .height = 160};
  PhotoStyle style;
  style.noise = 0;
  style.passes = 8;
  style.grain = style.spot = {.1, .1, .1};
  const auto taken = [&](FilmedRun& run, double time_s, int count) {
    std::vector<Scene> moments;
    for (int k = 0; k < count; ++k) moments.push_back(run.scene_at(time_s + .03 * k / count));
    return renderer().expose(moments, OrthographicCamera{}, size, style);
  };
  const vision::Picture elsewhere = taken(sharp, .0, 1);
  const int still = rows_touched(taken(sharp, .1, 1), elsewhere);
  const int moving = rows_touched(taken(blurred, .09, 8), elsewhere);
  EXPECT_GT(still, 10) << "here, and where it was let go";
  EXPECT_GT(moving, still + 10);
}

TEST(FilmTruth, SaysWhereGrainsAreAndWhatAPixelIs) {
  FilmedRun run(states_of_fall(.01), {.frames_per_s = 50});
  const PictureSize size{.width = 200, .height = 160};
  for (const Camera& camera :
       {Camera(OrthographicCamera{}),
        Camera(camera_on(LabStand{.distance_m = 2, .height_m = .05}, run.first(), size))}) {
    const FilmTruth truth = film_truth_of(run, camera, size);
    const double ruler_px = truth.scale.to.x - truth.scale.from.x;
    EXPECT_NEAR(truth.scale_mm / ruler_px, truth.mm_per_px, 1e-3 * truth.mm_per_px);
    ASSERT_EQ(truth.frames.size(), static_cast<std::size_t>(run.frames()));
    const FilmTruth::Frame &one = truth.frames[0], &other = truth.frames[5];
    const double fell_mm = 1e3 * (one.grains[0].position_m.z() - other.grains[0].position_m.z());
    EXPECT_NEAR(fell_mm, 1e3 * .5 * kGravity_m_s2 * .01, 1e-6);
    EXPECT_NEAR((other.grains[0].picture.y - one.grains[0].picture.y) * truth.mm_per_px, fell_mm,
                1e-3 * fell_mm);
  }
}

}  // namespace
}  // namespace repose::render
