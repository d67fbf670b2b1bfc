#include "calibrate/start/usual_experiment.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/units.h"
#include "calibrate/start/study_text.h"
#include "calibrate/statistics/bench/sheet.h"

namespace repose::calibrate {
namespace {

constexpr double kRound_mm = 10;

/// Softer heaps move, stiffer ones take long. What is weighed is denser by the overlaps of its
/// grains, which the weight of those above makes: of glass beads by 2 % at 6.5 MPa, while ten and a
/// hundred times stiffer ones do not differ (docs/calibrating.md, "Are the grains stiff enough?").
double softening_for(double young_modulus_pa, dem::Experiment experiment) {
  constexpr double kSoft_pa = 1.25e7, kSoftWeighed_pa = 1.25e8;
  const double soft_pa = experiment == dem::Experiment::fill ? kSoftWeighed_pa : kSoft_pa;
  return std::min(1., std::pow(10, std::round(std::log10(soft_pa / young_modulus_pa))));
}

double longest_mm(const UsualBench& bench) {
  return *std::max_element(bench.grain_mm.begin(), bench.grain_mm.end());
}

void adapt(dem::HeapProtocol& heap, const UsualBench& bench) {
  constexpr double kPlateWidths = 6;  // how far a low heap reaches, and more
  heap.tube_diameter_m = bench.tube_diameter_mm * kMPerMm;
  heap.tube_height_m = bench.tube_height_mm * kMPerMm;
  heap.plate_m = kPlateWidths * heap.tube_diameter_m;
}

/// The own tube, or one that holds a bulk of large grains, too.
void adapt(dem::FillProtocol& fill, const UsualBench& bench) {
  if (bench.has_own_tube) {
    fill.tube_diameter_m = bench.tube_diameter_mm * kMPerMm;
    fill.tube_height_m = bench.tube_height_mm * kMPerMm;
    return;
  }
  constexpr double kLengths = 5;
  const double wide_m = kMPerMm * kRound_mm * std::ceil(kLengths * longest_mm(bench) / kRound_mm);
  fill.tube_diameter_m = std::max(fill.tube_diameter_m, wide_m);
  fill.tube_height_m = std::max(fill.tube_height_m, wide_m);
}

/// Boxes as much larger or smaller as their slot must be for these grains.
void adapt(dem::DrawDownProtocol& boxes, const UsualBench& bench) {
  constexpr double kSlotGrains = 5.2, kStep_m = .005;
  const auto stepped = [](double size_m) { return kStep_m * std::ceil(size_m / kStep_m - 1e-9); };
  const double slot_m = stepped(kSlotGrains * kMPerMm * longest_mm(bench));
  const double factor = slot_m / boxes.slot_m;
  boxes = {.length_m = stepped(factor * boxes.length_m),
           .depth_m = stepped(factor * boxes.depth_m),
           .slot_m = slot_m,
           .fill_m = stepped(factor * boxes.fill_m),
           .drop_m = stepped(factor * boxes.drop_m)};
}

}  // namespace

double usual_tube_diameter_mm(const std::array<double, 3>& grain_mm) {
  constexpr double kGrainsAcross = 6;
  const double diameter_mm = std::cbrt(grain_mm[0] * grain_mm[1] * grain_mm[2]);
  return kRound_mm * std::ceil(kGrainsAcross * diameter_mm / kRound_mm);
}

dem::StudyExperiment usual_experiment(const dem::ExperimentEntry& entry, const UsualBench& bench) {
  dem::StudyExperiment usual{.protocol = entry.usual, .measured = {}};
  if (auto* heap = std::get_if<dem::HeapProtocol>(&usual.protocol)) adapt(*heap, bench);
  if (auto* fill = std::get_if<dem::FillProtocol>(&usual.protocol)) adapt(*fill, bench);
  if (auto* boxes = std::get_if<dem::DrawDownProtocol>(&usual.protocol)) adapt(*boxes, bench);
  if (dem::has_grain_contacts(entry.experiment) && entry.softening_effect.empty()) {
    usual.stiffness_factor = softening_for(bench.young_modulus_pa, entry.experiment);
  }
  return usual;
}

std::string protocol_lines(const dem::ExperimentEntry& entry, dem::Protocol protocol) {
  std::string text = fmt::format("[experiment.{}]\n", entry.name);
  for (const dem::ProtocolKey& key : with_effect(entry.keys(protocol))) {
    if (const auto value = value_of(key)) {
      text += fmt::format("{} = {}\n", key.name, toml_number(*value));
    }
  }
  return text;
}

std::string study_section(const dem::ExperimentEntry& entry,
                          const dem::StudyExperiment& described) {
  std::string text = protocol_lines(entry, described.protocol);
  if (described.stiffness_factor != 1) {
    text += fmt::format("stiffness_factor = {}\n", toml_number(described.stiffness_factor));
  }
  const auto columns = column_names(bench_test_named(entry.sheet.test));
  return text + fmt::format("measured = {{ readings = \"{}.csv\" }}  # columns: {}\n", entry.name,
                            fmt::join(columns, ","));
}

}  // namespace repose::calibrate
