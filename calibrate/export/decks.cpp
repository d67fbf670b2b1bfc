#include "calibrate/export/decks.h"

#include <variant>

#include "dem/study/experiment_table.h"

namespace repose::calibrate {

bool has_decks(ExportTarget target, const dem::Protocol& protocol) {
  const bool is_edem = target == ExportTarget::edem;
  const bool is_liggghts = target == ExportTarget::liggghts;
  switch (dem::entry_of(protocol).experiment) {
    case dem::Experiment::drop:
    case dem::Experiment::tilt:
    case dem::Experiment::roll:
      return true;
    case dem::Experiment::heap:
      return target != ExportTarget::lammps;
    case dem::Experiment::fill: {
      const auto& fill = std::get<dem::FillProtocol>(protocol);
      return is_edem || (is_liggghts && !fill.taps && !fill.pour_kg_s);
    }
    case dem::Experiment::pendulum:
    case dem::Experiment::drop_on_grains:
    case dem::Experiment::tilt_on_grains:
    case dem::Experiment::roll_on_grains:
    case dem::Experiment::draw_down:
      break;
  }
  return is_liggghts || is_edem;
}

std::string names_with_decks(ExportTarget target) {
  std::string names;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    if (!has_decks(target, entry.usual)) continue;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return names;
}

}  // namespace repose::calibrate
