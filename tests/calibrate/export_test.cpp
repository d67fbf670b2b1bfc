#include "calibrate/export/export.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "dem/contact/restitution.h"
#include "dem/experiment/draw_down.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt_on_grains.h"
#include "tests/calibrate/exported_study.h"
#include "tests/calibrate/made_up_result.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using test::exported;
using test::file_text;
using test::hazelnuts;
using test::kWallRolling;
using test::names_of;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(ExportStudy, EachProgramHasItsDecksAndAReadme) {
  const std::vector<std::pair<ExportTarget, std::vector<std::string>>> expected = {
      {liggghts_target(),
       {"drop.lig", "tilt.lig", "roll.lig", "heap.lig", "clump.txt", "tube.stl"}},
      {lammps_target(), {"drop.lmp", "tilt.lmp", "roll.lmp", "tilt_body.txt"}},
      {yade_target(), {"drop.py", "tilt.py", "roll.py", "heap.py", "grain.py"}},
      {edem_target(), {"values.csv", "values.txt", "spheres.txt"}}};
  for (const auto& [target, names] : expected) {
    const StudyExport made = exported(hazelnuts(), target);
    for (const std::string& name : names) EXPECT_THAT(names_of(made), Contains(name));
    EXPECT_THAT(file_text(made, "README.txt"),
                AllOf(HasSubstr(kWallRolling), HasSubstr("What does not carry over")));
    EXPECT_THAT(made.conversions, SizeIs(6));
    for (const ExportedFile& file : made.files) {
      EXPECT_THAT(file.text, AllOf(Not(IsEmpty()), Not(HasSubstr("{{")), Not(HasSubstr("nan")),
                                   Not(HasSubstr("inf "))))
          << file.name;
    }
  }
}

TEST(ExportStudy, ExperimentsThatTheStudyDoesNotHaveHaveNoDeck) {
  dem::Study study = hazelnuts();
  study.experiments.erase(dem::experiment_of<dem::HeapProtocol>());
  study.experiments.erase(dem::experiment_of<dem::RollProtocol>());
  const StudyExport made = exported(study, liggghts_target());
  EXPECT_THAT(names_of(made), AllOf(Contains("drop.lig"), Not(Contains("heap.lig")),
                                    Not(Contains("roll.lig")), Not(Contains("tube.stl"))));
  EXPECT_THAT(made.conversions, SizeIs(3)) << "grains touch each other in heaps only";
  EXPECT_THAT(file_text(made, "README.txt"), HasSubstr("The study has no heaps."));
  EXPECT_THAT(file_text(exported(hazelnuts(), edem_target()), "README.txt"),
              HasSubstr("Young's moduli times 0.01."));
}

TEST(ExportStudy, SizesThatVaryAreSaidNotToCarryOver) {
  dem::Study study = hazelnuts();
  EXPECT_THAT(file_text(exported(study, yade_target()), "README.txt"), Not(HasSubstr("Sizes:")));
  study.model.size_cv = .043;
  EXPECT_THAT(file_text(exported(study, yade_target()), "README.txt"),
              AllOf(HasSubstr("standard deviation of 4.3 %"), HasSubstr("all have the mean size")));
  EXPECT_THAT(file_text(exported(study, edem_target()), "README.txt"),
              HasSubstr("Choose a normal size distribution with this deviation."));
}

TEST(ExportStudy, WhatHasNoDeckIsNamed) {
  dem::Study study = hazelnuts();
  study.experiments[dem::experiment_of<dem::PendulumProtocol>()].protocol = dem::PendulumProtocol{};
  study.experiments[dem::experiment_of<dem::DrawDownProtocol>()].protocol = dem::DrawDownProtocol{};
  const auto left_out = [&](ExportTarget target) {
    const std::string readme = file_text(exported(study, target), "README.txt");
    const std::string before = "Experiments of the study without a deck: ";
    const std::size_t place = readme.find(before);
    if (place == std::string::npos) return std::string();
    return readme.substr(place + before.size(), readme.find('.', place) - place - before.size());
  };
  EXPECT_EQ(left_out(liggghts_target()), "");
  EXPECT_EQ(left_out(lammps_target()), "heap, pendulum, draw_down");
  EXPECT_EQ(left_out(yade_target()), "pendulum, draw_down");
  EXPECT_EQ(left_out(edem_target()), "") << "it has tables for all of them";
}

