#include "calibrate/start/new_study.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>

#include <gmock/gmock.h>

#include "calibrate/bench/bench_readings.h"
#include "calibrate/start/usual_experiment.h"
#include "calibrate/study/study_problem.h"
#include "dem/experiment/draw_down.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"
#include "dem/study/study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::HasSubstr;

const GrainKind& grain(std::string_view name) {
  for (const GrainKind& kind : grain_kinds()) {
    if (kind.name == name) return kind;
  }
  throw std::invalid_argument(std::string(name));
}

NewStudy study_of(const GrainKind& kind, std::vector<dem::Experiment> experiments) {
  NewStudy study{.grain = kind,
                 .plate = plate_kinds()[0],
                 .sizes_mm = kind.sizes,
                 .density_kg_m3 = kind.density_kg_m3,
                 .tube_diameter_mm = usual_tube_diameter_mm(kind.sizes),
                 .experiments = std::move(experiments)};
  study.tube_height_mm = 3 * study.tube_diameter_mm;
  return study;
}

const std::vector<dem::Experiment> kAll = {
    dem::experiment_of<dem::DropProtocol>(), dem::experiment_of<dem::TiltProtocol>(),
    dem::experiment_of<dem::RollProtocol>(), dem::experiment_of<dem::HeapProtocol>()};

class NewStudyTest : public ::testing::Test {
 protected:
  dem::Study written(const NewStudy& study) const {
    const std::filesystem::path file = folder_.path() / "new.toml";
    write_new_study(study, file);
    return dem::read_study(file);
  }
  void fill_in() const {
    folder_.write("new/drops.csv", std::string("drop_mm,rebound_mm\n500,120\n500,130\n"));
    folder_.write("new/tilts.csv", std::string("angle_deg\n18\n19\n"));
    folder_.write("new/rolls.csv",
                  std::string("incline_deg,released_mm,stopped_mm\n20,150,300\n20,150,310\n"));
    folder_.write("new/heaps.csv", std::string("angle_deg\n24\n25\n"));
  }
  TemporaryFolder folder_;
};

TEST_F(NewStudyTest, OfEveryKindOfGrainAndPlateIsAStudyWithoutErrors) {
  for (const PlateKind& plate : plate_kinds()) {
    for (const GrainKind& kind : grain_kinds()) {
      const TemporaryFolder folder;
      NewStudy study = study_of(kind, kAll);
      study.plate = plate;
      const std::filesystem::path file = folder.path() / "new.toml";
      write_new_study(study, file);
      EXPECT_EQ(error_of([&] { dem::read_study(file); }), "") << kind.name << plate.name;
      EXPECT_LT(grains_in_tube(study), 5000) << kind.name;
    }
  }
}

TEST_F(NewStudyTest, AsksForNothingButItsReadings) {
  const dem::Study study = written(study_of(grain("soybean"), kAll));
  EXPECT_EQ(study.heading.title, "Soybeans on acrylic");
  const std::string empty = error_of([&] { read_sheets(study, NoRows::refused); });
  for (const char* name : {"drops", "tilts", "rolls", "heaps"}) {
    EXPECT_THAT(empty, HasSubstr(std::string("new/") + name + ".csv: no readings yet: fill in"));
  }
  fill_in();
  const StudyProblem made = problem_of(with_readings(study, read_sheets(study, NoRows::refused)),
                                       dem::build_grain(study.grain), budget_named("quick"));
  EXPECT_EQ(made.problem.parameters.size(), 6U);
  EXPECT_EQ(made.problem.observables.size(), 4U);
  EXPECT_EQ(made.problem.observables[3].mean, 24.5);
}

