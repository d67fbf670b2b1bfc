// What a user enters for a new study, and the resulting study.
#include "calibrate/start/new_request.h"

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class NewRequests : public ::testing::Test {
 protected:
  NewRequest request(const char* name = "peas.toml") const {
    return {.study = folder_.path() / name};
  }

  static std::string faults_of(const NewRequest& request) {
    return base::text_of(requested_study(request).faults, kNewFields);
  }

 private:
  repose::testing::TemporaryFolder folder_;
};

TEST_F(NewRequests, WhatIsNotSaidIsTheUsual) {
  const auto [study, faults] = requested_study(request());
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_EQ(study.grain.name, kUsualGrain);
  EXPECT_EQ(study.plate.name, kUsualPlate);
  EXPECT_EQ(study.experiments.size(), 4U);
  EXPECT_FALSE(study.has_own_sizes || study.has_own_density || study.has_own_tube);
  EXPECT_THAT(assumptions_of(study), Contains(Field(&Assumption::field, "size of the tube")));
}

TEST_F(NewRequests, WhatIsSaidIsTaken) {
  NewRequest peas = request();
  peas.grains = "pea";
  peas.plate = "wood";
  peas.parts = {{dem::WallPart::tube, "wood"}, {dem::WallPart::incline, "steel"}};
  peas.grain_mm = {7.5, 7, 6.5};
  peas.experiments = {"roll", "drop", "roll"};
  peas.parts.erase(dem::WallPart::tube);
  const auto [study, faults] = requested_study(peas);
  EXPECT_THAT(faults, IsEmpty());
  EXPECT_EQ(study.parts.at(dem::WallPart::incline).name, "steel");
  EXPECT_THAT(study.sizes_mm, ElementsAre(7.5, 7, 6.5));
  ASSERT_EQ(study.experiments.size(), 2U);
  EXPECT_EQ(study.experiments.front()->name, "drop");
}

TEST_F(NewRequests, EachFaultIsOfTheFieldThatHasIt) {
  NewRequest wrong = request("peas.txt");
  wrong.grains = "pee";
  wrong.parts = {{dem::WallPart::pane, "wud"}};
  wrong.density_kg_m3 = 1.3;
  wrong.experiments = {"drop", "heep"};
  wrong.tube_mm = {-1, 2};
  EXPECT_THAT(faults_of(wrong),
              AllOf(HasSubstr("peas.txt: a study's name ends in .toml"),
                    HasSubstr("kind of grain (--grains) is pee"), HasSubstr("pane (--pane) is wud"),
                    HasSubstr("density (--density-kg-m3) is 1.3"),
                    HasSubstr("experiments (--experiments) is heep"),
                    HasSubstr("size of the tube (--tube-mm) is -1 x 2 mm")));
}

TEST_F(NewRequests, ItsCommandLineSaysTheSame) {
  NewRequest peas = request();
  peas.study = "green peas.toml";
  peas.grains = "pea";
  peas.grain_mm = {7.6, 7.2, 6.9};
  peas.tube_mm = {50, 150};
  peas.parts = {{dem::WallPart::tube, "acrylic"}, {dem::WallPart::pane, ""}};
  peas.experiments = {"drop", "tilt"};
  EXPECT_EQ(new_command(peas),
            "repose new 'green peas.toml' --grains pea --grain-mm 7.6,7.2,6.9 --tube acrylic "
            "--tube-mm 50x150 --experiments drop,tilt");
}

}  // namespace
}  // namespace repose::calibrate
