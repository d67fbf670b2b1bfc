#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/engine/bodies.h"

namespace repose::dem {

/// Where each body was when what is near it was last listed, and how far its spheres may come from
/// there until that is due again. A margin grows with the body's speed, so that a few fast ones do
/// not cost the many slow ones.
class Margins {
 public:
  const Row& position(int body) const { return position_[static_cast<std::size_t>(body)]; }
  double margin_m(int body) const { return margin_[static_cast<std::size_t>(body)]; }

  void resize(const Bodies& bodies);
  /// From where the body is now.
  void renew(const Bodies& bodies, std::size_t body, double timestep_s);

  /// Whether some body has used up its margin.
  bool is_used_up(const Bodies& bodies, int threads) const;
  /// Notes with a 1 whose margin is half used up, with a 0 whose is not.
  void note_half_used(const Bodies& bodies, std::vector<std::uint8_t>& is_half_used,
                      int threads) const;

 private:
  // Longer than there are bodies, as their own arrays.
  std::vector<Row> position_;
  std::array<std::vector<double>, 4> orientation_;
  std::vector<double> margin_;
};

}  // namespace repose::dem
