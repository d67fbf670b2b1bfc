#include "dem/experiment/experiment_table.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::HasSubstr;

TEST(ExperimentTable, HasEachExperimentInItsPlace) {
  int pictured = 0;
  for (const ExperimentEntry& entry : all_experiments()) {
    EXPECT_EQ(&entry_of(entry.usual), &entry) << "each has a protocol of its own: " << entry.name;
    pictured += entry.is_pictured ? 1 : 0;
    EXPECT_EQ(entry.is_pictured, &entry == &pictured_experiment()) << entry.name;
    EXPECT_EQ(entry.is_pictured, entry.camera != nullptr) << entry.name;
    EXPECT_EQ(entry.resume != nullptr, !entry.stages.empty()) << entry.name;
    EXPECT_NE(entry.fall_m, nullptr) << entry.name;
    EXPECT_EQ(&experiment_named(entry.name), &entry);
    EXPECT_EQ(name_of(&entry), entry.name);
    EXPECT_THAT(entry.unit, ::testing::AnyOf("mm", "deg", "kg/m3", "%")) << entry.name;
  }
  EXPECT_EQ(pictured, 1) << "a study's pictures do not say of which experiment they are";
  EXPECT_THROW(entry_of(Protocol()), std::logic_error);
  EXPECT_THAT(experiment_names(), ::testing::StartsWith("drop, tilt, roll, heap, "));
  const auto is_default = [](const ExperimentEntry& entry) { return entry.is_default; };
  EXPECT_EQ(experiment_names({.is_meant = is_default, .before = "[", .after = "]"}),
            "[drop], [tilt], [roll] or [heap]");
  EXPECT_THAT(error_of([] { experiment_named("spin"); }),
              HasSubstr("experiment spin: unknown experiment. Fix: drop,"));
}

TEST(ExperimentTable, KeysOfAProtocolAreItsNumbers) {
  Protocol protocol = DropProtocol{.height_m = .25, .grains = 3};
  const auto keys = entry_of(protocol).keys(protocol);
  ASSERT_EQ(keys.size(), 3U);
  EXPECT_EQ(keys[0].name, "height_mm");
  EXPECT_DOUBLE_EQ(value_of(keys[0]).value(), 250);
  EXPECT_EQ(value_of(keys[1]), 3);
  EXPECT_EQ(keys[2].name, "low_height_mm");
  EXPECT_EQ(with_effect(keys).size(), 2U) << "there is no second drop";

  Protocol heap = HeapProtocol{};
  const auto value = [&](const std::string& name) {
    const auto keys_of_heap = entry_of(heap).keys(heap);
    return value_of(*std::ranges::find(keys_of_heap, name, &ProtocolKey::name));
  };
  EXPECT_FALSE(value("grains")) << "as many as fit";
  EXPECT_FALSE(value("camera_distance_mm")) << "far away";
  heap.as<HeapProtocol>().camera_distance_m = 1.5;
  EXPECT_DOUBLE_EQ(value("camera_distance_mm").value(), 1500);
}

TEST(ExperimentTable, ErrorsNameTheKeyOfTheStudyAndWhetherItIsTheDefault) {
  Model model = test::sphere_bench();
  model.grain = sphere_shape(60e-3);
  const HeapProtocol heap{.tube_height_m = .11, .grains = {}};
  std::string named;
  try {
    run_heap(model, heap, 1);
  } catch (const base::InputError& error) {
    named = with_study_keys(error, heap).what();
  }
  EXPECT_THAT(named, HasSubstr("heap.tube_diameter_m is 0.1. Rule: wider than a grain is long, "
                               "0.12 m. Fix: a wider tube. ([experiment.heap] tube_diameter_mm = "
                               "100, the default)\n"));
  EXPECT_THAT(named, HasSubstr("([experiment.heap] tube_height_mm = 110)"));
  const base::InputError other({.where = "grain", .value = "it has no spheres"});
  EXPECT_STREQ(with_study_keys(other, heap).what(), "grain: it has no spheres");
}

TEST(ExperimentTable, ATiltDependsOnSlidingFrictionAlone) {
  const ExperimentEntry& tilt = *experiment_of<TiltProtocol>();
  EXPECT_TRUE(depends_on(tilt, "contact.particle_wall.sliding_friction"));
  EXPECT_FALSE(depends_on(tilt, "contact.particle_wall.restitution"));
  EXPECT_FALSE(tilt.is_stochastic);
  EXPECT_FALSE(has_grain_contacts(experiment_of<RollProtocol>()));
  EXPECT_TRUE(has_grain_contacts(experiment_of<HeapProtocol>()));
  EXPECT_TRUE(has_grain_contacts(experiment_of<GrainRollProtocol>()));
  EXPECT_FALSE(
      depends_on(*experiment_of<GrainRollProtocol>(), "contact.particle_wall.rolling_friction"));
}

TEST(ExperimentTable, EveryCoefficientIsToldByAnExperiment) {
  std::set<std::string_view> told;
  for (const ExperimentEntry& entry : all_experiments()) {
    if (entry.tells.empty()) continue;
    EXPECT_TRUE(depends_on(entry, entry.tells)) << entry.name;
    told.insert(entry.tells);
  }
  EXPECT_EQ(told.size(), 6U);
}

TEST(ExperimentTable, CostsGrowWithStiffnessAndGrains) {
  const std::set<Experiment> of_impacts = {experiment_of<DropProtocol>(),
                                           experiment_of<GrainDropProtocol>(),
                                           experiment_of<PendulumProtocol>()};
  Model model = test::sphere_bench();
  for (const ExperimentEntry& entry : all_experiments()) {
    const double cost_s = entry.cost_s(model, entry.usual);
    EXPECT_GT(cost_s, 0) << entry.name;
    Model soft = model;
    soft.stiffness_factor = .01;
    // The duration of impacts, and so the time step, goes as E^(-2/5) (Hertz). If only impacts are
    // computed, the number of steps is the same.
    const double ratio = of_impacts.contains(&entry) ? 1 : std::pow(.01, .4);
    EXPECT_NEAR(entry.cost_s(soft, entry.usual) / cost_s, ratio, 1e-6) << entry.name;
  }
  const ExperimentEntry& heap = *experiment_of<HeapProtocol>();
  EXPECT_DOUBLE_EQ(heap.cost_s(model, HeapProtocol{.grains = 100}),
                   2 * heap.cost_s(model, HeapProtocol{.grains = 50}));
}

}  // namespace
}  // namespace repose::dem
