#include "dem/study/study.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "tests/dem/study_file.h"
#include "tests/support/places.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::size_t lines(const std::string& text) {
  return text.empty() ? 0
                      : static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
}

TEST_F(StudyFile, TheSmallestStudyHasTheUsualValues) {
  const Study study = read(kStudy);
  EXPECT_DOUBLE_EQ(study.grain.sizes->length_m, .02248);
  EXPECT_DOUBLE_EQ(study.grain.sizes->tip_fraction, 0);
  EXPECT_EQ(study.grain.fill.spheres, 11);
  EXPECT_EQ(study.model.rolling, RollingModel::constant_torque);
  EXPECT_EQ(study.model.damping, DampingModel::per_contact);
  EXPECT_EQ(study.model.grain_wall.restitution, .31);
  EXPECT_EQ(study.model.grain_grain.sliding_friction, .21);
  EXPECT_DOUBLE_EQ(study.protocol<DropProtocol>().height_m, .5);
  EXPECT_FALSE(has_protocol(study, experiment_of<HeapProtocol>()));
  EXPECT_TRUE(measured_in(study, experiment_of<DropProtocol>()).values.empty() &&
              !measured_in(study, experiment_of<DropProtocol>()).mean);
  EXPECT_EQ(study.replicates, 1);
  EXPECT_EQ(study.seed, 1U);
  EXPECT_FALSE(study.threads);
}

TEST_F(StudyFile, GrainsMayHaveAColourForPictures) {
  EXPECT_FALSE(read(kStudy).grain_colour);
  const auto colour = read(kStudy, {"particle.colour=[255, 51, 0]"}).grain_colour;
  ASSERT_TRUE(colour);
  EXPECT_EQ(*colour, (std::array<double, 3>{1, .2, 0}));
  EXPECT_THAT(errors(kStudy, {"particle.colour=[255, 51]"}), HasSubstr("red, green and blue"));
  EXPECT_THAT(errors(kStudy, {"particle.colour=[256, 51, 0]"}), HasSubstr("particle.colour"));
}

TEST_F(StudyFile, SizesThatVaryDoSoInBulksOnly) {
  const std::string heap = "\n[experiment.heap]\n";
  const Study study = read(kStudy + heap, {"particle.size_sd_percent = 4.3"});
  EXPECT_DOUBLE_EQ(model_for(study, experiment_of<HeapProtocol>()).size_cv, .043);
  EXPECT_EQ(model_for(study, experiment_of<DropProtocol>()).size_cv, 0);
  EXPECT_EQ(read(kStudy + heap).model.size_cv, 0);
  EXPECT_THAT(errors(kStudy, {"particle.size_sd_percent = 43"}),
              HasSubstr("particle.size_sd_percent"));
  EXPECT_THAT(errors(kStudy, {"particle.size_sd_percent = -1"}),
              HasSubstr("particle.size_sd_percent"));
}

TEST_F(StudyFile, MaterialsInAnotherUnitAreFoundOut) {
  EXPECT_THAT(errors(kStudy, {"particle.young_modulus_pa=1.254"}),
              AllOf(HasSubstr("particle.young_modulus_pa = 1.254. Rule: 1e+06 to 1.3e+12 Pa"),
                    HasSubstr("Fix: 1.254e+09 if it was in GPa; or, if it is meant, add allow = "
                              "[\"young_modulus_pa\"] to [particle]")));
  EXPECT_THAT(errors(kStudy, {"particle.young_modulus_pa=1254"}), HasSubstr("if it was in MPa"));
  EXPECT_THAT(errors(kStudy, {"wall.young_modulus_pa=2.1e5"}),
              HasSubstr("2.1e+11 if it was in MPa"));
  EXPECT_THAT(errors(kStudy, {"particle.density_kg_m3=0.851"}),
              HasSubstr("851 if it was in g/cm3"));
  for (const char* real : {"1e6", "5e6", "1.3e8", "7e10", "1.2e12"}) {
    EXPECT_EQ(errors(kStudy, {std::string("particle.young_modulus_pa=") + real}), "");
  }
}

