#pragma once

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "calibrate/study/study_problem.h"
#include "calibrate/study/study_simulator.h"
#include "dem/study/grain_source.h"
#include "dem/study/study.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate::test {

/// Tests of the soft-ball study, with settings changed by each test.
class SphereStudyTest : public ::testing::Test {
 protected:
  dem::Study read(const std::vector<std::string>& settings = {}) const {
    return dem::read_study(folder_.write("study.toml", kSphereStudy), settings);
  }

  /// Builds each grain once: building takes longer than most runs here.
  static const dem::ClumpFile& grain_of(const dem::Study& study) {
    static std::map<double, dem::ClumpFile> by_thickness;
    const auto [found, is_new] = by_thickness.try_emplace(study.grain.sizes->thickness_m);
    if (is_new) found->second = dem::build_grain(study.grain);
    return found->second;
  }

  static StudySimulator simulator_of(const dem::Study& study) {
    return {study, grain_of(study), small_problem(study).parameters, 0};
  }

  static Problem small_problem(const dem::Study& study) {
    Problem problem = problem_of(study, grain_of(study), budget_named("quick")).problem;
    problem.settings.max_jobs = 24;
    problem.settings.max_rounds = 3;
    return problem;
  }

  repose::testing::TemporaryFolder folder_;
};

}  // namespace repose::calibrate::test