TEST(ExportStudy, EachExperimentBetweenGrainsHasADeckForLiggghts) {
  dem::Study study = hazelnuts();
  for (const dem::Protocol& protocol :
       {dem::Protocol(dem::GrainDropProtocol{.grains = 2}),
        dem::Protocol(dem::GrainTiltProtocol{.places = 1}),
        dem::Protocol(dem::GrainRollProtocol{.places = 1}), dem::Protocol(dem::FillProtocol{}),
        dem::Protocol(dem::DrawDownProtocol{})}) {
    study.experiments[&dem::entry_of(protocol)].protocol = protocol;
  }
  const StudyExport made = exported(study, liggghts_target());
  for (const char* name :
       {"drop_on_grains.lig", "drop_on_grains_bed_2.lig", "tilt_on_grains.lig",
        "tilt_on_grains_bed_1.lig", "place_row.lig", "row.txt", "roll_on_grains.lig",
        "roll_on_grains_bed_1.lig", "fill.lig", "grain.lig", "pour.lig", "draw_down.lig",
        "slotted_floor.stl", "gate.stl"}) {
    EXPECT_THAT(names_of(made), Contains(name));
    EXPECT_THAT(file_text(made, name), AllOf(Not(HasSubstr("{{")), Not(HasSubstr("nan"))));
  }
  study.experiments[dem::experiment_of<dem::FillProtocol>()].protocol =
      dem::FillProtocol{.taps = 30};
  const StudyExport tapped = exported(study, liggghts_target());
  EXPECT_THAT(names_of(tapped), Not(Contains("fill.lig")));
  EXPECT_THAT(file_text(tapped, "README.txt"), HasSubstr("without a deck: fill."));
  study.experiments[dem::experiment_of<dem::FillProtocol>()].protocol =
      dem::FillProtocol{.pour_kg_s = .05};
  EXPECT_THAT(names_of(exported(study, liggghts_target())), Not(Contains("fill.lig")));
}

/// Nuts on steel, with a tube and an incline made of acrylic.
dem::Study on_two_materials() {
  dem::Study study = hazelnuts();
  study.model.parts[dem::WallPart::tube] = {.material = {"acrylic", 1180, 3e9, .35},
                                            .with_grain = {.5, .3, .06}};
  study.model.parts[dem::WallPart::incline] = {.material = {"wood", 700, 1e10, .4},
                                               .with_grain = {.25, .45, .07}};
  return study;
}

TEST(ExportStudy, PartsOfAnotherMaterialAreATypeOfTheirOwnInLiggghts) {
  const StudyExport made = exported(on_two_materials(), liggghts_target());
  EXPECT_THAT(file_text(made, "material.lig"),
              AllOf(HasSubstr("tube of acrylic (type 3), incline of wood (type 4): box"),
                    HasSubstr("create_box 4 box"),
                    HasSubstr("variable incline_young equal 10000000000*${stiffness}"),
                    HasSubstr("${wall_young} ${tube_young} ${incline_young}\n"),
                    HasSubstr("poissonsRatio peratomtype 0.38 0.3 0.35 0.4\n"),
                    HasSubstr("coefficientFriction peratomtypepair 4 0.21 0.39 0.3 0.45 0.39 0.39 "
                              "0.39 0.39 0.3 0.39 0.39 0.39 0.45 0.39 0.39 0.39\n")));
  EXPECT_THAT(file_text(made, "heap.lig"),
              AllOf(HasSubstr("tube.stl type 3"), HasSubstr("plate.stl type 2"),
                    HasSubstr("primitive type 3 zcylinder")));
  EXPECT_THAT(file_text(made, "roll.lig"),
              AllOf(HasSubstr("incline.stl type 4"), HasSubstr("primitive type 2 zplane")));
  EXPECT_THAT(file_text(exported(hazelnuts(), liggghts_target()), "material.lig"),
              AllOf(HasSubstr("steel (type 2): box"), HasSubstr("create_box 2 box"),
                    HasSubstr("${grain_young} ${wall_young}\n")));
}

