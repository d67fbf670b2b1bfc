#pragma once

#include "calibrate/experiment/json_fields.h"
#include "dem/contact/material.h"

/// What a simulation is made of, field by field: in the descriptions of stored runs and in the JSON
/// of `repose simulate`.
namespace repose::calibrate {

template <typename Io>
void fields(Io& io, Held<Io, dem::Material>& material) {
  io("density_kg_m3", material.density_kg_m3);
  io("young_modulus_pa", material.young_modulus_pa);
  io("poisson_ratio", material.poisson_ratio);
}

template <typename Io>
void fields(Io& io, Held<Io, dem::PairCoefficients>& pair) {
  io("restitution", pair.restitution);
  io("sliding_friction", pair.sliding_friction);
  io("rolling_friction", pair.rolling_friction);
  if (io.has("restitution_exponent", pair.restitution_exponent != 0)) {
    io("restitution_exponent", pair.restitution_exponent);
    io("restitution_speed_m_s", pair.restitution_speed_m_s);
  }
}

}  // namespace repose::calibrate
