#include "dem/experiment/rest_test.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dem/experiment/model_setup.h"

namespace repose::dem {
namespace {

constexpr double kEnergyFraction = 1e-6;
constexpr double kMotionFraction = 1e-3;
constexpr double kWindowFalls = 2;

/// Kinetic energy per mass, of translation and spin.
struct Energy {
  double way_m2_s2 = 0;
  double spin_m2_s2 = 0;
};

Energy energy_of(const Grain& grain, const Vector& gyration_m2) {
  const Vector own_spin = grain.orientation.conjugate() * grain.spin;
  return {.5 * grain.velocity.squaredNorm(), .5 * own_spin.cwiseAbs2().dot(gyration_m2)};
}

/// Number of contacts that support each grain, without grazing ones, whose force is so much smaller
/// than the largest that their friction has no effect.
std::vector<int> contacts_of_each(const Simulation& simulation) {
  constexpr double kGraze = .01;
  const std::vector<ContactState> all = simulation.contacts();
  const auto count = static_cast<std::size_t>(simulation.grain_count());
  const auto for_each_side = [&all](const auto& visit) {
    for (const ContactState& contact : all) {
      visit(static_cast<std::size_t>(contact.grain_a), contact.normal_force_n);
      if (contact.grain_b >= 0)
        visit(static_cast<std::size_t>(contact.grain_b), contact.normal_force_n);
    }
  };
  std::vector<double> hardest(count);
  for_each_side(
      [&](std::size_t grain, double push) { hardest[grain] = std::max(hardest[grain], push); });
  std::vector<int> contacts(count);
  for_each_side([&](std::size_t grain, double push) {
    if (push >= kGraze * hardest[grain]) ++contacts[grain];
  });
  return contacts;
}

/// Sum over all grains, per mass.
double energy_m2_s2(const Simulation& simulation) {
  const bool resists_all_spin =
      simulation.setup().contacts.rolling() == RollingModel::constant_torque;
  const std::vector<int> contacts =
      resists_all_spin ? std::vector<int>{} : contacts_of_each(simulation);
  double sum = 0;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    const Grain grain = simulation.grain(k);
    const Energy energy = energy_of(grain, shape_of(simulation, grain).gyration_m2);
    const bool is_on_the_spot = !resists_all_spin && contacts[static_cast<std::size_t>(k)] <= 1;
    sum += energy.way_m2_s2 + (is_on_the_spot ? 0 : energy.spin_m2_s2);
  }
  return sum;
}

}  // namespace

RestTest::RestTest(const SimulationSetup& setup, RestMemory memory)
    : reach_m_(reach_m(setup)), gravity_m_s2_(setup.gravity.norm()), memory_(std::move(memory)) {
  window_s_ = kWindowFalls * std::sqrt(2 * reach_m_ / gravity_m_s2_);
}

bool RestTest::is_at_rest(const Simulation& simulation) {
  std::vector<Vector> centres;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    centres.push_back(simulation.grain(k).position);
  }
  const auto count = static_cast<double>(centres.size());
  const bool is_quiet =
      energy_m2_s2(simulation) <= count * kEnergyFraction * gravity_m_s2_ * reach_m_;
  if (!is_quiet || memory_.before.size() != centres.size()) {
    memory_.before = std::move(centres);
    memory_.since_s = simulation.time_s();
    return false;
  }
  if (simulation.time_s() - memory_.since_s < window_s_) return false;
  double moved = 0;
  for (std::size_t k = 0; k < centres.size(); ++k)
    moved += (centres[k] - memory_.before[k]).squaredNorm();
  memory_.before = std::move(centres);
  memory_.since_s = simulation.time_s();
  return moved <= count * kMotionFraction * kMotionFraction * reach_m_ * reach_m_;
}

}  // namespace repose::dem
