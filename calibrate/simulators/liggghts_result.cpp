#include "calibrate/simulators/liggghts_result.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/simulators/liggghts_readings.h"
#include "calibrate/simulators/program_simulator.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/fill.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/pendulum.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/experiment/tilt_on_grains.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

double number_in(const PrintedLines& printed, const char* name, const fs::path& folder) {
  const auto found = printed.readings.find(name);
  if (found != printed.readings.end()) return found->second;
  base::refuse(folder / ProgramSimulator::kOutputFile,
               fmt::format("LIGGGHTS ended without the line \"reading: {}\"", name),
               "look there for what it says.");
}

int grains_of(double spheres, const ExportFacts& facts) {
  return static_cast<int>(spheres / static_cast<double>(facts.grain().spheres.size()));
}

/// A mean over single grains, and its other readings.
dem::Repeat drops_in(const fs::path& folder, const std::string& name, int grains) {
  double sum = 0, squares = 0, above = 0;
  int never_rose = 0;
  std::vector<double> rises;
  for (int k = 1; k <= grains; ++k) {
    const auto bounce = bounce_in(folder / fmt::format("{}_{}.txt", name, k));
    never_rose += bounce ? 0 : 1;
    rises.push_back(bounce ? kMmPerM * bounce->rise_m : 0);
    sum += rises.back();
    above += bounce ? kMmPerM * bounce->above_first_touch_m : 0;
  }
  const double mean = sum / grains;
  for (const double rise : rises) squares += (rise - mean) * (rise - mean);
  dem::Repeat repeat;
  repeat.value = mean;
  repeat.readings = {{"above_first_touch_mm", above / grains},
                     {"sd_mm", dem::scatter_of(squares, rises.size())},
                     {"never_rose", never_rose}};
  return repeat;
}

dem::Repeat tilt_in(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  const auto& protocol = facts.study().protocol<dem::TiltProtocol>();
  const double tips_deg = dem::tipping_deg(facts.tilt_body(), dem::lying_pose(facts.grain()));
  if (tips_deg < std::atan(facts.study().model.grain_wall.sliding_friction) / kDegree) {
    throw dem::NoMeasurement(
        fmt::format("tilt: the body tips at {:.2f} degrees instead of sliding. Fix: bond more "
                    "grains, or lower the sliding friction.",
                    tips_deg));
  }
  dem::Slide slide;
  for (const auto& [angle, slip] : printed.slips) slide.add(angle, slip, facts.grain());
  if (!printed.slips.empty() && printed.slips.back().second < dem::most_slip_m(facts.grain())) {
    throw dem::NoMeasurement(
        fmt::format("tilt: the body did not slide up to {:g} degrees", dem::kSteepest_deg));
  }
  dem::Repeat repeat;
  const double begin = facts.tilt_begin_deg();
  repeat.value = dem::onset_deg(slide, begin, protocol.rate_deg_s);
  repeat.readings = {{"half_mm_slip_deg", number_in(printed, "half_mm_slip_deg", folder)},
                     {"begin_deg", begin}};
  return repeat;
}

dem::Repeat roll_in(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  const double moved_m = number_in(printed, "still_moved_m", folder);
  const double reached_mm = number_in(printed, "roll_mm", folder);
  if (moved_m > 1e-3 * facts.grain().reach_m()) {
    throw dem::NoMeasurement(fmt::format(
        "roll: the grain still moves {:.2f} m from the foot, by {:.2g} mm in a tenth of "
        "a second. Fix: more rolling friction between particle and wall, which is {:g}.",
        reached_mm / kMmPerM, kMmPerM * moved_m, facts.study().model.grain_wall.rolling_friction));
  }
  dem::Repeat repeat;
  repeat.value = std::max(0., reached_mm);
  repeat.readings = {{"lateral_mm", number_in(printed, "lateral_mm", folder)},
                     {"stopped_on_incline", reached_mm > 0 ? 0 : 1},
                     {"releases", number_in(printed, "releases", folder)},
                     {"time_s", number_in(printed, "steps", folder) *
                                    facts.timestep_s(dem::experiment_of<dem::RollProtocol>())}};
  return repeat;
}

