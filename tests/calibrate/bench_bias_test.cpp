// bias_sd: the error common to all readings of a measurement.

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/study/impossible_readings.h"
#include "calibrate/study/study_problem.h"
#include "dem/study/grain_source.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/texts_of.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct BenchBias : ::testing::Test {
  dem::Study study(const std::string& tilt, const std::vector<std::string>& more = {}) {
    std::vector<std::string> settings = {"experiment.tilt.measured = " + tilt};
    settings.insert(settings.end(), more.begin(), more.end());
    return dem::read_study(folder_.write("study.toml", test::kSphereStudy), settings);
  }
  Problem problem(const std::string& tilt, const std::vector<std::string>& more = {}) {
    const dem::Study read = study(tilt, more);
    return problem_of(read, dem::build_grain(read.grain), budget_named("quick")).problem;
  }
  Observable tilt(const std::string& measured) { return problem(measured).observables.at(1); }
  std::vector<std::string> errors(const std::string& measured,
                                  const std::vector<std::string>& more = {}) {
    const dem::Study read = study(measured, more);
    return texts_of(impossible_readings(read, dem::build_grain(read.grain).shape));
  }
  TemporaryFolder folder_;
};

// JCGM 100:2008 (GUM), 5.1.2: in quadrature; a common error is not divided by their number.
TEST_F(BenchBias, IsAddedUndividedHoweverManyReadingsThereAre) {
  const Observable few = tilt("{ mean = 23.4, sd = 1.2, n = 4, bias_sd = 0.3 }");
  const Observable many = tilt("{ mean = 23.4, sd = 1.2, n = 1000000, bias_sd = 0.3 }");
  EXPECT_NEAR(with_systematic(few, standard_uncertainty(few)), std::hypot(.6, .3), 1e-12);
  EXPECT_NEAR(with_systematic(many, standard_uncertainty(many)), .3, 1e-5);
  ASSERT_EQ(few.systematic.size(), 1U);
  EXPECT_EQ(few.systematic[0].name, "bias_sd");
  EXPECT_EQ(tilt("{ values = [23, 24], bias_sd = 0.3 }").systematic_sd, .3);
  EXPECT_EQ(tilt("{ values = [23, 24] }").systematic_sd, 0);
}

TEST_F(BenchBias, IsKnownOfReadingsThatAreNotThereYet) {
  const Problem planned = problem("{ values = [23, 24], bias_sd = 0.3 }");
  EXPECT_EQ(planned.experiments.at(1).systematic_sd, .3);
  EXPECT_EQ(planned.experiments.at(0).systematic_sd, 0);
}

TEST_F(BenchBias, IsNoLargerThanWhatItIsOf) {
  EXPECT_THAT(errors("{ mean = 23.4, bias_sd = 23 }"), IsEmpty());
  EXPECT_THAT(errors("{ mean = 23.4, bias_sd = 30 }"),
              ElementsAre(AllOf(HasSubstr("[experiment.tilt] measured.bias_sd = 30 deg"),
                                HasSubstr("23.4 deg at most"), HasSubstr("Fix: "))));
  EXPECT_THAT(errors("{ values = [20, 21], bias_sd = 30 }"), ::testing::SizeIs(1));
  EXPECT_THAT(errors("{ mean = 20 }", {"experiment.drop.also_measured.lowest_point_rise_mm = "
                                       "{ mean = 20, bias_sd = 25 }"}),
              ElementsAre(HasSubstr("also_measured.lowest_point_rise_mm.bias_sd = 25 mm")));
  EXPECT_THAT(errors("{ mean = 20 }", {"experiment.drop.measured = { mean = 0, bias_sd = 0.5 }"}),
              IsEmpty())
      << "a grain that hardly rebounds, on a ruler";
}

}  // namespace
}  // namespace repose::calibrate