TEST_F(NewStudyTest, LeavesOpenWhatItsExperimentsTell) {
  const dem::Study study =
      written(study_of(grain("wheat"), {dem::experiment_of<dem::TiltProtocol>()}));
  EXPECT_TRUE(study.particle_wall.sliding_friction.is_free());
  EXPECT_FALSE(study.particle_wall.restitution.is_free());
  EXPECT_FALSE(study.particle_particle.sliding_friction.is_free());
  EXPECT_EQ(study.experiments.size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "new/tilts.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new/drops.csv"));
}

TEST_F(NewStudyTest, MarksWhatItAssumes) {
  NewStudy asked = study_of(grain("pea"), kAll);
  asked.parts.emplace(dem::WallPart::tube, plate_kinds()[3]);
  const std::vector<std::string> assumed = written(asked).assumed;
  EXPECT_EQ(assumed, assumed_names(asked));
  for (const char* name : {"particle.size_mm", "particle.density_kg_m3", "wall.tube.poisson_ratio",
                           "contact.particle_tube.restitution", "experiment.heap.tube_height_mm"}) {
    EXPECT_THAT(assumed, ::testing::Contains(name));
  }
  asked.has_own_sizes = asked.has_own_density = asked.has_own_tube = true;
  asked.parts.clear();
  EXPECT_THAT(assumed_names(asked),
              ::testing::ElementsAre("particle.young_modulus_pa", "particle.poisson_ratio",
                                     "wall.young_modulus_pa", "wall.poisson_ratio"));
}

TEST_F(NewStudyTest, CanHaveATubeOfAnotherMaterial) {
  NewStudy asked = study_of(grain("pea"), kAll);
  asked.parts.emplace(dem::WallPart::tube, plate_kinds()[3]);
  const dem::Study study = written(asked);
  const dem::WallSurface& tube = study.model.parts.at(dem::WallPart::tube);
  EXPECT_EQ(tube.material.name, plate_kinds()[3].name);
  EXPECT_EQ(tube.material.young_modulus_pa, plate_kinds()[3].young_modulus_pa);
  EXPECT_GT(tube.with_grain.sliding_friction, 0) << "assumed";
  EXPECT_NE(study.model.wall_material.name, tube.material.name);
}

TEST_F(NewStudyTest, CanHavePlatesOfGrains) {
  const dem::Study study =
      written(study_of(grain("pea"), {dem::experiment_of<dem::GrainTiltProtocol>(),
                                      dem::experiment_of<dem::GrainRollProtocol>()}));
  EXPECT_TRUE(study.particle_particle.sliding_friction.is_free());
  EXPECT_FALSE(study.particle_particle.restitution.is_free());
  EXPECT_FALSE(study.particle_wall.sliding_friction.is_free());
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "new/tilt_on_grains.csv"));
}

TEST_F(NewStudyTest, SoftensNoExperimentWhoseReadingThatWouldChange) {
  const dem::Study study =
      written(study_of(grain("pea"), {dem::experiment_of<dem::GrainDropProtocol>(),
                                      dem::experiment_of<dem::GrainTiltProtocol>(),
                                      dem::experiment_of<dem::PendulumProtocol>()}));
  EXPECT_LT(dem::model_for(study, dem::experiment_of<dem::GrainTiltProtocol>()).stiffness_factor,
            1);
  EXPECT_EQ(dem::model_for(study, dem::experiment_of<dem::GrainDropProtocol>()).stiffness_factor,
            1);
  EXPECT_EQ(dem::model_for(study, dem::experiment_of<dem::PendulumProtocol>()).stiffness_factor, 1);
}

// At 6.5 MPa beads overlap so much that a tube holds 2 % more of them; at 65 MPa they do not.
TEST_F(NewStudyTest, FillsAreStiffEnoughForTheirDensityAndLackTheirRate) {
  const dem::Study study =
      written(study_of(grain("glass"), {dem::experiment_of<dem::FillProtocol>(),
                                        dem::experiment_of<dem::DrawDownProtocol>()}));
  EXPECT_EQ(study.experiments.at(dem::experiment_of<dem::FillProtocol>()).stiffness_factor, .001);
  EXPECT_EQ(study.experiments.at(dem::experiment_of<dem::DrawDownProtocol>()).stiffness_factor,
            .0001);
  std::ifstream file(folder_.path() / "new.toml");
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_THAT(text, HasSubstr("# Until it is added below: how fast it was poured is not said"));
}

