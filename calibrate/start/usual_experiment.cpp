#include "calibrate/start/usual_experiment.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "calibrate/start/study_text.h"
#include "calibrate/statistics/bench/sheet.h"

namespace repose::calibrate {
namespace {

constexpr double kRound_mm = 10;

double softening_for(double young_modulus_pa, double soft_pa) {
  return std::min(1., std::pow(10, std::round(std::log10(soft_pa / young_modulus_pa))));
}

}  // namespace

double usual_tube_diameter_mm(const std::array<double, 3>& grain_mm) {
  constexpr double kGrainsAcross = 6;
  const double diameter_mm = std::cbrt(grain_mm[0] * grain_mm[1] * grain_mm[2]);
  return kRound_mm * std::ceil(kGrainsAcross * diameter_mm / kRound_mm);
}

dem::StudyExperiment usual_experiment(const dem::ExperimentEntry& entry,
                                      const dem::UsualBench& bench) {
  dem::StudyExperiment usual{.protocol = entry.usual, .measured = {}};
  if (entry.adapt != nullptr) entry.adapt(usual.protocol, bench);
  if (dem::has_grain_contacts(&entry) && entry.softening_effect.empty()) {
    usual.stiffness_factor = softening_for(bench.young_modulus_pa, entry.soft_pa);
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