TEST(ExportStudy, PartsOfAnotherMaterialAreInTheOtherProgramsOrSaidToHaveNoDeck) {
  const dem::Study study = on_two_materials();
  const StudyExport lammps = exported(study, lammps_target());
  EXPECT_THAT(file_text(lammps, "roll.lmp"),
              AllOf(HasSubstr("The incline is of wood"), HasSubstr("region slope\n"),
                    HasSubstr("fix flat    all wall/gran/region ${wall} region flat"),
                    Not(HasSubstr("intersect"))));
  EXPECT_THAT(lammps.conversions, SizeIs(9)) << "it has no heap, and no tube";
  EXPECT_THAT(file_text(exported(hazelnuts(), lammps_target()), "roll.lmp"),
              AllOf(HasSubstr("intersect 2 slope flat"), Not(HasSubstr("incline_normal"))));
  const StudyExport yade = exported(study, yade_target());
  EXPECT_THAT(names_of(yade), AllOf(Contains("heap.py"), Not(Contains("roll.py"))));
  EXPECT_THAT(file_text(yade, "README.txt"),
              AllOf(HasSubstr("without a deck: roll."), HasSubstr("contact.particle_tube.")));
  EXPECT_THAT(file_text(yade, "grain.py"),
              AllOf(HasSubstr("TUBE = dict(betan="), HasSubstr("('grain', 'wall', 'tube')"),
                    HasSubstr("(0, 2, value(TUBE))")));
  EXPECT_THAT(file_text(yade, "heap.py"), HasSubstr("wallMask=4, material='tube'"));
  EXPECT_THAT(file_text(exported(hazelnuts(), yade_target()), "grain.py"),
              AllOf(Not(HasSubstr("TUBE")), HasSubstr("('grain', 'wall'):")));
  const StudyExport edem = exported(study, edem_target());
  EXPECT_THAT(file_text(edem, "values.txt"), AllOf(HasSubstr("Equipment material acrylic (tube)"),
                                                   HasSubstr("Equipment material wood (incline)")));
  EXPECT_THAT(file_text(edem, "values.csv"),
              AllOf(HasSubstr("tube,Poisson's Ratio,0.35"),
                    HasSubstr("grain with incline,Coefficient of Static Friction,0.45,"),
                    HasSubstr("grain with grain,Coefficient of Static Friction,0.21,")));
}

TEST(ExportStudy, APartWithoutAnExperimentNeedsNoCoefficients) {
  dem::Study study = on_two_materials();
  dem::Coefficient& restitution = study.particle_parts[dem::WallPart::tube].restitution;
  restitution.min = .1;
  restitution.max = .9;
  EXPECT_THAT(error_of([&] { exported(study, liggghts_target()); }),
              HasSubstr("contact.particle_tube.restitution: has no value"));
  study.experiments.erase(dem::experiment_of<dem::HeapProtocol>());
  EXPECT_THAT(exported(study, liggghts_target()).conversions, SizeIs(6));
}

TEST(ExportStudy, AStudyWithoutAnyDeckIsRefused) {
  dem::Study study = hazelnuts();
  study.experiments.clear();
  study.experiments[dem::experiment_of<dem::PendulumProtocol>()].protocol = dem::PendulumProtocol{};
  EXPECT_THAT(names_of(exported(study, liggghts_target())), Contains("pendulum.lig"));
  EXPECT_THAT(error_of([&] { exported(study, yade_target()); }),
              AllOf(HasSubstr("no experiment that yade has a deck for"),
                    HasSubstr("drop, tilt, roll, heap at least")));
}

// A deck in which grains touch each other has their coefficients, with or without a heap.
TEST(ExportStudy, CoefficientsBetweenGrainsAreThoseOfTheStudy) {
  dem::Study study = hazelnuts();
  study.experiments.clear();
  study.experiments[dem::experiment_of<dem::PendulumProtocol>()].protocol = dem::PendulumProtocol{};
  study.model.grain_grain.restitution = .77;
  study.model.grain_wall.restitution = .33;
  EXPECT_THAT(file_text(exported(study, liggghts_target()), "material.lig"),
              HasSubstr("coefficientRestitution peratomtypepair 2 0.77 0.33 0.33 0.33"));
}

