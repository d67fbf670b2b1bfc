#pragma once

#include <cstdint>
#include <optional>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// A tube filled by pouring and struck level at its rim; between the two it may be tapped.
///
/// The grains fall from a spout at `pour_m` above the rim, at random places over the tube and in
/// random poses, until they heap over the rim and rest. Those whose centres of mass lie above the
/// rim are struck off; all others stay whole. They come as fast as they fall, a layer upon the
/// other, which fills a tube of 150 mm in half a second, or at `pour_kg_s`, one by one: what
/// is poured slowly has time to settle, and comes to lie denser. Value: bulk density, kg/m^3: the
/// mass of those that stay by the tube's volume. Readings: "grains", "mass_g", "solid_fraction",
/// "filling_height_mm" (mean height of the upper surface of what stays, over the tube's whole
/// width).
///
/// To be tapped, the tube has a collar of a third of its height, as Carr (1965, Chemical
/// Engineering 72 (2), 163) has it: it is filled over the collar's rim, dropped `taps` times
/// by `tap_m` onto a base that does not give (filling.h), and struck at its own rim. The value is
/// then the tapped bulk density, and "hausner_ratio" that by the one before the taps (Hausner 1967,
/// International Journal of Powder Metallurgy 3 (4), 7). Throws NoMeasurement when the grains sink
/// below the rim.
struct FillProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .1;
  double pour_m = .05;                   ///< from the spout to the rim, or to the collar's
  std::optional<double> pour_kg_s = {};  ///< none: as fast as grains fall
  std::optional<int> taps = {};          ///< none: it is not tapped
  double tap_m = .003;                   ///< the drop of ISO 3953
};
inline constexpr int kMaxTaps = 10'000;
/// Longer pours would be simulated for too long; up to here most has settled.
inline constexpr double kLongestPour_s = 60;

Repeat run_fill(const Model& model, const FillProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

}  // namespace repose::dem
