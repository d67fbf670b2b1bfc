#include "dem/state/state_file.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "base/whole_file.h"
#include "dem/state/checkpoint_arrays.h"
#include "dem/state/setup_arrays.h"
#include "dem/state/vtk_file.h"

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

/// Counts up when older programs cannot read the arrays any more.
constexpr std::int64_t kFormat = 1;
constexpr const char* kFix = "give a .vtp file that repose wrote, unchanged.";

void check_format(const ArrayReader& fields) {
  const std::int64_t format = fields.integers("repose_state_format", 1).take();
  if (format != kFormat) {
    throw std::invalid_argument(
        fmt::format("its format is {}, this program reads format {}", format, kFormat));
  }
}

}  // namespace

std::string state_text(const Simulation& simulation, const std::string& provenance_json) {
  VtkPoints points;
  ArrayWriter fields;
  fields.integers("repose_state_format", 1, {kFormat});
  fields.texts("provenance", {provenance_json});
  fields.numbers("TimeValue", 1, {simulation.time_s()});  // the name that VTK knows
  add_setup(fields, simulation.setup());
  add_checkpoint(simulation.checkpoint(), simulation, points, fields);
  points.field_arrays = fields.take();
  return vtk_text(points);
}

void write_state(const fs::path& file, const Simulation& simulation,
                 const std::string& provenance_json) {
  base::write_whole_file(file, state_text(simulation, provenance_json));
}

SavedState read_state(const fs::path& file) {
  const VtkPoints points = parse_vtk(file.string(), base::read_whole_file(file));
  try {
    const ArrayReader fields(points.field_arrays);
    check_format(fields);
    SimulationSetup setup = setup_in(fields);
    Checkpoint checkpoint = checkpoint_in(points, setup);
    const auto& provenance = fields.texts("provenance");
    return {.setup = std::move(setup),
            .checkpoint = std::move(checkpoint),
            .provenance_json = provenance.empty() ? "" : provenance.front()};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: no state that repose can go on from: {}. Fix: {}",
                                            file.string(), error.what(), kFix));
  }
}

}  // namespace repose::dem
