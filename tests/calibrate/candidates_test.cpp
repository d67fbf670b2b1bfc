#include "calibrate/result/candidates.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "tests/calibrate/made_up_result.h"

namespace repose::calibrate {
namespace {

using ::testing::HasSubstr;

constexpr int kHeapReadings = 10;
constexpr int kHeapRuns = 41;

/// One observable; `chance` is the p-value of the agreement of its mean.
JointResult joint_with(double chance, double bench_sd, double simulated_sd) {
  JointResult joint = std::get<JointResult>(test::joint_result().found);
  joint.observables.resize(1);
  joint.surrogates.resize(1);
  ResultObservable& heap = joint.observables.front();
  heap.measured_sd = bench_sd;
  heap.measured_uncertainty = bench_sd / std::sqrt(kHeapReadings);
  heap.systematic_uncertainty = 0;
  heap.sd_assumed = false;
  heap.predicted_sd = simulated_sd;
  heap.verification->runs = 3;
  joint.surrogates.front().runs = kHeapRuns;
  joint.surrogates.front().coarse.reset();
  joint.agreement.chance = chance;
  return joint;
}

Candidate candidate(const std::string& name, double means, double scatter) {
  return {.name = name, .means = means, .scatter = scatter, .values = {}};
}

// n readings of sd s with a common error u: the uncertainty of the mean is sqrt(s^2 / n + u^2).
TEST(BenchReadings, AreCountedBesideWhatTheyHaveInCommon) {
  ResultObservable observable;
  observable.measured_sd = 3;
  observable.systematic_uncertainty = 2;
  observable.measured_uncertainty = std::sqrt(9. / 12 + 4);
  EXPECT_EQ(bench_readings(observable), 12);
}

TEST(Candidates, OneMeanThatIsTwoSigmaOffHasADevianceOfFour) {
  const double two_sided = std::erfc(2 / std::sqrt(2.));
  EXPECT_NEAR(candidate_of("model", joint_with(two_sided, 1, .5)).means, 4, 1e-6);
  EXPECT_NEAR(candidate_of("model", joint_with(1, 1, .5)).means, 0, 1e-9);
}

TEST(Candidates, ScatterThatTheBenchDoesNotHaveIsCountedAsBartlettDoes) {
  EXPECT_EQ(candidate_of("model", joint_with(1, .7, .7)).scatter, 0);
  EXPECT_EQ(candidate_of("model", joint_with(1, .7, .1)).scatter, 0)
      << "a bench may scatter for reasons of its own";
  // 9 and 40 degrees of freedom, variances 1 and 4: 49 ln(169 / 49) - 40 ln 4.
  EXPECT_NEAR(candidate_of("model", joint_with(1, 1, 2)).scatter,
              49 * std::log(169. / 49) - 40 * std::log(4.), 1e-9);
  // The scatter of coarse runs (larger grains) is not compared.
  JointResult mixed = joint_with(1, 1, 2);
  mixed.surrogates.front().runs += 70;
  mixed.surrogates.front().coarse = CoarseQuality{.size = 2, .runs = 70};
  EXPECT_EQ(candidate_of("model", mixed).scatter,
            candidate_of("model", joint_with(1, 1, 2)).scatter);
}

TEST(Candidates, AScatterThatWasOnlyAssumedSpeaksForNone) {
  JointResult joint = joint_with(1, 1, 3);
  joint.observables.front().sd_assumed = true;
  EXPECT_EQ(candidate_of("model", joint).scatter, 0);
}

TEST(Candidates, OneWithoutAReadingIsNotPreferred) {
  JointResult joint = joint_with(1, 1, 1);
  joint.observables.front().verification->runs = 0;
  const Candidate silent = candidate_of("silent", joint);
  EXPECT_TRUE(std::isinf(candidate_score(silent)));
  EXPECT_EQ(preferred({silent, candidate("other", 30, 0)}), 1U);
  EXPECT_THAT(candidates_text({silent, candidate("other", 30, 0)}),
              HasSubstr("other is the only one that gives all readings"));
  EXPECT_EQ(preferred({silent, silent}), std::nullopt);
  const Candidate read_back = candidate("silent", std::numeric_limits<double>::quiet_NaN(), 0);
  EXPECT_TRUE(std::isinf(candidate_score(read_back)));
}

TEST(Candidates, OnlyStrongEvidenceAgainstEachOtherDecides) {
  EXPECT_EQ(preferred({candidate("a", 1, 0), candidate("b", 6.9, 0)}), std::nullopt);
  EXPECT_EQ(preferred({candidate("a", 5, 3), candidate("b", 1, 0)}), 1U);
  EXPECT_EQ(preferred({candidate("a", 9, 0), candidate("b", 1, 0), candidate("c", 2, 0)}),
            std::nullopt);
  EXPECT_THAT(candidates_text({candidate("a", 5, 3), candidate("b", 1, 0)}),
              HasSubstr("b explains the bench readings best: its score is lower by 7.0"));
  EXPECT_THAT(candidates_text({candidate("a", 1, 0), candidate("b", 1, 0)}),
              HasSubstr("do not tell which"));
}

TEST(Candidates, AreKeptInTheResult) {
  StudyResult result = test::joint_result();
  auto& joint = std::get<JointResult>(result.found);
  joint.candidates = {candidate("a", 1, 2), candidate("b", 3, 0)};
  const StudyResult read = result_from_json(to_json(result), "result.json");
  EXPECT_EQ(read, result);
  EXPECT_EQ(std::get<JointResult>(read.found).candidates.at(1).means, 3);
}

}  // namespace
}  // namespace repose::calibrate
