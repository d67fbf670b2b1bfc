#include "calibrate/study/coefficients.h"

#include <array>

#include "base/input_error.h"

namespace repose::calibrate {
namespace {

struct Place {
  const char* name;
  dem::Coefficient dem::CoefficientSet::*in_study;
  double dem::PairCoefficients::*in_bench;
};

constexpr std::array<Place, 4> kPlaces = {{
    {"restitution", &dem::CoefficientSet::restitution, &dem::PairCoefficients::restitution},
    {"sliding_friction", &dem::CoefficientSet::sliding_friction,
     &dem::PairCoefficients::sliding_friction},
    {"rolling_friction", &dem::CoefficientSet::rolling_friction,
     &dem::PairCoefficients::rolling_friction},
    {"restitution_exponent", &dem::CoefficientSet::restitution_exponent,
     &dem::PairCoefficients::restitution_exponent},
}};

std::string prefix_of(dem::WallPart part) { return "contact.particle_" + name_of(part) + '.'; }

constexpr const char* kWall = "contact.particle_wall.";
constexpr const char* kParticle = "contact.particle_particle.";

}  // namespace

std::vector<NamedCoefficient> coefficients_of(const dem::Study& study) {
  std::vector<NamedCoefficient> all;
  for (const Place& place : kPlaces) {
    all.push_back({std::string(kWall) + place.name, study.particle_wall.*place.in_study});
  }
  for (const Place& place : kPlaces) {
    all.push_back({std::string(kParticle) + place.name, study.particle_particle.*place.in_study});
  }
  for (const auto& [part, set] : study.particle_parts) {
    for (const Place& place : kPlaces) {
      all.push_back({prefix_of(part) + place.name, set.*place.in_study});
    }
  }
  return all;
}

double* find_coefficient(const std::string& name, dem::Model& model) {
  for (const Place& place : kPlaces) {
    if (name == std::string(kWall) + place.name) return &(model.grain_wall.*place.in_bench);
    if (name == std::string(kParticle) + place.name) return &(model.grain_grain.*place.in_bench);
    for (auto& [part, surface] : model.parts) {
      if (name == prefix_of(part) + place.name) return &(surface.with_grain.*place.in_bench);
    }
  }
  return nullptr;
}

double& coefficient_named(const std::string& name, dem::Model& model) {
  double* found = find_coefficient(name, model);
  if (found != nullptr) return *found;
  throw base::InputError({.where = name, .value = "there is no such coefficient"});
}

}  // namespace repose::calibrate
