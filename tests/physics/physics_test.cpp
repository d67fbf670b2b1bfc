#include <algorithm>
#include <cctype>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/verify/scene.h"
#include "dem/verify/verify.h"

namespace repose::dem {
namespace {

class Physics : public testing::TestWithParam<std::string> {};

TEST_P(Physics, ComesOutAsExpected) {
  const std::vector<CaseResult> results = run_case(GetParam());
  ASSERT_FALSE(results.empty());
  for (const CaseResult& result : results) {
    EXPECT_TRUE(result.holds) << result.quantity << ": expected " << result.expected
                              << ", measured " << result.measured << ", allowed "
                              << result.tolerance << ", time step " << result.timestep_s << " s ("
                              << result.source << ")";
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name;
  bool starts_word = true;
  for (const char letter : info.param) {
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) {
      starts_word = true;
      continue;
    }
    name += starts_word ? static_cast<char>(std::toupper(letter)) : letter;
    starts_word = false;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Verify, Physics, testing::ValuesIn(case_names()), test_name);

TEST(VerifyCases, EachRunsAtTwoTimeSteps) {
  const std::vector<CaseResult> results = run_case("T7 opposite spins");
  ASSERT_EQ(results.size() % 2, 0U);
  const std::size_t half = results.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    EXPECT_EQ(results[k].quantity, results[k + half].quantity);
    EXPECT_DOUBLE_EQ(results[k].timestep_s, 2 * results[k + half].timestep_s);
  }
}

TEST(VerifyCases, NumbersOutOfToleranceOrNoNumbersFail) {
  Trial trial({.name = "name", .source = "source", .run = {}}, 1);
  trial.expect("within", 1, 1.1, .11);
  trial.expect("too high", 1, 1.2, .1);
  trial.expect("too low", 1, .8, .1);
  trial.expect("no number", 1, std::nan(""), .1);
  ASSERT_EQ(trial.results().size(), 4U);
  EXPECT_TRUE(trial.results()[0].holds);
  EXPECT_FALSE(trial.results()[1].holds);
  EXPECT_FALSE(trial.results()[2].holds);
  EXPECT_FALSE(trial.results()[3].holds);
}

TEST(VerifyCases, UnknownNameIsRefused) {
  EXPECT_THROW(run_case("no such case"), base::InputError);
}

/// Our own engine in the place of another program, without means to follow a path.
class MirrorPeer : public CasePeer {
 public:
  std::string title() const override { return "mirror"; }
  std::vector<Collision> collide_each(const SimulationSetup& setup,
                                      const std::vector<Meeting>& meetings) const override {
    std::vector<Collision> collisions;
    for (const Meeting& meeting : meetings) {
      Simulation simulation(setup);
      for (const Grain& grain : meeting) simulation.add(grain);
      collisions.push_back(collide(simulation, setup.kinds[0].shape.spheres[0].radius));
    }
    return collisions;
  }
  Path follow(const SimulationSetup& /*setup*/, const std::vector<Grain>& /*grains*/,
              double /*duration_s*/, int /*every_steps*/) const override {
    throw CannotRun("a mirror stands still");
  }
  std::string changes_to(const SimulationSetup& setup) const override {
    return setup.contacts.pair(0, 0).restitution < 1 ? "a mirror loses no speed" : "";
  }
};

TEST(VerifyCases, AnotherProgramIsGivenTheSameScenes) {
  const MirrorPeer peer;
  for (const char* name : {"T1 two spheres, glass", "T8 spinning sphere on a great sphere",
                           "energy of elastic oblique impacts"}) {
    const std::vector<CaseResult> ours = run_case(name);
    const std::vector<CaseResult> theirs = run_case(name, &peer);
    ASSERT_EQ(theirs.size(), ours.size());
    for (std::size_t k = 0; k < ours.size(); ++k) {
      EXPECT_EQ(theirs[k].quantity, ours[k].quantity);
      EXPECT_EQ(theirs[k].measured, ours[k].measured) << ours[k].quantity;
      EXPECT_EQ(theirs[k].timestep_s, ours[k].timestep_s);
    }
  }
}

TEST(VerifyCases, WhatAnotherProgramCannotRunSaysWhy) {
  const MirrorPeer peer;
  std::size_t calls = 0;
  const std::vector<PeerCase> cases =
      run_cases_in(peer, [&calls](std::size_t done, std::size_t) { calls = done; });
  ASSERT_EQ(cases.size(), case_names().size());
  EXPECT_EQ(calls, cases.size());
  const auto cannot = [&cases](const std::string& name) {
    return std::ranges::find(cases, name, &PeerCase::name)->cannot;
  };
  EXPECT_EQ(cannot("bounce heights"), "a mirror stands still");
  EXPECT_EQ(cannot("tumbling free block"), "the case does more with our engine than to look on");
  EXPECT_EQ(cannot("T7 opposite spins"), "");
  for (const PeerCase& each : cases) EXPECT_NE(each.results.empty(), each.cannot.empty());
}

TEST(VerifyCases, WhatAnotherProgramTakesOtherwiseIsSaidOnceOfEachCaseThatItRuns) {
  const std::vector<PeerCase> cases = run_cases_in(MirrorPeer());
  const auto changes = [&cases](const std::string& name) {
    return std::ranges::find(cases, name, &PeerCase::name)->changes;
  };
  const std::vector<std::string> once = {"a mirror loses no speed"};
  EXPECT_EQ(changes("T3 restitution, cast iron"), once);
  EXPECT_EQ(changes("T1 two spheres, glass"), std::vector<std::string>());
  EXPECT_EQ(changes("bounce heights"), std::vector<std::string>());
}

}  // namespace
}  // namespace repose::dem
