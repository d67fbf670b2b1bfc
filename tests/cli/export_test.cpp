#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/calibrate/made_up_result.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// A folder as repose calibrate leaves it, of a study that has ended.
class Export : public CommandTest {
 protected:
  Export() : CommandTest({"export"}) {
    folder_.write("study.toml", calibrate::test::kSphereStudy);
    run_repose(folder_, {"shape", "--size-mm", "20,20,20", "--spheres", "1", "--out", "ball.json"});
    const auto study = path("study");
    std::filesystem::create_directory(study);
    std::filesystem::copy(path("study.toml"), study / "study.toml");
    std::filesystem::copy(path("ball.json"), study / "clump.json");
    calibrate::StudyResult result = calibrate::test::joint_result();
    result.provenance.study.settings.clear();
    const calibrate::StudyIdentity& of = result.provenance.study;
    const json notes{{"program", of.program},
                     {"method", of.method},
                     {"study", {{"file", of.file}, {"hash", of.hash}, {"settings", json::array()}}},
                     {"budget", {{"name", of.budget}, {"description", of.budget_description}}},
                     {"pictures", json::array()}};
    folder_.write("study/study.json", notes.dump());
    folder_.write("study/result.json", to_json(result));
  }
};

TEST_F(Export, WritesDecksAndSaysWhatBecameOfEachCoefficient) {
  const Finished done = run({"study", "--to", "liggghts"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("particle_wall.restitution"), HasSubstr("exact"),
                              HasSubstr("study/export/liggghts")));
  EXPECT_THAT(done.err, HasSubstr("sliding_friction = 0.3 is undetermined"));
  EXPECT_THAT(text("study/export/liggghts/material.lig"), HasSubstr("peratomtypepair 2 0.4"));
  EXPECT_THAT(text("study/export/liggghts/README.txt"), HasSubstr("undetermined"));
  EXPECT_THAT(text("study/export/liggghts/drop.lig"), HasSubstr("jump drop.lig next_grain"));
}

TEST_F(Export, WritesTheSetThatIsAskedFor) {
  const Finished best = run({"study", "--to", "edem"});
  EXPECT_THAT(best.out, HasSubstr("of set 1 of 3 that fit equally well; use one together"));
  const Finished other =
      run({"study", "--to", "edem", "--set-number", "3", "--json", "other.json"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  const json made = json::parse(text("other.json"));
  EXPECT_EQ(made["set_number"], 3);
  EXPECT_EQ(made["sets"], json::parse("[[0.4, 0.3], [0.41, 0.5], [0.39, 0.7]]"));
  EXPECT_EQ(made["conversions"][0]["value"], .39);
  const Finished none = run({"study", "--to", "edem", "--set-number", "4"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err,
              HasSubstr("--set-number 4: this study has 3 equally good sets, from 1 to 3"));
  EXPECT_THAT(run({"study", "--to", "edem", "--set-number", "0"}).err, HasSubstr("Fix: "));
}

TEST_F(Export, JsonListsFilesAndConversions) {
  const Finished done = run({"study", "--to", "edem", "--out", "tables", "--json", "-"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json made = json::parse(done.out);
  EXPECT_EQ(made["target"], "edem");
  EXPECT_EQ(made["folder"], "tables");
  EXPECT_THAT(made["files"].get<Words>(), AllOf(Contains("values.csv"), Contains("README.txt")));
  EXPECT_EQ(made["conversions"][0]["coefficient"], "contact.particle_wall.restitution");
  EXPECT_EQ(made["conversions"][0]["exported"], .4);
  EXPECT_EQ(made["conversions"][2]["standing"], "exact");
  EXPECT_FALSE(made["warnings"].empty());
  EXPECT_THAT(text("tables/clump.csv"), HasSubstr("radius_m"));
}

TEST_F(Export, AnUnfinishedStudyIsRefused) {
  std::filesystem::remove(path("study/result.json"));
  const Finished refused = run({"study", "--to", "yade"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_THAT(refused.err, AllOf(HasSubstr("is unfinished"), HasSubstr("Fix: ")));
  EXPECT_FALSE(exists("study/export"));
}

TEST_F(Export, EveryErrorIsTold) {
  const Finished wrong = run({"nowhere", "--to", "excel"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("--to excel: must be one of liggghts"),
                               HasSubstr("nowhere"), HasSubstr("Fix: ")));
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"study"}).exit_code, 2);
  folder_.write("study/result.json", std::string("{"));
  const Finished damaged = run({"study", "--to", "edem"});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("result.json: is not a result"));
}

TEST_F(Export, AnotherLawIsRefusedUntilApproximateIsGiven) {
  std::string study = text("study/study.toml");
  study += "[experiment.heap]\ngrains = 20\n";
  folder_.write("study/study.toml", study);
  const Finished refused = run({"study", "--to", "lammps"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("particle_particle.rolling_friction"), HasSubstr("--approximate"),
                    Not(HasSubstr("particle_wall.rolling_friction = "))));
  EXPECT_EQ(run({"study", "--to", "lammps", "--approximate"}).exit_code, 0);
}

}  // namespace
}  // namespace repose::testing