TEST_F(StudyFile, OtherMaterialsAreAllowedByName) {
  const Settings soft = {"particle.young_modulus_pa=5e4", "particle.allow=[\"young_modulus_pa\"]"};
  EXPECT_EQ(read(kStudy, soft).model.grain_material.young_modulus_pa, 5e4);
  EXPECT_THAT(errors(kStudy, {soft[0], "particle.allow=[\"density_kg_m3\"]"}),
              HasSubstr("particle.young_modulus_pa = 5e4"));
  EXPECT_THAT(errors(kStudy, {"particle.allow=[\"poisson_ratio\"]"}),
              HasSubstr("names of keys: \"young_modulus_pa\", \"density_kg_m3\""));
  EXPECT_THAT(errors(kStudy, {"particle.young_modulus_pa=1e300", soft[1]}),
              HasSubstr("at most 1e+13"));
}

TEST_F(StudyFile, KeysWithinKeysHaveAnEnd) {
  std::string key = "x";
  for (int k = 0; k < 20'000; ++k) key += ".x";
  EXPECT_THAT(errors(key + " = 1\n" + kStudy),
              HasSubstr("study.toml:1:1: a key has too many parts. Rule: at most 8 points"));
  EXPECT_THAT(errors(kStudy, {key + "=1"}), HasSubstr("setting:1:1: a key has too many parts"));
}

TEST_F(StudyFile, ManyWrongKeysAreToldShortlyAndSoon) {
  std::string text;
  for (int k = 0; k < 60'000; ++k) text += "k" + std::to_string(k) + " = 1\n";
  const std::string all = errors(text + kStudy);
  EXPECT_EQ(lines(all), 101U);
  EXPECT_THAT(all, HasSubstr("\nand 59900 more, which are not listed."));
}

TEST_F(StudyFile, NamesHaveNoControlCharacters) {
  EXPECT_THAT(errors(kStudy, {"particle.name=\"a\\u0000b\""}),
              HasSubstr("without control characters"));
}

TEST_F(StudyFile, RunsThatWouldNotEndAreRefused) {
  EXPECT_THAT(errors(kStudy, {"experiment.drop.grains=10000000"}),
              HasSubstr("a whole number from 1 to 100000"));
  EXPECT_THAT(errors(kStudy, {"simulation.timestep_fraction=1e-300"}),
              HasSubstr("a number of at least 0.001"));
}

TEST_F(StudyFile, EveryKeyReachesItsPlaceInSiUnits) {
  folder_.write("nut.stl", std::string("solid"));
  const Study study = read(R"(
[particle]
name = "nut"
scan = "nut.stl"
unit = "m"
volume_error = 0.04
density_kg_m3 = 851
young_modulus_pa = 1e9
poisson_ratio = 0.38
[wall]
name = "steel"
density_kg_m3 = 7000
young_modulus_pa = 2e11
poisson_ratio = 0
[contact]
rolling_model = "elastic_plastic"
particle_wall = { restitution = 0.01, sliding_friction = 0, rolling_friction = { min = 0, max = 0.2 } }
particle_particle = { restitution = 1, sliding_friction = 2, rolling_friction = 0.1 }
[experiment]
drop = { height_mm = 250, grains = 3, stiffness_factor = 0.5, measured = { values = [9, 9.5] } }
tilt = { bonded = 3, rate_deg_s = 1, start_deg = 5, measured = { mean = 22.7, sd = 1, n = 10 } }
roll = { incline_deg = 15, release_mm = 100 }
[experiment.heap]
tube_diameter_mm = 80
tube_height_mm = 300
tube_thickness_mm = 3
lift_speed_mm_s = 20
plate_mm = 350
plate_thickness_mm = 4
grains = 50
camera_distance_mm = 1500
camera_height_mm = 60
measured = { pictures = ["nut.stl"] }
[simulation]
timestep_s = 1e-6
replicates = 4
seed = 9
threads = 3
)");
  EXPECT_EQ(study.grain.scan, folder_.path() / "nut.stl") << "beside the study file";
  EXPECT_EQ(study.grain.scan_unit, ScanUnit::metre);
  EXPECT_EQ(study.grain.fill.volume_error, .04);
  EXPECT_EQ(study.model.wall_material.name, "steel");
  EXPECT_EQ(study.model.rolling, RollingModel::elastic_plastic);
  EXPECT_EQ(study.particle_wall.rolling_friction.max, .2);
  EXPECT_TRUE(std::isnan(study.model.grain_wall.rolling_friction)) << "to be found";
  EXPECT_DOUBLE_EQ(study.protocol<DropProtocol>().height_m, .25);
  EXPECT_EQ(study.protocol<DropProtocol>().grains, 3);
  EXPECT_EQ(model_for(study, experiment_of<DropProtocol>()).stiffness_factor, .5);
  EXPECT_THAT(measured_in(study, experiment_of<DropProtocol>()).values, ElementsAre(9, 9.5));
  EXPECT_EQ(study.protocol<TiltProtocol>().bonded, 3);
  EXPECT_EQ(study.protocol<TiltProtocol>().start_deg, 5);
  EXPECT_EQ(measured_in(study, experiment_of<TiltProtocol>()).count, 10);
  EXPECT_DOUBLE_EQ(study.protocol<RollProtocol>().release_m, .1);
  EXPECT_DOUBLE_EQ(study.protocol<HeapProtocol>().tube_diameter_m, .08);
  EXPECT_DOUBLE_EQ(study.protocol<HeapProtocol>().lift_speed_m_s, .02);
  EXPECT_DOUBLE_EQ(study.protocol<HeapProtocol>().plate_thickness_m, .004);
  EXPECT_EQ(study.protocol<HeapProtocol>().grains, 50);
  EXPECT_EQ(study.protocol<HeapProtocol>().camera_distance_m, 1.5);
  EXPECT_DOUBLE_EQ(study.protocol<HeapProtocol>().camera_height_m, .06);
  EXPECT_THAT(measured_in(study, experiment_of<HeapProtocol>()).pictures,
              ElementsAre(folder_.path() / "nut.stl"));
  EXPECT_EQ(study.model.timestep_s, 1e-6);
  EXPECT_EQ(study.replicates, 4);
  EXPECT_EQ(study.threads, 3);
}

TEST_F(StudyFile, AllErrorsAreToldAtOnceInOrderWithLineAndColumn) {
  const std::string all = errors(R"([particle]
size_mm = [22.48, -1, nan]
density_kg_m3 = 0
young_modulus_pa = "soft"
poisson_ratio = 0.5
[wall]
young_modulus_pa = inf
[contact.particle_wall]
restitution = 1.01
sliding_friction = -0.1
rolling_friction = { min = 0.2, max = 0.1 }
[experiment.drop]
grains = 2.5
[simulation]
timestep_fraction = 0
seed = -1
)");
  EXPECT_THAT(
      all,
      AllOf(HasSubstr("study.toml:2:19: particle.size_mm = -1. Rule: "),
            HasSubstr("study.toml:2:23: particle.size_mm = nan. Rule: "),
            HasSubstr("study.toml:3:17: particle.density_kg_m3 = 0. Rule: a number above 0 and at "
                      "most 1e+06. Fix: "),
            HasSubstr("study.toml:4:20: particle.young_modulus_pa = \"soft\". Rule: a number"),
            HasSubstr("study.toml:5:17: particle.poisson_ratio = 0.5. Rule: a number of at least 0 "
                      "and below 0.5. Fix: "),
            HasSubstr("study.toml:7:20: wall.young_modulus_pa = inf")));
  EXPECT_THAT(
      all, AllOf(HasSubstr("study.toml:6:1: wall.poisson_ratio is missing"),
                 HasSubstr("study.toml:9:15: contact.particle_wall.restitution = 1.01"),
                 HasSubstr("study.toml:10:20: contact.particle_wall.sliding_friction = -0.1"),
                 HasSubstr("study.toml:11:20: contact.particle_wall.rolling_friction = { min = "
                           "0.2, max = 0.1 }. Rule: "),
                 HasSubstr("section [contact.particle_particle] is missing"),
                 HasSubstr("study.toml:13:10: experiment.drop.grains = 2.5. Rule: a whole number"),
                 HasSubstr("study.toml:15:21: simulation.timestep_fraction = 0"),
                 HasSubstr("study.toml:16:8: simulation.seed = -1")));
  EXPECT_EQ(lines(all), 14U) << all;
  EXPECT_LT(all.find(":2:19"), all.find(":16:8"));
}

TEST_F(StudyFile, EveryErrorSaysHowToMendIt) {
  const std::string all = errors("[particle]\nspheres = 0\n[walls]\nx = 1\n");
  std::istringstream stream(all);
  for (std::string line; std::getline(stream, line);) {
    EXPECT_THAT(line, AllOf(HasSubstr("study.toml:"), HasSubstr(". Rule: "), HasSubstr(". Fix: ")));
  }
}

TEST_F(StudyFile, UnknownKeysAreRefusedWithTheLikelyOne) {
  const std::string all =
      errors(kStudy + "heigth_mm = 3\nqqq = 1\n[simulation]\ntimestep = 1\n[extra]\na = 1\n");
  EXPECT_THAT(all, AllOf(HasSubstr("did you mean height_mm?"),
                         HasSubstr("experiment.drop.qqq = 1: there is no such key. Rule: keys of "
                                   "[experiment.drop] are height_mm"),
                         HasSubstr("did you mean timestep_s?"), HasSubstr("extra = a section")));
  EXPECT_EQ(lines(all), 4U) << all;
}

TEST_F(StudyFile, MissingSectionsSayWhatToAdd) {
  const std::string all = errors("");
  EXPECT_THAT(
      all, AllOf(HasSubstr("section [particle] is missing"), HasSubstr("section [wall] is missing"),
                 HasSubstr("section [contact] is missing"),
                 HasSubstr("section [experiment] is missing"), HasSubstr("Fix: add ")));
  EXPECT_EQ(lines(all), 4U) << all;
}

TEST_F(StudyFile, ShapesAreExactlyOne) {
  EXPECT_THAT(errors(kStudy, {"particle.clump = \"study.toml\""}),
              HasSubstr("one shape only, and there is size_mm already"));
  EXPECT_THAT(
      errors("[particle]\ndensity_kg_m3 = 1e3\nyoung_modulus_pa = 1e9\npoisson_ratio = 0\n" +
             kWall + kContact + kDrop),
      HasSubstr("particle has no shape"));
  EXPECT_THAT(errors(kStudy, {"particle.spheres = 3", "particle.volume_error = 0.1"}),
              HasSubstr("spheres or volume_error, not both"));
  EXPECT_THAT(errors(kStudy, {"particle.unit = \"mm\""}), HasSubstr("only a scan has a unit"));
  EXPECT_THAT(errors(kStudy, {"particle.size_mm = [1, 2]"}),
              HasSubstr("length, width and thickness"));
}

TEST_F(StudyFile, FilesThatAreNotThereAreSaid) {
  std::string text = kStudy;
  text.replace(text.find("size_mm"), text.find('\n', text.find("size_mm")) - text.find("size_mm"),
               "scan = \"none.stl\"");
  EXPECT_THAT(errors(text), AllOf(HasSubstr("study.toml:2:8: particle.scan = \"none.stl\". Rule: "),
                                  HasSubstr("particle.unit is missing")));
  EXPECT_THROW(read_study(folder_.path() / "no.toml"), base::InputError);
  EXPECT_THROW(read_study(folder_.path()), base::InputError);
}

TEST_F(StudyFile, WhatSaysNothingWithoutAnotherKeyIsRefusedWithoutIt) {
  const std::string tapped = "tap_mm = 5\n[experiment.fill.also_measured]\n" +
                             std::string("hausner_ratio = { mean = 1.1 }\n");
  EXPECT_THAT(errors(kStudy + "[experiment.fill]\n" + tapped),
              AllOf(HasSubstr("experiment.fill.tap_mm needs experiment.fill.taps. Fix: add taps"),
                    HasSubstr("hausner_ratio needs experiment.fill.taps")));
  const Study study = read(kStudy + "[experiment.fill]\ntaps = 50\n" + tapped);
  EXPECT_EQ(study.protocol<FillProtocol>().taps, 50);
  EXPECT_DOUBLE_EQ(study.protocol<FillProtocol>().tap_m, .005);
}

TEST_F(StudyFile, WhatIsSoughtMayHaveAValueForRunsBefore) {
  const Study study =
      read(kStudy, {"contact.particle_wall.restitution = "
                    "{ value = 0.3, min = 0.1, max = 0.6, mean = 0.35, sd = 0.1 }"});
  const Coefficient& restitution = study.particle_wall.restitution;
  EXPECT_TRUE(restitution.is_free());
  EXPECT_EQ(restitution.value, .3);
  EXPECT_EQ(restitution.known_mean, .35);
  EXPECT_EQ(restitution.known_sd, .1);
  EXPECT_EQ(study.model.grain_wall.restitution, .3);
  EXPECT_THAT(open_coefficients(study, experiment_of<DropProtocol>()), IsEmpty());
  EXPECT_FALSE(study.particle_wall.sliding_friction.is_free());
}

TEST_F(StudyFile, BoundsSayWhatTheyAreAndWhatWidthIsUseful) {
  const std::string key = "contact.particle_wall.restitution = ";
  const Coefficient unsaid =
      read(kStudy, {key + "{ min = 0.1, max = 0.6 }"}).particle_wall.restitution;
  EXPECT_FALSE(unsaid.are_bounds_known);
  EXPECT_FALSE(unsaid.useful_half_width);
  const Coefficient said =
      read(kStudy, {key + "{ min = 0.1, max = 0.6, bounds = \"convenience\", useful_half_width = "
                          "0.05 }"})
          .particle_wall.restitution;
  EXPECT_EQ(said.are_bounds_known, false);
  EXPECT_EQ(said.useful_half_width, .05);
  EXPECT_THAT(errors(kStudy, {key + "{ min = 0.1, max = 0.6, bounds = \"sure\" }"}),
              AllOf(HasSubstr("bounds = \"sure\""), HasSubstr("\"known\"")));
  EXPECT_THAT(errors(kStudy, {key + "{ min = 0.1, max = 0.6, useful_half_width = 0 }"}),
              HasSubstr("useful_half_width = 0"));
}

TEST_F(StudyFile, BoundsThatMakeNoSenseAreRefused) {
  const std::string key = "contact.particle_wall.restitution = ";
  EXPECT_THAT(errors(kStudy, {key + "{ value = 0.8, min = 0.1, max = 0.6 }"}),
              HasSubstr("value within min and max"));
  EXPECT_THAT(errors(kStudy, {key + "{ mean = 0.8, sd = 0.1, min = 0.1, max = 0.6 }"}),
              HasSubstr("mean within min and max"));
  EXPECT_THAT(errors(kStudy, {key + "{ mean = 0.3, min = 0.1, max = 0.6 }"}),
              HasSubstr("has a mean and no sd"));
  EXPECT_THAT(errors(kStudy, {key + "{ min = 0.1 }"}), HasSubstr("restitution.max is missing"));
  EXPECT_THAT(errors(kStudy, {key + "{ min = 0, max = 0.6 }"}), HasSubstr("restitution.min = 0"));
  EXPECT_THAT(errors(kStudy, {key + "{ min = 0.1, max = 0.1 }"}), HasSubstr("min below max"));
}

TEST_F(StudyFile, SaysWhatIsAssumed) {
  EXPECT_THAT(read(kStudy).assumed, ::testing::IsEmpty());
  EXPECT_THAT(read("[study]\nassumed = []\n" + kStudy).assumed, ::testing::IsEmpty());
  EXPECT_THAT(read("[study]\nassumed = [\"particle.density_kg_m3\", \"wall.poisson_ratio\", "
                   "\"wall.poisson_ratio\"]\n" +
                   kStudy)
                  .assumed,
              ::testing::ElementsAre("particle.density_kg_m3", "wall.poisson_ratio"));
  EXPECT_THAT(
      errors("[study]\nassumed = [\"particle.densty_kg_m3\", \"wall.colour\"]\n" + kStudy),
      AllOf(HasSubstr("study.assumed names \"particle.densty_kg_m3\", which is not in this study"),
            HasSubstr("write particle.density_kg_m3, or take it out"),
            HasSubstr("names \"wall.colour\"")));
  EXPECT_THAT(errors("[study]\nassumed = \"particle\"\n" + kStudy), HasSubstr("within brackets"));
}

TEST_F(StudyFile, SaysWhatAReportIsCalled) {
  EXPECT_EQ(read(kStudy).heading.title, "");
  const Study study = read("[study]\ntitle = \"Soybeans\"\nauthor = \"A. Smith\"\n" + kStudy);
  EXPECT_EQ(study.heading.title, "Soybeans");
  EXPECT_EQ(study.heading.author, "A. Smith");
  EXPECT_THAT(errors("[study]\ntittle = 3\nnote = 7\n" + kStudy),
              AllOf(HasSubstr("did you mean title?"), HasSubstr("study.note = 7")));
}

TEST_F(StudyFile, TextThatIsNoTomlIsSaidWithItsPlace) {
  EXPECT_THAT(errors("[particle]\nsize_mm = [1, 2\nname = 'x'\n"),
              AllOf(HasSubstr("study.toml:3:"), HasSubstr("Rule: the text must be TOML")));
  EXPECT_THAT(errors(kStudy + kDrop), HasSubstr("study.toml:18:")) << "a section given twice";
  EXPECT_NE(errors(std::string("\0\xff\xfe", 3)), "");
}

TEST_F(StudyFile, RestitutionMayDependOnTheSpeed) {
  EXPECT_EQ(read(kStudy).particle_wall.restitution_exponent.value, 0) << "not by default";
  const std::string speed = "contact.particle_wall.restitution_speed_m_s = 3";
  const std::string exponent = "contact.particle_wall.restitution_exponent = ";
  const Study known = read(kStudy, {exponent + "0.1", speed});
  EXPECT_EQ(known.model.grain_wall.restitution_exponent, .1);
  EXPECT_EQ(known.model.grain_wall.restitution_speed_m_s, 3);
  EXPECT_EQ(known.model.grain_grain.restitution_exponent, 0);
  const Study sought = read(kStudy, {exponent + "{ min = 0, max = 0.25 }", speed});
  EXPECT_TRUE(sought.particle_wall.restitution_exponent.is_free());
  EXPECT_THAT(open_coefficients(sought, experiment_of<DropProtocol>()),
              Contains("contact.particle_wall.restitution_exponent"));
  EXPECT_TRUE(
      depends_on(*experiment_of<DropProtocol>(), "contact.particle_wall.restitution_exponent"));
  EXPECT_FALSE(
      depends_on(*experiment_of<TiltProtocol>(), "contact.particle_wall.restitution_exponent"));
  EXPECT_THAT(errors(kStudy, {exponent + "0.1"}),
              HasSubstr("restitution_exponent is given without restitution_speed_m_s"));
  EXPECT_THAT(errors(kStudy, {speed}),
              HasSubstr("restitution_speed_m_s is given without restitution_exponent"));
  EXPECT_THAT(
      errors(kStudy, {exponent + "0.5", speed}),
      HasSubstr("restitution_exponent = 0.5. Rule: a number of at least 0 and at most 0.25"));
  EXPECT_THAT(errors(kStudy, {exponent + "0.1", speed, "contact.particle_wall.restitution = 1"}),
              HasSubstr("at most 0.99"));
}

TEST_F(StudyFile, ATiltBeginsBelowWhereItEnds) {
  EXPECT_THAT(
      errors(kStudy, {"experiment.tilt.start_deg = 89"}),
      HasSubstr("experiment.tilt.start_deg = 89. Rule: a number of at least 0 and below 89"));
}

TEST_F(StudyFile, FingerprintsTellStudiesApart) {
  const std::string hash = read(kStudy).hash;
  EXPECT_EQ(hash.size(), 36U);
  EXPECT_EQ(read(kStudy).hash, hash);
  EXPECT_NE(read(kStudy + " ").hash, hash);
  EXPECT_NE(read(kStudy, {"simulation.seed = 1"}).hash, hash);
}

TEST_F(StudyFile, ADropMayHaveALowerHeightToo) {
  const std::string also = "experiment.drop.also_measured={low_rebound_mm={mean=15,sd=1,n=5}}";
  const Study study = read(kStudy, {"experiment.drop.low_height_mm=50", also});
  EXPECT_EQ(study.protocol<DropProtocol>().low_height_m, .05);
  EXPECT_EQ(measured_in(study, experiment_of<DropProtocol>()).also.at(0).name, "low_rebound_mm");
  EXPECT_FALSE(read(kStudy).protocol<DropProtocol>().low_height_m);
  EXPECT_THAT(errors(kStudy, {also}), HasSubstr("needs experiment.drop.low_height_mm"));
  EXPECT_THAT(errors(kStudy, {"experiment.drop.low_height_mm=0"}),
              HasSubstr("experiment.drop.low_height_mm = 0. Rule: a number above 0"));
}

TEST_F(StudyFile, OpenCoefficientsAreNamedWhereTheyMatter) {
  const Study study = read(kStudy, {"contact.particle_wall.restitution = { min = 0.1, max = 0.5 }",
                                    "contact.particle_particle.sliding_friction = {min=0,max=1}"});
  EXPECT_THAT(open_coefficients(study, experiment_of<DropProtocol>()),
              ElementsAre("contact.particle_wall.restitution"));
  EXPECT_THAT(open_coefficients(study, experiment_of<HeapProtocol>()),
              ElementsAre("contact.particle_wall.restitution",
                          "contact.particle_particle.sliding_friction"));
  EXPECT_FALSE(
      std::isnan(model_for(study, experiment_of<RollProtocol>()).grain_grain.sliding_friction));
  EXPECT_TRUE(
      std::isnan(model_for(study, experiment_of<HeapProtocol>()).grain_grain.sliding_friction));
}

TEST(HazelnutStudy, IsThePublishedOne) {
  const Study study = read_study(testing::source_folder() / "samples/hazelnut/study.toml");
  EXPECT_EQ(study.model.grain_material.density_kg_m3, 851);
  EXPECT_EQ(study.model.grain_wall.restitution, .31);
  EXPECT_EQ(study.model.grain_grain.restitution, .11);
  EXPECT_EQ(measured_in(study, experiment_of<DropProtocol>()).mean, 9.42);
  EXPECT_EQ(measured_in(study, experiment_of<TiltProtocol>()).mean, 22.70);
  EXPECT_EQ(measured_in(study, experiment_of<RollProtocol>()).mean, 322.81);
  EXPECT_EQ(measured_in(study, experiment_of<HeapProtocol>()).sd, .72);
  EXPECT_EQ(study.protocol<HeapProtocol>().grains, 455);
  for (const Experiment experiment :
       {experiment_of<DropProtocol>(), experiment_of<TiltProtocol>(), experiment_of<RollProtocol>(),
        experiment_of<HeapProtocol>()}) {
    EXPECT_THAT(open_coefficients(study, experiment), IsEmpty());
  }
}

TEST_F(StudyFile, GrainsAreBuiltFromSizes) {
  const Study study = read(kStudy, {"particle.spheres = 3"});
  const ClumpFile grain = build_grain(study.grain);
  EXPECT_EQ(grain.shape.spheres.size(), 3U);
  // An ellipsoid of these sizes, less the volume that the polyhedron lacks.
  EXPECT_NEAR(grain.shape.volume_m3, M_PI / 6 * 22.48e-3 * 18.23e-3 * 17.46e-3, 2e-8);
  EXPECT_THAT(grain.source, HasSubstr("22.48 x 18.23 x 17.46 mm"));
  EXPECT_THROW(build_grain({}), base::InputError);
}

}  // namespace
}  // namespace repose::dem
