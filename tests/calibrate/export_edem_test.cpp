// What an EDEM user types in, pastes and rebuilds.

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "tests/calibrate/exported_study.h"

namespace repose::calibrate {
namespace {

using test::exported;
using test::file_text;
using test::hazelnuts;
using test::kWallRolling;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(ExportToEdem, EdemsTextHasWhatDropsAreMadeFrom) {
  dem::Study study = hazelnuts();
  study.experiments[dem::experiment_of<dem::DropProtocol>()].protocol =
      dem::DropProtocol{.height_m = .25};
  study.model.wall_material.density_kg_m3 = 7850;
  EXPECT_THAT(file_text(exported(study, edem_target()), "values.txt"),
              AllOf(HasSubstr("Solids Density        7850 kg/m^3"), HasSubstr("Drop: one grain"),
                    HasSubstr("Height                0.25 m"),
                    HasSubstr("Grains                10"), Not(HasSubstr("Second height"))));
  study.experiments.erase(dem::experiment_of<dem::DropProtocol>());
  EXPECT_THAT(file_text(exported(study, edem_target()), "values.txt"),
              Not(HasSubstr("Drop: one grain")));
}

TEST(ExportToEdem, EdemIsToldItsOwnNameOfTheRollingModel) {
  using dem::RollingModel;
  for (const auto& [model, name] : {std::pair(RollingModel::constant_torque, "Standard"),
                                    {RollingModel::relative_constant_torque, "RVD"},
                                    {RollingModel::elastic_plastic, "Type C"}}) {
    const StudyExport made = exported(hazelnuts(model), edem_target(), false);
    EXPECT_THAT(file_text(made, "values.txt"), HasSubstr(std::string(name) + " Rolling Friction."));
    EXPECT_THAT(file_text(made, "README.txt"),
                HasSubstr("for EDEM: Hertz-Mindlin (no slip), " + std::string(name) +
                          " Rolling Friction\n"));
    const bool is_damped = model == RollingModel::elastic_plastic;
    for (const char* file : {"values.txt", "values.csv"}) {
      EXPECT_EQ(file_text(made, file).find("Rolling Viscous Damping Ratio") != std::string::npos,
                is_damped)
          << file << ' ' << name;
    }
    EXPECT_THAT(file_text(made, "values.csv"),
                HasSubstr("grain with wall,Coefficient of Rolling Friction,"));
  }
}

// What is needed to rebuild a heap is given next to the coefficients and their uncertainties.
TEST(ExportToEdem, EdemIsToldHowToRebuildTheHeap) {
  dem::Study study = hazelnuts();
  dem::HeapProtocol protocol;
  protocol.tube_diameter_m = .07;
  protocol.lift_speed_m_s = .045;
  protocol.grains = 321;
  study.experiments[dem::experiment_of<dem::HeapProtocol>()].protocol = protocol;
  study.model.grain_material.young_modulus_pa = 1.234567891e9;
  const StudyExport made = export_study(
      study, study.model.grain,
      {{.name = kWallRolling, .value = .1, .low = .02, .high = .2, .verdict = "bounded"}},
      {.target = edem_target()});
  const std::string values = file_text(made, "values.txt");
  EXPECT_THAT(values, AllOf(HasSubstr("inner diameter 0.07 m"), HasSubstr("321 (by the study)"),
                            HasSubstr("0.045 m/s"), HasSubstr("9.80665 m/s^2"),
                            HasSubstr("interval 0.02 to 0.2: bounded"),
                            HasSubstr("times 0.01, as simulated here: nut 4.47307e+06 Pa")))
      << values;
}

/// The spheres of a tab-separated table, below its headings.
std::vector<dem::ClumpSphere> pasted(const std::string& table) {
  std::istringstream lines(table);
  std::string headings;
  std::getline(lines, headings);
  EXPECT_EQ(std::count(headings.begin(), headings.end(), '\t'), 3);
  std::vector<dem::ClumpSphere> spheres;
  for (std::string line; std::getline(lines, line);) {
    EXPECT_EQ(std::count(line.begin(), line.end(), '\t'), 3);
    std::istringstream words(line);
    dem::ClumpSphere& sphere = spheres.emplace_back();
    words >> sphere.centre.x() >> sphere.centre.y() >> sphere.centre.z() >> sphere.radius;
  }
  return spheres;
}

TEST(ExportToEdem, EdemsSpheresCanBePasted) {
  const dem::Study study = hazelnuts();
  const auto spheres = pasted(file_text(exported(study, edem_target()), "spheres.txt"));
  ASSERT_EQ(spheres.size(), study.model.grain.spheres.size());
  for (std::size_t k = 0; k < spheres.size(); ++k) {
    EXPECT_EQ(spheres[k].centre, study.model.grain.spheres[k].centre);
    EXPECT_EQ(spheres[k].radius, study.model.grain.spheres[k].radius);
  }
}

}  // namespace
}  // namespace repose::calibrate
