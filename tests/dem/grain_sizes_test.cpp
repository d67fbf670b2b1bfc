#include <cmath>
#include <set>
#include <vector>

#include <gmock/gmock.h>

#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/state/state_file.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

double volume_m3(double radius_m) { return 4. / 3 * std::numbers::pi * std::pow(radius_m, 3); }

/// Mean and standard deviation of the sizes for a sphere of radius 1.
std::pair<double, double> moments_of_sizes(double sd_fraction) {
  const std::vector<ClumpShape> classes = size_classes(sphere_shape(1), sd_fraction);
  double sum = 0, squares = 0;
  for (const ClumpShape& shape : classes) {
    const double radius = shape.spheres.front().radius;
    sum += radius;
    squares += radius * radius;
  }
  const auto count = static_cast<double>(classes.size());
  return {sum / count, std::sqrt(squares / count - std::pow(sum / count, 2))};
}

TEST(SizeClasses, HaveTheMeanAndTheDeviationAskedFor) {
  for (const double sd : {.001, .043, .2}) {
    const auto [mean, deviation] = moments_of_sizes(sd);
    EXPECT_NEAR(mean, 1, 1e-12);
    EXPECT_NEAR(deviation, sd, 1e-9);
  }
}

TEST(SizeClasses, WithoutVariationThereIsTheMeanAlone) {
  EXPECT_THAT(size_classes(sphere_shape(1), 0), SizeIs(1));
  EXPECT_EQ(size_classes(sphere_shape(1), .1).front().spheres.front().radius, 1);
}

TEST(SizeClasses, EachIsTheSameShapeInAnotherSize) {
  const ClumpShape mean = test::spheroid_clump(5);
  for (const ClumpShape& shape : size_classes(mean, .1)) {
    const double factor = shape.reach_m() / mean.reach_m();
    EXPECT_NEAR(shape.volume_m3, mean.volume_m3 * std::pow(factor, 3), 1e-12 * mean.volume_m3);
    EXPECT_TRUE(shape.gyration_m2.isApprox(factor * factor * mean.gyration_m2));
    for (std::size_t k = 0; k < mean.spheres.size(); ++k) {
      EXPECT_TRUE(shape.spheres[k].centre.isApprox(factor * mean.spheres[k].centre));
      EXPECT_NEAR(shape.spheres[k].radius, factor * mean.spheres[k].radius, 1e-15);
    }
  }
}

Model of_many_sizes() {
  Model model = test::soft_bench();
  model.size_cv = .15;
  return model;
}

HeapProtocol tube_for_many_sizes() {
  HeapProtocol protocol;
  protocol.tube_diameter_m = .08;
  protocol.tube_height_m = .1;
  protocol.lift_speed_m_s = .1;
  protocol.plate_m = .3;
  return protocol;
}

TEST(HeapOfManySizes, IsMadeOfAllOfThem) {
  const Repeat heap = run_heap(of_many_sizes(), tube_for_many_sizes(), 1);
  std::set<int> kinds;
  for (int k = 0; k < heap.state->grain_count(); ++k) {
    const Grain grain = heap.state->grain(k);
    kinds.insert(grain.kind);
    const double radius = heap.state->setup()
                              .kinds.at(static_cast<std::size_t>(grain.kind))
                              .shape.spheres.front()
                              .radius;
    EXPECT_NEAR(heap.state->mass_kg(k), 851 * volume_m3(radius), 1e-9);
    EXPECT_TRUE(!heap.state->is_present(k) || grain.position.z() > .98 * radius);
  }
  EXPECT_THAT(kinds, SizeIs(9));
  EXPECT_EQ(heap.readings.at("at_rest"), 1);
}

TEST(HeapOfManySizes, SameSeedSameBytesOnAnyNumberOfThreadsAndAfterAnInterruption) {
  Model model = of_many_sizes();
  std::vector<Restart> points;
  int looks = 0;
  RunRecord record;
  record.is_restart_due = [&] { return ++looks % 7 == 0; };
  record.save_restart = [&](const Simulation& simulation, const RunProgress& progress) {
    points.push_back({simulation.setup(), simulation.checkpoint(), progress});
  };
  const Repeat whole = run_heap(model, tube_for_many_sizes(), 1, {}, record);
  model.threads = 2;
  EXPECT_TRUE(test::same_state(*whole.state, *run_heap(model, tube_for_many_sizes(), 1).state));
  // During the rain, when the sizes of the remaining grains have not been drawn yet.
  ASSERT_EQ(points.at(1).progress.stage, HeapStage::rain);
  const Repeat resumed = resume_heap(model, tube_for_many_sizes(), 1, points.at(1));
  EXPECT_EQ(state_text(*resumed.state, "{}"), state_text(*whole.state, "{}"));
}

TEST(FillOfManySizes, ItsMassIsTheSumOfItsGrains) {
  const FillProtocol tube{.tube_diameter_m = .11, .tube_height_m = .11};
  const Repeat fill = run_fill(of_many_sizes(), tube, 1);
  double mass_kg = 0;
  int grains = 0;
  for (int k = 0; k < fill.state->grain_count(); ++k) {
    if (!fill.state->is_present(k)) continue;
    mass_kg += fill.state->mass_kg(k);
    ++grains;
  }
  EXPECT_EQ(fill.readings.at("grains"), grains);
  EXPECT_NEAR(fill.readings.at("mass_g"), 1e3 * mass_kg, 1e-9);
  EXPECT_GT(std::abs(mass_kg / (grains * 851 * volume_m3(9.6349e-3)) - 1), 1e-3)
      << "as if all had the mean size";
}

TEST(GrainSizes, ThatVaryTooMuchAreRefusedWithTheRule) {
  Model model = test::soft_bench();
  for (const double sd : {-.01, .21, std::nan("")}) {
    model.size_cv = sd;
    EXPECT_THAT(error_of([&] { run_heap(model, tube_for_many_sizes(), 1); }),
                HasSubstr("Rule: 0 to 0.2"));
  }
}

}  // namespace
}  // namespace repose::dem
