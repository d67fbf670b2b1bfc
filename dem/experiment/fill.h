#pragma once

#include <cstdint>
#include <optional>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// A tube filled by pouring, optionally tapped, and struck level at its rim.
///
/// The grains fall from a spout `pour_m` above the rim, at random places over the tube and in
/// random poses, until they heap over the rim and rest. Those whose centres of mass lie above the
/// rim are struck off; all others count in full. They are poured either as fast as they fall, layer
/// upon layer, which fills a tube of 150 mm in half a second, or one by one at `pour_kg_s`: slowly
/// poured grains have time to settle and pack denser. Value: bulk density, kg/m^3: the mass of the
/// remaining grains divided by the tube's volume. Readings: "grains", "mass_g", "solid_fraction",
/// "filling_height_mm" (mean height of the upper surface of the remaining grains, over the tube's
/// whole width).
///
/// For tapping, the tube has a collar of a third of its height, as in Carr (1965, Chemical
/// Engineering 72 (2), 163): it is filled over the collar's rim, dropped `taps` times by `tap_m`
/// onto a rigid base (filling.h), and struck level at its own rim. The value is then the tapped
/// bulk density, and "hausner_ratio" its ratio to the density before tapping (Hausner 1967,
/// International Journal of Powder Metallurgy 3 (4), 7). Throws NoMeasurement if the grains sink
/// below the rim.
struct FillProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .1;
  double pour_m = .05;                   ///< from the spout to the rim, or to the collar's rim
  std::optional<double> pour_kg_s = {};  ///< std::nullopt: as fast as grains fall
  std::optional<int> taps = {};          ///< std::nullopt: not tapped
  double tap_m = .003;                   ///< drop height of ISO 3953
};
inline constexpr int kMaxTaps = 10'000;
/// Longest pour: longer ones cost too much, and hardly pack denser.
inline constexpr double kLongestPour_s = 60;

Repeat run_fill(const Model& model, const FillProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

}  // namespace repose::dem