/// Advice if grains passed through walls or each other.
std::string stiffer_text(const ExportFacts& facts) {
  return fmt::format("stiffer grains (young_modulus_pa is {:g}, stiffness_factor {:g})",
                     facts.study().model.grain_material.young_modulus_pa,
                     facts.study().model.stiffness_factor);
}

/// All requested grains must be in the tube before it is lifted.
int filled_grains(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  const int asked = grains_in_heap(facts);
  const int put_in = static_cast<int>(number_in(printed, "inserted_grains", folder));
  const int filled = grains_of(number_in(printed, "filled_spheres", folder), facts);
  if (filled < put_in) {
    throw dem::NoMeasurement(fmt::format(
        "heap: {} of {} grains were lost while the tube was filled: they went through the plate or "
        "the tube's wall. Fix: {}.",
        put_in - filled, put_in, stiffer_text(facts)));
  }
  if (put_in != asked) {
    throw dem::NoMeasurement(fmt::format(
        "heap: LIGGGHTS put {} of {} grains into the tube. Fix: processes = 1, or grains = {}.",
        put_in, asked, put_in));
  }
  const double rim_m = facts.study().protocol<dem::HeapProtocol>().tube_height_m;
  const double top_m = number_in(printed, "filled_m", folder);
  // A grain protruding at the top is harmless: the tube passes it when lifted.
  if (top_m > rim_m + 2 * facts.grain().reach_m()) {
    throw dem::NoMeasurement(fmt::format(
        "heap: {} grains fill the tube to {:.3g} mm, over its rim at {:.3g} mm, from where they "
        "would fall. Fix: fewer grains, or a taller tube.",
        filled, kMmPerM * top_m, kMmPerM * rim_m));
  }
  return filled;
}

/// Grains missing at the end must have fallen off the plate's edge.
void check_lifted(const PrintedLines& printed, const ExportFacts& facts, int filled,
                  const fs::path& folder) {
  if (printed.remark == kAllOffPlate) {
    throw dem::NoMeasurement(fmt::format(
        "heap: all {} grains left the plate. Fix: a larger plate, or more friction.", filled));
  }
  if (!printed.remark.empty()) {
    throw dem::NoMeasurement("heap: grains hang in the tube. Fix: a wider tube, or less friction.");
  }
  const double under = number_in(printed, "spheres_under_plate", folder);
  if (under > 0) {
    throw dem::NoMeasurement(fmt::format("heap: {} grains or more went through the plate. Fix: {}.",
                                         std::max(1, grains_of(under, facts)),
                                         stiffer_text(facts)));
  }
}

dem::Repeat heap_in(const PrintedLines& printed, const RunSpec& spec, std::uint64_t seed,
                    const ExportFacts& facts, const fs::path& folder) {
  const auto& protocol = spec.protocol.as<dem::HeapProtocol>();
  const int filled = filled_grains(printed, facts, folder);
  check_lifted(printed, facts, filled, folder);
  const bool are_balls = facts.is_sphere();
  const fs::path dump = folder / (are_balls ? "heap.dump" : "heap_bodies.dump");
  dem::StandingHeap heap{.grains = grains_in(dump, are_balls), .lifted = filled};
  if (static_cast<int>(heap.grains.size()) > filled) {
    base::refuse(dump, fmt::format("has {} grains of {}", heap.grains.size(), filled),
                 "run it again.");
  }
  // Removes grains that are falling off the plate.
  std::erase_if(heap.grains, [](const dem::Grain& grain) { return grain.position.z() < 0; });
  heap.is_at_rest = number_in(printed, "moved_m", folder) <= 1e-3 * facts.grain().reach_m();
  dem::Repeat repeat = dem::heap_from(spec.model, protocol, seed, heap);
  repeat.readings["time_s"] = number_in(printed, "steps", folder) *
                              facts.timestep_s(dem::experiment_of<dem::HeapProtocol>());
  return repeat;
}

