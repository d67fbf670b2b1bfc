#include "dem/study/held_inputs.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/roll.h"
#include "tests/dem/study_file.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> names_of(const std::vector<HeldInput>& inputs) {
  std::vector<std::string> names;
  for (const HeldInput& input : inputs) names.push_back(input.name);
  return names;
}

TEST_F(StudyFile, WhatIsNotStatedAndMattersAlwaysIsAssumed) {
  const auto inputs = held_inputs(read(kStudy));
  EXPECT_THAT(names_of(inputs), ElementsAre("particle.size_percent", "particle.density_kg_m3",
                                            "particle.young_modulus_pa", "wall.young_modulus_pa"));
  for (const HeldInput& input : inputs) EXPECT_TRUE(input.is_assumed) << input.name;
  EXPECT_EQ(inputs[0].sd, 2);
  EXPECT_NEAR(inputs[1].sd, .02 * 851, 1e-9);
  EXPECT_EQ(inputs[1].unit, "kg/m3");
  EXPECT_EQ(inputs[2].step, 1.254e9) << "twice the modulus";
  EXPECT_THAT(held_inputs(read(kStudy, {"uncertainty.vary = false"})), IsEmpty());
  EXPECT_THAT(names_of(held_inputs(read(kStudy, {"uncertainty.particle.density_kg_m3 = 0"}))),
              Not(Contains("particle.density_kg_m3")))
      << "known exactly";
}

TEST_F(StudyFile, StatedUncertaintiesAreThoseOfItsOwnKeys) {
  const Study study = read(kStudy +
                           "[experiment.roll]\n[uncertainty]\nparticle.size_mm = [0.2, 0.15, 0.1]\n"
                           "particle.tip = 0.1\nexperiment.roll.incline_deg = 0.5\n");
  const auto inputs = held_inputs(study);
  EXPECT_THAT(
      names_of(inputs),
      ElementsAre("particle.size_mm.length", "particle.size_mm.width", "particle.size_mm.thickness",
                  "particle.tip", "particle.density_kg_m3", "particle.young_modulus_pa",
                  "wall.young_modulus_pa", "experiment.roll.incline_deg"));
  EXPECT_EQ(inputs.back().unit, "deg");
  EXPECT_EQ(inputs.back().sd, .5);
  EXPECT_FALSE(inputs.back().is_assumed);
  EXPECT_EQ(inputs[2].unit, "mm");
  EXPECT_NEAR(inputs[2].value, 17.46, 1e-9);
  EXPECT_TRUE(has_effect("experiment.roll.incline_deg", experiment_of<RollProtocol>()));
  EXPECT_FALSE(has_effect("experiment.roll.incline_deg", experiment_of<DropProtocol>()));
  EXPECT_FALSE(has_effect("wall.incline.young_modulus_pa", experiment_of<DropProtocol>()));
  EXPECT_TRUE(has_effect("particle.density_kg_m3", experiment_of<DropProtocol>()));
  EXPECT_THAT(inputs_taken_as_exact(study), AllOf(Contains("experiment.roll.release_mm"),
                                                  Not(Contains("experiment.roll.incline_deg"))));
  const auto down =
      held_inputs(read(kStudy, {"particle.tip = 0.95", "uncertainty.particle.tip = 0.1"}));
  const auto tip = std::ranges::find(down, "particle.tip", &HeldInput::name);
  ASSERT_NE(tip, down.end());
  EXPECT_EQ(tip->step, -.1) << "no tip is above 1";
}

TEST_F(StudyFile, EveryFaultyUncertaintyIsNamed) {
  const auto fault = [&](const std::string& setting) { return errors(kStudy, {setting}); };
  EXPECT_THAT(fault("uncertainty.particle.density = 20"), HasSubstr("did you mean density_kg_m3?"));
  EXPECT_THAT(fault("uncertainty.experiment.roll.incline_deg = 1"),
              HasSubstr("uncertainty.experiment.roll"));
  EXPECT_THAT(fault("uncertainty.experiment.drop.grains = 1"), HasSubstr("a count is exact"));
  EXPECT_THAT(fault("uncertainty.experiment.drop.low_height_mm = 1"),
              HasSubstr("the study leaves this number out"));
  EXPECT_THAT(fault("uncertainty.particle.density_kg_m3 = -1"), HasSubstr("at least 0"));
  EXPECT_THAT(fault("uncertainty.particle.tip = 3"),
              AllOf(HasSubstr("at most 1"), HasSubstr("in the unit of the number")));
  EXPECT_THAT(fault("uncertainty.particle.size_mm = [1, 2]"),
              HasSubstr("length, width and thickness"));
  EXPECT_THAT(errors(kStudy, {"uncertainty.particle.size_mm = 0.1",
                              "uncertainty.particle.size_percent = 1"}),
              HasSubstr("not both"));
  EXPECT_THAT(
      errors(kStudy, {"particle.size_mm = [20, 20, 20]", "uncertainty.particle.size_mm = 0.1"}),
      HasSubstr("a ball has one size"));
}

TEST_F(StudyFile, AChangedInputChangesThatNumberAlone) {
  Study study = read(kStudy, {"particle.size_mm = [20, 20, 20]", "particle.spheres = 1"});
  change_input(study, "experiment.drop.height_mm", 2);
  EXPECT_NEAR(study.protocol<DropProtocol>().height_m, .502, 1e-12);
  EXPECT_EQ(study.model.grain_material.density_kg_m3, 851);
  const double volume_m3 = build_grain(study.grain).shape.volume_m3;
  change_input(study, "particle.size_percent", 2);
  EXPECT_NEAR(build_grain(study.grain).shape.volume_m3, 1.02 * 1.02 * 1.02 * volume_m3,
              1e-9 * volume_m3);
  EXPECT_THAT(error_of([&] { change_input(study, "particle.colour", 1); }),
              HasSubstr("no number particle.colour"));
}

}  // namespace
}  // namespace repose::dem
