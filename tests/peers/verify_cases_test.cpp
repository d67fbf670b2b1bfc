// The cases of `repose verify` in LIGGGHTS: those that hold there, and those known to differ
// because its laws do.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/simulators/case_peers.h"
#include "dem/verify/case_peer.h"
#include "dem/verify/verify.h"
#include "tests/peers/liggghts.h"

namespace repose::testing {
namespace {

using ::testing::HasSubstr;

class LiggghtsCases : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!has_liggghts()) GTEST_SKIP() << kNoLiggghts;
    peer_ = calibrate::case_peer_of("liggghts");
  }

  std::vector<dem::CaseResult> run(const std::string& name) const {
    return dem::run_case(name, peer_.get());
  }

  std::string reason_against(const std::string& name) const {
    try {
      run(name);
    } catch (const dem::CannotRun& reason) {
      return reason.what();
    }
    return "it ran";
  }

 private:
  std::unique_ptr<const dem::CasePeer> peer_;
};

// Hertz's law, sliding friction and rolling friction are the same there, in impacts and on planes
// of any tilt.
TEST_F(LiggghtsCases, WhatHasOneLawInBothComesOutAsExpected) {
  for (const char* name :
       {"T1 two spheres, glass", "T1 two spheres, limestone", "T2 rigid wall, Al alloy",
        "T4 oblique, sliding", "T5 oblique, elastic", "sphere on an incline",
        "elastic-plastic: decay on a plane", "relative constant torque: incline, then flat"}) {
    for (const dem::CaseResult& result : run(name)) {
      EXPECT_TRUE(result.holds) << name << ", " << result.quantity << ": expected "
                                << result.expected << ", measured " << result.measured
                                << ", allowed " << result.tolerance;
    }
  }
}

TEST_F(LiggghtsCases, RestitutionComesOutWithADamperThatPulls) {
  for (const dem::CaseResult& result : run("T3 restitution, cast iron")) {
    if (result.quantity == "greatest pull, N") {
      EXPECT_GT(result.measured, 1);
    } else {
      EXPECT_TRUE(result.holds) << result.quantity << ": " << result.measured;
    }
  }
}

// Its tangential spring force is the slip times the current stiffness, S_t(now) x: as a contact
// unloads, its energy decreases without doing work, and as it loads, energy is created. Ours stays
// below 1e-4.
TEST_F(LiggghtsCases, ElasticObliqueImpactsGainEnergyThere) {
  double most = 0;
  for (const dem::CaseResult& result : run("energy of elastic oblique impacts")) {
    most = std::max(most, result.measured);
  }
  EXPECT_GT(most, .02);
  EXPECT_LT(most, .05);
}

TEST_F(LiggghtsCases, WhatItHasNotSaysWhy) {
  EXPECT_THAT(reason_against("constant torque: comes to rest"), HasSubstr("rolling friction"));
  EXPECT_THAT(reason_against("relative constant torque: incline, foot and flat"),
              HasSubstr("planes across an axis"));
  EXPECT_THAT(reason_against("restitution by speed, 0.4 at 3 m/s, exponent 0.10"),
              HasSubstr("restitution by speed"));
  EXPECT_THAT(reason_against("four spheres at once, shared damping"), HasSubstr("LIGGGHTS"));
}

}  // namespace
}  // namespace repose::testing
