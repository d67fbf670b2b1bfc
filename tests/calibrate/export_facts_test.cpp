#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "calibrate/export/facts.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "tests/dem/experiment_model.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

dem::Study hazelnuts_to_fit() {
  dem::Study study;
  study.model = dem::test::clump_bench();
  study.experiments[dem::experiment_of<dem::DropProtocol>()].protocol = dem::DropProtocol{};
  study.experiments[dem::experiment_of<dem::TiltProtocol>()].protocol = dem::TiltProtocol{};
  study.experiments[dem::experiment_of<dem::RollProtocol>()].protocol = dem::RollProtocol{};
  study.particle_wall.restitution.min = .1;
  study.particle_wall.restitution.max = .9;
  return study;
}

std::string facts_error(const dem::Study& study, const std::vector<FittedValue>& fitted) {
  return error_of(
      [&] { ExportFacts(study, dem::test::spheroid_clump(3), fitted, liggghts_target()); });
}

constexpr const char* kRestitution = "contact.particle_wall.restitution";

TEST(ExportFacts, TakeTheFittedValues) {
  const ExportFacts facts(hazelnuts_to_fit(), dem::test::spheroid_clump(3),
                          {{.name = kRestitution, .value = .42}}, liggghts_target());
  EXPECT_EQ(facts.study().model.grain_wall.restitution, .42);
  EXPECT_EQ(facts.study().model.grain_wall.sliding_friction, .39);
}

TEST(ExportFacts, RefuseACoefficientWithoutAValue) {
  EXPECT_THAT(facts_error(hazelnuts_to_fit(), {}),
              AllOf(HasSubstr(kRestitution), HasSubstr("Fix: ")));
  dem::Study study = hazelnuts_to_fit();
  study.particle_particle.sliding_friction.min = .1;
  study.particle_particle.sliding_friction.max = .9;
  const std::vector<FittedValue> fitted = {{.name = kRestitution, .value = .42}};
  EXPECT_EQ(facts_error(study, fitted), "") << "grains touch each other in heaps only";
  study.experiments[dem::experiment_of<dem::HeapProtocol>()].protocol = dem::HeapProtocol{};
  EXPECT_THAT(facts_error(study, fitted),
              AllOf(HasSubstr("particle_particle.sliding_friction"), Not(HasSubstr(kRestitution))));
}

TEST(ExportFacts, RefuseUnknownNamesAndNumbersThatAreNone) {
  EXPECT_THAT(facts_error(hazelnuts_to_fit(), {{.name = "contact.love", .value = 1}}),
              HasSubstr("contact.love"));
  EXPECT_THAT(
      facts_error(hazelnuts_to_fit(),
                  {{.name = kRestitution, .value = std::numeric_limits<double>::quiet_NaN()}}),
      HasSubstr(kRestitution));
}

// Johnson (1985), eqs. 4.24 and 7.43, forwards.
TEST(ExportFacts, TwoLikeBodiesHaveThePairsModuli) {
  for (const double stiff : {1e7, 1e9, 1e12}) {
    const dem::Material grain{"grain", 1000, 1e8, .38};
    const dem::Material wall{"wall", 1000, stiff, .2};
    const dem::ContactTable pair({grain, wall}, std::vector<dem::PairCoefficients>(4),
                                 dem::RollingModel::none);
    const LikeMaterial like = like_material(pair.law(0, 1));
    const dem::Material both{"both", 1000, like.young_modulus_pa, like.poisson_ratio};
    const dem::ContactTable same({both, both}, std::vector<dem::PairCoefficients>(4),
                                 dem::RollingModel::none);
    const double young = pair.law(0, 1).reduced_young_pa;
    const double shear = pair.law(0, 1).reduced_shear_pa;
    EXPECT_NEAR(same.law(0, 1).reduced_young_pa, young, 1e-9 * young);
    EXPECT_NEAR(same.law(0, 1).reduced_shear_pa, shear, 1e-9 * shear);
  }
}

TEST(HarmlessName, KeepsWordsAndTakesOutWhatBreaksDecks) {
  EXPECT_EQ(sanitized("hazel nut 2.0 (dry)"), "hazel nut 2.0 _dry_");
  EXPECT_EQ(sanitized("No\xC3\xBCsse"), "No\xC3\xBCsse");
  EXPECT_EQ(sanitized("a\nrun 1\r\t\"'`$&\\{}#*/"), "a_run 1_x0D____________");
  EXPECT_EQ(sanitized(""), "");
}

}  // namespace
}  // namespace repose::calibrate
