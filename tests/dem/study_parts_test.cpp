#include <cmath>

#include <gmock/gmock.h>

#include "dem/experiment/draw_down.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "tests/dem/study_file.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kParts = kParticle + kWall + R"([wall.tube]
name = "acrylic"
young_modulus_pa = 3e9
poisson_ratio = 0.37
)" + kContact + R"([contact.particle_tube]
restitution = 0.4
sliding_friction = { min = 0.1, max = 0.6 }
rolling_friction = 0.02
[experiment.drop]
[experiment.tilt]
[experiment.heap]
[experiment.fill]
)";

TEST_F(StudyFile, APartMayBeOfAnotherMaterialThanThePlate) {
  const Study study = read(kParts);
  const WallSurface& tube = study.model.parts.at(WallPart::tube);
  EXPECT_EQ(tube.material.name, "acrylic");
  EXPECT_EQ(tube.material.young_modulus_pa, 3e9);
  EXPECT_EQ(tube.with_grain.restitution, .4);
  EXPECT_TRUE(std::isnan(tube.with_grain.sliding_friction)) << "to be found";
  EXPECT_EQ(study.particle_parts.at(WallPart::tube).sliding_friction.max, .6);
  EXPECT_EQ(study.model.wall_material.young_modulus_pa, 2.1e11);
  EXPECT_EQ(read(kParts, {"wall.tube.name=\"glass\""}).model.parts.at(WallPart::tube).material.name,
            "glass");
  EXPECT_THAT(read(kStudy).model.parts, IsEmpty());
}

TEST_F(StudyFile, AnExperimentHasThePartsOfItsBench) {
  const Study study = read(kParts, {"experiment.roll={}"});
  for (const Experiment experiment :
       {experiment_of<HeapProtocol>(), experiment_of<FillProtocol>()}) {
    EXPECT_TRUE(model_for(study, experiment).parts.contains(WallPart::tube));
    EXPECT_THAT(open_coefficients(study, experiment),
                ElementsAre("contact.particle_tube.sliding_friction"));
  }
  for (const Experiment experiment : {experiment_of<DropProtocol>(), experiment_of<TiltProtocol>(),
                                      experiment_of<RollProtocol>()}) {
    EXPECT_THAT(model_for(study, experiment).parts, IsEmpty());
    EXPECT_THAT(open_coefficients(study, experiment), IsEmpty());
    EXPECT_FALSE(depends_on(*experiment, "contact.particle_tube.sliding_friction"));
  }
  EXPECT_TRUE(depends_on(*experiment_of<HeapProtocol>(), "contact.particle_tube.sliding_friction"));
  EXPECT_TRUE(depends_on(*experiment_of<RollProtocol>(), "contact.particle_incline.restitution"));
  EXPECT_TRUE(
      depends_on(*experiment_of<DrawDownProtocol>(), "contact.particle_pane.rolling_friction"));
}

TEST_F(StudyFile, APartHasBothMaterialAndCoefficients) {
  EXPECT_THAT(
      errors(kStudy + "[wall.incline]\nyoung_modulus_pa = 3e9\npoisson_ratio = 0.3\n"),
      AllOf(HasSubstr("section [contact.particle_incline] is missing"),
            HasSubstr("add [contact.particle_incline] with restitution, sliding_friction")));
  const std::string alone = errors(kStudy + R"([contact.particle_pane]
restitution = 2
sliding_friction = 0.1
rolling_friction = 0.1
)");
  EXPECT_THAT(alone, AllOf(HasSubstr("contact.particle_pane has coefficients, and [wall.pane] is "
                                     "missing"),
                           HasSubstr("add [wall.pane] with young_modulus_pa and poisson_ratio"),
                           HasSubstr("contact.particle_pane.restitution = 2")));
}

TEST_F(StudyFile, AllErrorsOfPartsAreTold) {
  const std::string all = errors(kStudy + R"([wall.tubes]
young_modulus_pa = 3e9
[wall.tube]
young_modulus_pa = 3
poison_ratio = 0.3
[contact.particle_inclines]
restitution = 0.3
)");
  EXPECT_THAT(all, AllOf(HasSubstr("wall.tubes"), HasSubstr("did you mean tube?"),
                         HasSubstr("wall.tube.young_modulus_pa = 3. Rule: 1e+06 to 1.3e+12 Pa"),
                         HasSubstr("wall.tube.poisson_ratio is missing"),
                         HasSubstr("did you mean poisson_ratio?"),
                         HasSubstr("section [contact.particle_tube] is missing"),
                         HasSubstr("did you mean particle_incline?")));
  EXPECT_THAT(all, Not(HasSubstr("[wall.incline] is missing")));
  EXPECT_THAT(errors(kStudy, {"wall.tube=3"}),
              AllOf(HasSubstr("wall.tube = 3"), HasSubstr("write [wall.tube]")));
}

}  // namespace
}  // namespace repose::dem
