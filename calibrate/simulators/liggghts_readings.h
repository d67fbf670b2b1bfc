#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dem/engine/simulation.h"

/// Output of the decks of calibrate/export/templates/liggghts.
namespace repose::calibrate {

/// What decks print if there is no reading.
inline constexpr const char* kGrainsHang = "The grains hang in the tube.";
inline constexpr const char* kBelowRim = "The grains do not reach the rim.";
inline constexpr const char* kGrainsLost = "Grains were lost.";
inline constexpr const char* kAllOffPlate = "All grains left the plate.";

/// Lines printed by LIGGGHTS.
struct PrintedLines {
  std::map<std::string, double> readings;        ///< "reading: NAME VALUE", the last of each name
  std::vector<std::pair<double, double>> slips;  ///< "slip: DEGREES METRES", in a tilt
  std::vector<double> places;                    ///< "place K: VALUE", for bodies on grains
  std::int64_t steps = 0;                        ///< of all the deck's runs
  std::string remark;                            ///< one of those above; empty: there is a reading
};

/// @throws base::InputError  the file cannot be read.
PrintedLines printed_lines(const std::filesystem::path& file);

/// The bounce of one grain, m.
struct Bounce {
  double rise_m = 0;               ///< from the lowest height to the top of the first flight
  double above_first_touch_m = 0;  ///< from the height at first touch to that top
};

/// From rows of step, height and speed of a centre of mass, starting at first touch: in flight the
/// speed decreases linearly; toppling on the wall does not count as flight. std::nullopt: it never
/// rose.
/// @throws base::InputError  the file cannot be read, or has no such rows.
std::optional<Bounce> bounce_in(const std::filesystem::path& file);

/// The grains of a dump: for clumps rows of centre and quaternion, for balls those of spheres.
/// @throws base::InputError  the file cannot be read, or is truncated.
std::vector<dem::Grain> grains_in(const std::filesystem::path& file, bool are_balls);

}  // namespace repose::calibrate