dem::Repeat fill_in(const PrintedLines& printed, const ExportFacts& facts, const fs::path& folder) {
  if (!printed.remark.empty()) {
    throw dem::NoMeasurement("fill: the grains do not reach the tube's rim. Fix: a lower tube.");
  }
  const int poured = static_cast<int>(number_in(printed, "poured_grains", folder));
  const int there = grains_of(number_in(printed, "poured_spheres", folder), facts);
  if (there < poured) {
    throw dem::NoMeasurement(
        fmt::format("fill: {} of {} grains were lost: they went through the tube. Fix: {}.",
                    poured - there, poured, stiffer_text(facts)));
  }
  const auto& protocol = facts.study().protocol<dem::FillProtocol>();
  const double radius = .5 * protocol.tube_diameter_m;
  const double tube_m3 = std::numbers::pi * radius * radius * protocol.tube_height_m;
  const double grains = number_in(printed, "grains", folder);
  dem::Repeat repeat;
  repeat.value = number_in(printed, "bulk_density_kg_m3", folder);
  repeat.readings = {{"grains", grains},
                     {"mass_g", 1e3 * grains * facts.mass_kg()},
                     {"solid_fraction", grains * facts.grain().volume_m3 / tube_m3}};
  return repeat;
}

/// For bodies on glued grains: the angle is the mean over their places.
dem::Repeat places_in(const PrintedLines& printed, const fs::path& folder) {
  dem::Repeat repeat;
  repeat.value = number_in(printed, "angle_deg", folder);
  double squares = 0;
  for (const double place : printed.places) squares += std::pow(place - *repeat.value, 2);
  repeat.readings = {{"sd_deg", dem::scatter_of(squares, printed.places.size())}};
  return repeat;
}

}  // namespace

dem::Repeat liggghts_result(const RunSpec& spec, const ExportFacts& facts, std::uint64_t seed,
                            const fs::path& folder) {
  const PrintedLines printed = printed_lines(folder / ProgramSimulator::kOutputFile);
  const dem::Protocol& protocol = spec.protocol;
  const std::string name = dem::name_of(&spec.entry());
  dem::Repeat repeat;
  if (is_one_of<dem::DropProtocol>(protocol)) {
    repeat = drops_in(folder, name, protocol.as<dem::DropProtocol>().grains);
  } else if (is_one_of<dem::GrainDropProtocol>(protocol)) {
    repeat = drops_in(folder, name, protocol.as<dem::GrainDropProtocol>().grains);
  } else if (is_one_of<dem::TiltProtocol>(protocol)) {
    repeat = tilt_in(printed, facts, folder);
  } else if (is_one_of<dem::RollProtocol>(protocol)) {
    repeat = roll_in(printed, facts, folder);
  } else if (is_one_of<dem::HeapProtocol>(protocol)) {
    repeat = heap_in(printed, spec, seed, facts, folder);
  } else if (is_one_of<dem::FillProtocol>(protocol)) {
    repeat = fill_in(printed, facts, folder);
  } else if (is_one_of<dem::PendulumProtocol>(protocol)) {
    repeat.value = number_in(printed, "swing_deg", folder);
    repeat.readings = {{"rise_mm", number_in(printed, "rise_mm", folder)}};
  } else {
    repeat = places_in(printed, folder);
  }
  repeat.timestep_s = facts.timestep_s(&spec.entry());
  repeat.steps = printed.steps;
  repeat.clump_steps =
      static_cast<double>(repeat.steps) * repeat.readings.number("grains").value_or(1);
  return repeat;
}

}  // namespace repose::calibrate
