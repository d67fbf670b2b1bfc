// Values of a study that --set replaces or adds.
#include <gmock/gmock.h>

#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/study/study.h"
#include "tests/dem/study_file.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

using StudySettings = StudyFile;

TEST_F(StudySettings, SettingsReplaceAndAddValues) {
  const Study study =
      read(kStudy, {"contact.particle_wall.restitution = { min = 0.1, max = 0.5 }",
                    "contact.particle_wall.restitution.min = 0.2", "experiment.heap.grains=30",
                    "contact.rolling_model=\"none\"", "contact.damping = \"shared\"",
                    "simulation.seed = 1", "simulation.seed = 7"});
  EXPECT_FALSE(study.particle_wall.restitution.value);
  EXPECT_EQ(study.particle_wall.restitution.min, .2);
  EXPECT_EQ(study.particle_wall.restitution.max, .5);
  EXPECT_EQ(study.protocol<HeapProtocol>().grains, 30);
  EXPECT_TRUE(has_protocol(study, experiment_of<DropProtocol>())) << "the file's own sections stay";
  EXPECT_EQ(study.model.rolling, RollingModel::none);
  EXPECT_EQ(study.model.damping, DampingModel::shared);
  EXPECT_EQ(study.seed, 7U) << "the last one counts";
}

TEST_F(StudySettings, NumbersOfSettingsNeedNoDigitBeforeOrAfterTheirPoint) {
  const Study study = read(kStudy, {"particle.density_kg_m3 =900.", "wall.poisson_ratio=+.25",
                                    "contact.particle_wall.restitution={min=.2,max = .5}",
                                    "particle.name=\"a .5 \\\" .6\""});
  EXPECT_EQ(study.model.grain_material.density_kg_m3, 900);
  EXPECT_EQ(study.model.wall_material.poisson_ratio, .25);
  EXPECT_EQ(study.particle_wall.restitution.min, .2);
  EXPECT_EQ(study.particle_wall.restitution.max, .5);
  EXPECT_EQ(study.model.grain_material.name, "a .5 \" .6");
  EXPECT_THAT(errors(kStudy, {"experiment.heap.grains=-.5"}), HasSubstr("heap.grains = -0.5"));
}

TEST_F(StudySettings, ErrorsOfSettingsAreCalledBySetting) {
  EXPECT_THAT(errors(kStudy, {"simulation.seed = 3", "simulation.replicates = 0"}),
              HasSubstr("setting:2:25: simulation.replicates = 0. Rule: "));
  EXPECT_THAT(errors(kStudy, {"contact.rolling_model = none"}),
              AllOf(HasSubstr("setting:1:"), HasSubstr("in quotes"), Not(HasSubstr("missing"))));
  EXPECT_THAT(
      errors(kStudy, {"contact.damping = \"each\""}),
      AllOf(HasSubstr("contact.damping = \"each\""), HasSubstr("\"per_contact\", \"shared\"")));
  EXPECT_THAT(errors(kStudy, {"particle"}), HasSubstr("setting:1:"));
  EXPECT_THAT(errors(kStudy, {"particle.density_kg_m3 = 0,5"}), HasSubstr("as 0.5"));
  EXPECT_THAT(errors(kStudy, {"particle.densty_kg_m3 = 1"}),
              HasSubstr("did you mean density_kg_m3?"));
  EXPECT_THAT(errors(kStudy, {"particle.density_kg_m3.x = 1"}), HasSubstr("Rule: "));
}

}  // namespace
}  // namespace repose::dem