// If the pouring rate is unknown, a density is known to 3.5 % at best.
TEST_F(NewStudyTest, AFillWithoutItsRateHasASystematicUncertainty) {
  written(study_of(grain("glass"), {dem::experiment_of<dem::DropProtocol>(),
                                    dem::experiment_of<dem::FillProtocol>()}));
  const auto fill_with = [&](const std::vector<std::string>& settings) {
    std::vector<std::string> all = {
        "experiment.fill.measured = { mean = 1500, sd = 10, n = 5 }",
        "experiment.fill.also_measured.filling_height_mm = { mean = 98, sd = 1, n = 5 }"};
    all.insert(all.end(), settings.begin(), settings.end());
    const dem::Study study = dem::read_study(folder_.path() / "new.toml", all);
    return problem_of(study, dem::build_grain(study.grain), budget_named("quick"))
        .problem.observables;
  };
  const std::vector<Observable> unknown = fill_with({});
  ASSERT_EQ(unknown.size(), 2U);
  EXPECT_NEAR(unknown[0].systematic_sd, .035 * 1500, 1e-9);
  ASSERT_EQ(unknown[0].systematic.size(), 1U);
  EXPECT_EQ(unknown[0].systematic[0].name, "pouring_rate");
  EXPECT_THAT(unknown[0].systematic[0].note, HasSubstr("Fix: pour_g_s in [experiment.fill]"));
  EXPECT_EQ(unknown[1].systematic_sd, 0) << "it is struck level at the same height";
  EXPECT_EQ(fill_with({"experiment.fill.pour_g_s = 60"})[0].systematic_sd, 0);
}

TEST_F(NewStudyTest, BoxesOfADrawDownSuitTheGrains) {
  for (const GrainKind& kind : grain_kinds()) {
    const auto boxes =
        usual_experiment(*dem::experiment_of<dem::DrawDownProtocol>(), {.grain_mm = kind.sizes})
            .protocol.as<dem::DrawDownProtocol>();
    const double longest_m = *std::max_element(kind.sizes.begin(), kind.sizes.end()) / 1000;
    EXPECT_GE(boxes.slot_m, 5 * longest_m) << kind.name;
    EXPECT_GE(boxes.depth_m, 6 * longest_m) << kind.name;
    EXPECT_GE(boxes.fill_m, 6 * longest_m) << kind.name;
    EXPECT_GE(boxes.length_m, boxes.slot_m + 14 * longest_m) << kind.name;
    EXPECT_GE(boxes.drop_m, boxes.fill_m + boxes.slot_m / 2) << kind.name;
  }
}

TEST_F(NewStudyTest, HasTheTubeThatWasAskedFor) {
  NewStudy asked = study_of(grain("pea"), kAll);
  asked.tube_diameter_mm = 55;
  asked.tube_height_mm = 130;
  const dem::Study study = written(asked);
  const auto& heap = study.protocol<dem::HeapProtocol>();
  EXPECT_DOUBLE_EQ(heap.tube_diameter_m, .055);
  EXPECT_DOUBLE_EQ(heap.tube_height_m, .13);
  EXPECT_GT(heap.plate_m, 4 * heap.tube_diameter_m);
}

TEST_F(NewStudyTest, IsWrittenWholeOrNotAtAll) {
  std::string name(252, 'a');
  name += ".toml";  // longer than a file name may be, although its folder's name is not
  const std::filesystem::path file = folder_.path() / name;
  const NewStudy study = study_of(grain("rice"), kAll);
  EXPECT_NE(error_of([&] { write_new_study(study, file); }), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace repose::calibrate
