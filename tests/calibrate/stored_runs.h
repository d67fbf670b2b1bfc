#pragma once

/// Run files as written by the first version with this format. They must stay unchanged: every
/// later version must be able to read stored files.
namespace repose::calibrate::test {

/// A heap seen from two sides by a camera close to it.
inline constexpr const char* kStoredHeap = R"({
  "simulated": {
    "experiment": "heap",
    "protocol": {
      "tube_diameter_mm": 100.0,
      "tube_height_mm": 400.0,
      "tube_thickness_mm": 2.0,
      "lift_speed_mm_s": 100.0,
      "plate_mm": 400.0,
      "plate_thickness_mm": 2.0,
      "grains": 240.0
    },
    "grain": "aaccc108-84a3-56fb-a037-f5045e6e476a",
    "particle": {
      "density_kg_m3": 850.0,
      "young_modulus_pa": 1000000.0,
      "poisson_ratio": 0.38
    },
    "wall": {
      "density_kg_m3": 7850.0,
      "young_modulus_pa": 1000000000.0,
      "poisson_ratio": 0.3
    },
    "particle_wall": {
      "restitution": 0.3,
      "sliding_friction": 0.8,
      "rolling_friction": 0.3,
      "restitution_exponent": 0.1,
      "restitution_speed_m_s": 1.0
    },
    "particle_particle": {
      "restitution": 0.2,
      "sliding_friction": 0.5,
      "rolling_friction": 0.1
    },
    "rolling_model": "constant_torque",
    "stiffness_factor": 1.0,
    "timestep_fraction": 1.0,
    "timestep_s": null,
    "seed": 3,
    "simulator_version": 10
  },
  "seed": 3,
  "value": 27.75343942413844,
  "readings": {
    "angle_xz_deg": 30.12068522149811,
    "at_rest": 1.0,
    "base_radius_mm": 159.71391736676688,
    "between_views_deg": 2.0043013262856353,
    "grains": 240.0,
    "grains_off_plate": 0.0,
    "grains_on_plate": 240.0,
    "height_mm": 76.70417073342024,
    "inner_window_deg": 35.24430053261749,
    "no_heap": 0.0,
    "time_s": 2.1242465230552616
  },
  "steps": 17851,
  "timestep_s": 0.00016284128302106215,
  "clump_steps": 3822038.0,
  "views": [
    {
      "azimuth_rad": 0.0,
      "status": "flagged",
      "angle_rad": 0.504495129442101,
      "other_rad": {
        "half_height_tangent": 0.575171466474063,
        "height_over_base": 0.537720482235925,
        "inner_window": 0.5150211871794962,
        "outer_window": 0.5072712519056604,
        "whole_flank": 0.47438619585943487
      }
    },
    {
      "azimuth_rad": 1.5707963267948966,
      "status": "ok",
      "angle_rad": 0.43794488562412537,
      "other_rad": {
        "half_height_tangent": 0.5226366537896041,
        "height_over_base": 0.521643029964977,
        "inner_window": 0.5029360415355965,
        "outer_window": 0.42887564287626534,
        "whole_flank": 0.43384507509194475
      }
    }
  ],
  "camera": {
    "distance_m": 0.9,
    "height_m": 0.06
  },
  "failure": "",
  "picture_error": "",
  "wall_s": 4.246221264,
  "trajectory_s": null,
  "other_deg": {
    "half_height_tangent": 40.46838006797515,
    "height_over_base": 28.58903581268923,
    "inner_window": 35.45240036263703,
    "outer_window": 27.33341615035561,
    "whole_flank": 26.236339745617336
  },
  "fingerprint": "46874818-6ecb-5ac4-9dae-646711688906"
}
)";

/// Grains that spread to a layer: most of its readings do not exist.
inline constexpr const char* kStoredLayer = R"({
  "simulated": {
    "experiment": "heap",
    "protocol": {
      "tube_diameter_mm": 100.0,
      "tube_height_mm": 400.0,
      "tube_thickness_mm": 2.0,
      "lift_speed_mm_s": 100.0,
      "plate_mm": 400.0,
      "plate_thickness_mm": 2.0,
      "grains": 12.0
    },
    "grain": "aaccc108-84a3-56fb-a037-f5045e6e476a",
    "particle": {
      "density_kg_m3": 850.0,
      "young_modulus_pa": 1000000.0,
      "poisson_ratio": 0.38
    },
    "wall": {
      "density_kg_m3": 7850.0,
      "young_modulus_pa": 1000000000.0,
      "poisson_ratio": 0.3
    },
    "particle_wall": {
      "restitution": 0.3,
      "sliding_friction": 0.8,
      "rolling_friction": 0.3,
      "restitution_exponent": 0.1,
      "restitution_speed_m_s": 1.0
    },
    "particle_particle": {
      "restitution": 0.2,
      "sliding_friction": 0.5,
      "rolling_friction": 0.1
    },
    "rolling_model": "constant_torque",
    "stiffness_factor": 1.0,
    "timestep_fraction": 1.0,
    "timestep_s": null,
    "seed": 7,
    "simulator_version": 10
  },
  "seed": 7,
  "value": null,
  "readings": {
    "angle_xz_deg": null,
    "at_rest": 1.0,
    "base_radius_mm": null,
    "between_views_deg": null,
    "grains": 12.0,
    "grains_off_plate": 0.0,
    "grains_on_plate": 12.0,
    "height_mm": 28.281483031214748,
    "inner_window_deg": null,
    "no_heap": 1.0,
    "time_s": 0.3846421840525582
  },
  "steps": 2621,
  "timestep_s": 0.00017223264183204994,
  "clump_steps": 31041.0,
  "views": [],
  "camera": null,
  "failure": "heap: the grains spread to a layer 28.3 mm high. Rule: a heap is at least 2.5 grain diameters high; the edge of a layer is no angle of repose. Fix: more grains, or more sliding or rolling friction.",
  "picture_error": "",
  "wall_s": 0.870241414,
  "trajectory_s": null,
  "fingerprint": "8e8ae312-4e7f-5f6e-884b-d58f3b36aaff"
}
)";

}  // namespace repose::calibrate::test
