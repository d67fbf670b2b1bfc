#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dem/study/study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::dem {

inline const std::string kParticle = R"([particle]
size_mm = [22.48, 18.23, 17.46]
density_kg_m3 = 851
young_modulus_pa = 1.254e9
poisson_ratio = 0.38
)";
inline const std::string kWall = R"([wall]
young_modulus_pa = 2.1e11
poisson_ratio = 0.3
)";
inline const std::string kContact = R"([contact.particle_wall]
restitution = 0.31
sliding_friction = 0.39
rolling_friction = 0.04
[contact.particle_particle]
restitution = 0.11
sliding_friction = 0.21
rolling_friction = 0.04
)";
inline const std::string kDrop = "[experiment.drop]\n";
inline const std::string kStudy = kParticle + kWall + kContact + kDrop;

/// Values of --set.
using Settings = std::vector<std::string>;

/// Writes studies to a folder and reads them.
class StudyFile : public ::testing::Test {
 protected:
  Study read(const std::string& text, const Settings& settings = {}) const {
    return read_study(folder_.write("study.toml", text), settings);
  }
  /// The error message, without the folder's name; empty if there is no error.
  std::string errors(const std::string& text, const Settings& settings = {}) const {
    std::string all = error_of([&] { read(text, settings); });
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = 0; (at = all.find(folder)) != std::string::npos;) {
      all.erase(at, folder.size());
    }
    return all;
  }
  repose::testing::TemporaryFolder folder_;
};

}  // namespace repose::dem
