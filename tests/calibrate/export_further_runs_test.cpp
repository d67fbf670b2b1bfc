// The study and the commands that request further runs of another program.

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "dem/contact/restitution.h"
#include "tests/calibrate/exported_study.h"

namespace repose::calibrate {
namespace {

using test::file_text;
using test::hazelnuts;
using test::names_of;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

dem::Coefficient sought_between(double min, double max) {
  dem::Coefficient coefficient;
  coefficient.min = min;
  coefficient.max = max;
  return coefficient;
}

/// Restitution between grains is determined; the verdict on their rolling friction is `verdict`.
StudyExport to_be_run_further(ExportTarget target, const std::string& verdict = "bounded") {
  dem::Study study = hazelnuts();
  study.particle_particle.restitution = sought_between(.1, .9);
  study.particle_particle.rolling_friction = sought_between(.02, .3);
  study.experiments[dem::experiment_of<dem::HeapProtocol>()].definition = "whole_flank";
  return export_study(
      study, study.model.grain,
      {{.name = "contact.particle_particle.restitution",
        .value = .5,
        .low = .45,
        .high = .55,
        .verdict = "determined"},
       {.name = "contact.particle_particle.rolling_friction", .value = .1, .verdict = verdict}},
      {.target = target, .takes_approximate = true}, {},
      {{.experiment = "drop", .unit = "mm", .mean = 9, .uncertainty = .5},
       {.experiment = "heap", .unit = "deg", .mean = 23.4, .uncertainty = .25}});
}

TEST(ExportFurtherRuns, FurtherRunsVaryWhatIsNotDetermined) {
  const std::string study = file_text(to_be_run_further(edem_target()), "further_runs.toml");
  EXPECT_THAT(
      study,
      AllOf(HasSubstr("\"grain with grain: Coefficient of Rolling Friction\" = { min = 0.02, "
                      "max = 0.3 }"),
            HasSubstr("heap = { mean = 23.4, sd = 0.25, n = 1, unit = \"deg\", definition = "
                      "\"whole_flank\" }"),
            Not(HasSubstr("drop = ")), Not(HasSubstr("Restitution\" ="))));
  EXPECT_THAT(
      file_text(to_be_run_further(edem_target(), "determined"), "further_runs.toml"),
      HasSubstr("\"grain with grain: Coefficient of Restitution\" = { min = 0.1, max = 0.9 }"));
  // The damping factor falls as restitution rises.
  const std::string dampers =
      file_text(to_be_run_further(yade_target(), "determined"), "further_runs.toml");
  EXPECT_THAT(dampers,
              HasSubstr(fmt::format("\"grain with grain: betan\" = {{ min = {:.6g}, max = "
                                    "{:.6g} }}",
                                    dem::damping_factor(.9) / 2, dem::damping_factor(.1) / 2)));
  // LAMMPS has no heap, and in no other experiment of the study do grains touch each other.
  EXPECT_THAT(names_of(to_be_run_further(lammps_target())), Not(Contains("further_runs.toml")));
  EXPECT_THAT(file_text(to_be_run_further(lammps_target()), "README.txt"),
              AllOf(HasSubstr("repose measure heap.dump --unit m --definition whole_flank"),
                    Not(HasSubstr("repose ask"))));
}

// Decks print the angle after half a millimetre of slip, whereas the laboratory gives the onset.
TEST(ExportFurtherRuns, ATiltIsNoReadingOfFurtherRunsOfDecks) {
  const auto further = [](ExportTarget target) {
    dem::Study study = hazelnuts();
    study.particle_wall.sliding_friction = sought_between(.1, .8);
    return export_study(study, study.model.grain,
                        {{.name = "contact.particle_wall.sliding_friction",
                          .value = .4,
                          .verdict = "undetermined"}},
                        {.target = target, .takes_approximate = true}, {},
                        {{.experiment = "tilt", .unit = "deg", .mean = 22.7, .uncertainty = .5},
                         {.experiment = "heap", .unit = "deg", .mean = 23.4, .uncertainty = .25}});
  };
  for (const ExportTarget target : {yade_target(), liggghts_target()}) {
    EXPECT_THAT(file_text(further(target), "further_runs.toml"), Not(HasSubstr("tilt =")));
    EXPECT_THAT(file_text(further(target), "README.txt"),
                HasSubstr("The tilt is no reading of further runs"));
  }
  EXPECT_THAT(file_text(further(edem_target()), "further_runs.toml"), HasSubstr("tilt = "));
}

}  // namespace
}  // namespace repose::calibrate