TEST(ExportStudy, AnotherLawIsRefusedUnlessApproximateIsAskedFor) {
  const dem::Study study = hazelnuts(dem::RollingModel::constant_torque);
  const std::string refused = error_of([&] { exported(study, liggghts_target(), false); });
  EXPECT_THAT(refused, AllOf(HasSubstr(kWallRolling), HasSubstr("--approximate"),
                             HasSubstr("contact.particle_particle.rolling_friction")));
  EXPECT_THAT(exported(study, liggghts_target()).files, Not(IsEmpty()));
  EXPECT_THAT(exported(study, edem_target(), false).files, Not(IsEmpty())) << "EDEM's own law";
  EXPECT_THAT(exported(hazelnuts(), liggghts_target(), false).files, Not(IsEmpty()));
}

// The other programs damp each contact with the whole mass of the bodies.
TEST(ExportStudy, SharedDampingIsRefusedForClumpsAndPassesForSpheres) {
  dem::Study study = hazelnuts();
  study.model.damping = dem::DampingModel::shared;
  for (const ExportTarget target : export_targets()) {
    for (const bool approximate : {false, true}) {
      EXPECT_THAT(error_of([&, of = target] { exported(study, of, approximate); }),
                  AllOf(HasSubstr("damping = \"shared\""), HasSubstr(name_of(target)),
                        HasSubstr("damping = \"per_contact\"")));
    }
  }
  study.model.grain = dem::sphere_shape(.01);
  EXPECT_THAT(exported(study, liggghts_target(), false).files, Not(IsEmpty()));
}

// In the other programs it is the same at all speeds.
TEST(ExportStudy, RestitutionThatDependsOnTheSpeedIsRefused) {
  dem::Study study = hazelnuts();
  study.model.grain_wall.restitution_exponent = .1;
  study.model.grain_wall.restitution_speed_m_s = 3;
  study.particle_wall.restitution_exponent.value = .1;
  for (const ExportTarget target : export_targets()) {
    EXPECT_THAT(error_of([&, of = target] { exported(study, of, true); }),
                AllOf(HasSubstr("contact.particle_wall.restitution_exponent = 0.1"),
                      HasSubstr(name_of(target)), HasSubstr("3 m/s"), HasSubstr("Fix:")));
  }
}

TEST(ExportStudy, MassAndInertiaAreThoseOfTheSurface) {
  const dem::Study study = hazelnuts();
  const double mass = 851 * study.model.grain.volume_m3;
  const dem::Vector inertia = mass * study.model.grain.gyration_m2;
  const auto digits = [](double value) {
    std::ostringstream text;
    text.precision(6);
    text << value;
    return text.str().substr(0, 6);
  };
  for (const auto& [target, file] : {std::pair(liggghts_target(), "drop.lig"),
                                     {yade_target(), "grain.py"},
                                     {edem_target(), "values.csv"}}) {
    const std::string text = file_text(exported(study, target), file);
    EXPECT_THAT(text, AllOf(HasSubstr(digits(mass)), HasSubstr(digits(inertia.x())),
                            HasSubstr(digits(inertia.z()))))
        << file;
  }
}

// LAMMPS takes the tensor in world axes; its trace does not depend on the pose.
TEST(ExportStudy, InertiaTurnsWithTheGrainForLammps) {
  const dem::Study study = hazelnuts();
  const double mass = 851 * study.model.grain.volume_m3;
  for (int grain = 1; grain <= 3; ++grain) {
    std::istringstream words(file_text(exported(study, lammps_target()),
                                       "drop_grain_" + std::to_string(grain) + ".txt"));
    double bodies = 0, number = 0, own_mass = 0, x = 0, y = 0, z = 0, xx = 0, yy = 0, zz = 0;
    words >> bodies >> number >> own_mass >> x >> y >> z >> xx >> yy >> zz;
    EXPECT_NEAR(own_mass, mass, 1e-12);
    EXPECT_NEAR(xx + yy + zz, mass * study.model.grain.gyration_m2.sum(), 1e-15);
  }
}

