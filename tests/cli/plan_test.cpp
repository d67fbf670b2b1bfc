#include <string>

#include <gmock/gmock.h>

#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// Grains of which only the restitution is free, with few grains in every experiment.
const std::string kPlannedStudy = calibrate::test::kSoftBall + R"([contact.particle_wall]
restitution = 0.5
sliding_friction = 0.3
rolling_friction = 0.05
[contact.particle_particle]
restitution = { min = 0.2, max = 0.9 }
sliding_friction = 0.4
rolling_friction = 0.04
[experiment.drop_on_grains]
height_mm = 100
grains = 4
)";

class Plan : public CommandTest {
 protected:
  Plan() : CommandTest({"plan"}) { folder_.write("study.toml", kPlannedStudy); }
};

TEST_F(Plan, NamesTheExperimentThatTellsWhatIsSoughtWithItsLinesForTheStudy) {
  const Words words = {"study.toml", "--experiments", "pendulum,drop", "--minutes",
                       "0.1",        "--json",        "plan.json"};
  const Finished done = run(words);
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("nothing measured"), HasSubstr("+ pendulum"),
                              HasSubstr("[experiment.pendulum]"), HasSubstr("release_deg = 30"),
                              HasSubstr("# columns: release_deg,swing_deg")));
  EXPECT_THAT(done.out, Not(HasSubstr("µs g")));
  const json plan = json::parse(text("plan.json"));
  ASSERT_EQ(plan["steps"].size(), 1U);
  EXPECT_EQ(plan["steps"][0]["experiment"], "pendulum");
  const std::string sought = "contact.particle_particle.restitution";
  EXPECT_LT(plan["steps"][0]["interval_widths"][sought], plan["now"]["interval_widths"][sought]);
  for (const json& experiment : plan["experiments"]) {
    EXPECT_GT(experiment["run_s"], 0) << experiment;
    EXPECT_EQ(experiment["measured"], false);
  }
  EXPECT_LE(longest_line(done.out), 80U);
  const std::string first = text("plan.json");
  Words again = words;
  again.insert(again.end(), {"--jobs", "1"});
  EXPECT_EQ(run(again).exit_code, 0);
  EXPECT_EQ(text("plan.json"), first) << "all of it is found in the folder";
}

TEST_F(Plan, TellsEveryFaultOfWhatWasTyped) {
  const Finished done = run({"study.toml", "--minutes", "0", "--readings", "x", "--jobs", "0",
                             "--experiments", "pendulums"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err,
              AllOf(HasSubstr("--minutes 0: must be"), HasSubstr("--readings x: must be"),
                    HasSubstr("--jobs 0: must be"),
                    HasSubstr("--experiments pendulums: unknown. Did you mean pendulum?")));
  EXPECT_FALSE(exists("study_calibration"));
}

TEST_F(Plan, OfAStudyThatSeeksNothingIsRefused) {
  const Finished done = run({"study.toml", "--set", "contact.particle_particle.restitution=0.3"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, HasSubstr("every coefficient has a value"));
  EXPECT_FALSE(exists("study_calibration"));
}

}  // namespace
}  // namespace repose::testing
