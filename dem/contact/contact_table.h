#pragma once

#include <vector>

#include "dem/contact/material.h"
#include "dem/contact/restitution.h"

namespace repose::dem {

/// The constants of Hertz-Mindlin contact between two materials, computed once.
struct ContactLaw {
  double reduced_young_pa = 0;    ///< E*: 1/E* = sum (1 - nu^2) / E
  double reduced_shear_pa = 0;    ///< G*: 1/G* = sum 2 (2 - nu)(1 + nu) / E
  double normal_damping = 0;      ///< factor on sqrt(S_n m*) v_n, S_n = 2 E* sqrt(R* delta)
  double tangential_damping = 0;  ///< factor on sqrt(S_n m*) v_t
  double sliding_friction = 0;
  double rolling_friction = 0;
  /// Replaces both damping factors if restitution depends on speed; its tangential factor is
  /// multiplied by tangential_root.
  SpeedDamping by_speed = {};
  double tangential_root = 1;  ///< sqrt(S_t / S_n) = sqrt(4 G* / E*)
};

/// Materials and the contact law of each pair of them: everything contacts depend on except shape.
///
/// Source of the moduli: Johnson, Contact Mechanics (1985), eqs. 4.24 and 7.43-7.44.
class ContactTable {
 public:
  /// Throws base::InputError naming every value that is out of range. `pairs` is a full symmetric
  /// matrix, row by row.
  ContactTable(std::vector<Material> materials, std::vector<PairCoefficients> pairs,
               RollingModel rolling, DampingModel damping = DampingModel::per_contact);

  const ContactLaw& law(int a, int b) const { return laws_[index(a, b)]; }
  const PairCoefficients& pair(int a, int b) const { return pairs_[index(a, b)]; }
  const Material& material(int index) const { return materials_[static_cast<std::size_t>(index)]; }
  int size() const { return static_cast<int>(materials_.size()); }
  RollingModel rolling() const { return rolling_; }
  DampingModel damping() const { return damping_; }
  /// Whether restitution depends on impact speed for any pair.
  bool is_by_speed() const { return is_by_speed_; }

 private:
  std::size_t index(int a, int b) const {
    return static_cast<std::size_t>(a) * materials_.size() + static_cast<std::size_t>(b);
  }

  std::vector<Material> materials_;
  std::vector<PairCoefficients> pairs_;
  std::vector<ContactLaw> laws_;
  RollingModel rolling_;
  DampingModel damping_;
  bool is_by_speed_ = false;
};

}  // namespace repose::dem