// YADE's damper never pulls, like ours; LAMMPS's may, and then gives e with the textbook factor.
TEST(ExportStudy, DampersGiveTheRestitutionInYadeAndLammps) {
  const dem::Study study = hazelnuts();
  for (const Conversion& conversion : exported(study, yade_target()).conversions) {
    if (conversion.target_name != "betan") continue;
    EXPECT_NEAR(conversion.exported, dem::damping_factor(conversion.value) / 2, 1e-12);
  }
  for (const Conversion& conversion : exported(study, lammps_target()).conversions) {
    if (conversion.target_name != "damping tsuji") continue;
    const double v = conversion.exported;
    const double alpha = 1.2728 - 4.2783 * v + 11.087 * v * v - 22.348 * std::pow(v, 3) +
                         27.467 * std::pow(v, 4) - 18.022 * std::pow(v, 5) +
                         4.8218 * std::pow(v, 6);
    EXPECT_NEAR(alpha, std::sqrt(1.5) * dem::textbook_damping_factor(conversion.value), 1e-9);
  }
}

TEST(ExportStudy, RestitutionThatLiggghtsCannotHaveIsRefused) {
  dem::Study study = hazelnuts();
  study.model.grain_wall.restitution = .03;
  const std::string refused = error_of([&] { exported(study, liggghts_target(), false); });
  EXPECT_THAT(refused, AllOf(HasSubstr("contact.particle_wall.restitution"), HasSubstr(".05")));
}

TEST(ExportStudy, WhatTheDataDidNotDetermineIsSaidInTheDeckAndAsAWarning) {
  const std::vector<FittedValue> fitted = {
      {.name = "contact.particle_particle.restitution",
       .value = .6,
       .low = .05,
       .high = .9,
       .verdict = "undetermined"},
      {.name = kWallRolling, .value = .1, .low = .09, .high = .11, .verdict = "determined"}};
  const dem::Study study = hazelnuts();
  const StudyExport made =
      export_study(study, study.model.grain, fitted, {.target = liggghts_target()});
  ASSERT_THAT(made.warnings, SizeIs(1));
  EXPECT_THAT(made.warnings[0], AllOf(HasSubstr("particle_particle.restitution"),
                                      HasSubstr("undetermined"), HasSubstr("0.05 to 0.9")));
  EXPECT_THAT(file_text(made, "material.lig"), HasSubstr("undetermined"));
}

TEST(ExportStudy, ACoefficientHasTheValueOfItsSet) {
  const std::vector<FittedValue> fitted = {
      {.name = kWallRolling, .value = .1, .low = .02, .high = .2, .verdict = "undetermined"}};
  const dem::Study study = hazelnuts();
  const auto with_set = [&](std::size_t number) {
    return export_study(study, study.model.grain, fitted,
                        {.target = edem_target(), .set_number = number}, {{.1}, {.15}});
  };
  EXPECT_EQ(with_set(1).conversions[2].value, .1);
  const StudyExport second = with_set(2);
  EXPECT_THAT(second.conversions, ::testing::Contains(::testing::Field(&Conversion::value, .15)));
  EXPECT_THAT(file_text(second, "README.txt"),
              AllOf(HasSubstr("These 2 sets"), HasSubstr("Use one set as a whole"),
                    HasSubstr("These files have set 2"),
                    HasSubstr("  set 1\n    contact.particle_wall.rolling_friction 0.1\n")));
  for (const std::size_t none : {std::size_t{0}, std::size_t{3}}) {
    EXPECT_THAT(error_of([&] { with_set(none); }),
                AllOf(HasSubstr("2 equally good sets"), HasSubstr("Fix: ")));
  }
  const StudyExport alone =
      export_study(study, study.model.grain, fitted, {.target = edem_target()}, {{.1}});
  EXPECT_THAT(file_text(alone, "README.txt"), Not(HasSubstr("Equally good sets")));
}

// A name may contain characters that end a line, a comment or a string in some program.
TEST(ExportStudy, NamesCannotBreakADeck) {
  dem::Study study = hazelnuts();
  study.model.grain_material.name = "nut\nshell rm -rf & \\\n*/ '''\" $(x) ${y} {{MASS}} ; %s";
  study.model.wall_material.name = "steel\r\nquit";
  for (const ExportTarget target : export_targets()) {
    const StudyExport clean = exported(hazelnuts(), target);
    const StudyExport odd = exported(study, target);
    ASSERT_EQ(names_of(odd), names_of(clean)) << name_of(target);
    for (std::size_t k = 0; k < odd.files.size(); ++k) {
      const std::string& text = odd.files[k].text;
      EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
                std::count(clean.files[k].text.begin(), clean.files[k].text.end(), '\n'))
          << odd.files[k].name;
      for (const char* part : {"\nshell", "\nquit", "$(x)", "*/ '''", "rm -rf &"}) {
        EXPECT_THAT(text, Not(HasSubstr(part))) << odd.files[k].name;
      }
    }
  }
}

TEST(ExportStudy, TheSameStudyGivesTheSameBytes) {
  for (const ExportTarget target : export_targets()) {
    const StudyExport one = exported(hazelnuts(), target);
    const StudyExport other = exported(hazelnuts(), target);
    for (std::size_t k = 0; k < one.files.size(); ++k) {
      EXPECT_EQ(one.files[k].text, other.files[k].text) << name_of(target);
    }
  }
}

TEST(ExportStudy, NoTextOfAStudyBecomesALineOfADeck) {
  dem::Study study = hazelnuts();
  study.hash = "h\nimport os";
  study.file = "a\r\nimport os.toml";
  study.model.grain_material.name = "nut\n\"import os";
  const std::vector<FittedValue> fitted = {{.name = "contact.particle_wall.restitution",
                                            .value = .5,
                                            .verdict = "determined &\nimport os #"}};
  for (const ExportTarget target : export_targets()) {
    for (const ExportedFile& file : export_study(study, study.model.grain, fitted,
                                                 {.target = target, .takes_approximate = true})
                                        .files) {
      std::istringstream lines(file.text);
      for (std::string line; std::getline(lines, line);) {
        EXPECT_THAT(line, Not(StartsWith("import os"))) << file.name;
        EXPECT_THAT(line, Not(HasSubstr("&import"))) << file.name;
        EXPECT_THAT(line, Not(HasSubstr("\r"))) << file.name;
      }
    }
  }
}

TEST(WriteExport, MakesTheFolderAndRefusesAFileInItsPlace) {
  const repose::testing::TemporaryFolder folder;
  write_export(folder.path() / "a" / "b", {{.name = "deck.txt", .text = "run 1\n"}});
  EXPECT_EQ(repose::testing::text_of(folder.path() / "a" / "b" / "deck.txt"), "run 1\n");
  folder.write("taken", std::string("a file"));
  EXPECT_THAT(
      error_of([&] { write_export(folder.path() / "taken", {{.name = "deck.txt", .text = ""}}); }),
      AllOf(HasSubstr("taken"), HasSubstr("Fix: ")));
}

TEST(FittedValues, AreThoseOfBothMethods) {
  const auto joint = fitted_values(test::joint_result());
  ASSERT_THAT(joint, SizeIs(2));
  EXPECT_EQ(joint[0].name, "contact.particle_wall.restitution");
  EXPECT_EQ(joint[0].high, .45);
  EXPECT_EQ(joint[1].verdict, "undetermined");
  EXPECT_EQ(exported_sets(test::joint_result()),
            (std::vector<std::vector<double>>{{.4, .3}, {.41, .5}, {.39, .7}}));
  EXPECT_THAT(exported_sets(test::published_result()), SizeIs(1));
  const auto published = fitted_values(test::published_result());
  ASSERT_THAT(published, SizeIs(2));
  EXPECT_EQ(published[0].value, .31);
  EXPECT_EQ(published[0].verdict, "");
}

}  // namespace
}  // namespace repose::calibrate
