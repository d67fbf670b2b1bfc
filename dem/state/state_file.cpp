#include "dem/state/state_file.h"

#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/whole_file.h"
#include "dem/state/checkpoint_arrays.h"
#include "dem/state/setup_arrays.h"
#include "dem/state/vtk_file.h"

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

/// Counts up when older programs cannot read the arrays any more.
constexpr std::int64_t kStateFormat = 1;
constexpr const char* kFix = "give a .vtp file that repose wrote, unchanged.";

void check_format(const ArrayReader& fields) {
  const std::int64_t format = fields.integers("repose_state_format", 1).take();
  if (format != kStateFormat) {
    throw base::InputError({.value = fmt::format("its format is {}, this program reads format {}",
                                                 format, kStateFormat)});
  }
}

/// A comment behind the document, with the fingerprint of all before it.
constexpr std::string_view kSealBegins = "<!-- fingerprint ", kSealEnds = " -->\n";

std::string seal_of(const std::string& text) {
  return fmt::format("{}{}{}", kSealBegins, base::fingerprint({text}), kSealEnds);
}

enum class Seal { none, whole, broken };

Seal seal_in(const std::string& text) {
  const std::size_t at = text.rfind(kSealBegins);
  if (at == std::string::npos) return Seal::none;
  return text.substr(at) == seal_of(text.substr(0, at)) ? Seal::whole : Seal::broken;
}

}  // namespace

std::string state_text(const Simulation& simulation, const std::string& provenance_json) {
  VtkPoints points;
  ArrayWriter fields;
  fields.integers("repose_state_format", 1, {kStateFormat});
  fields.texts("provenance", {provenance_json});
  fields.numbers("TimeValue", 1, {simulation.time_s()});  // the name that VTK knows
  add_setup(fields, simulation.setup());
  add_checkpoint(simulation.checkpoint(), simulation, points, fields);
  points.field_arrays = fields.take();
  std::string text = vtk_text(points);
  return text + seal_of(text);
}

void write_state(const fs::path& file, const Simulation& simulation,
                 const std::string& provenance_json) {
  base::write_whole_file(file, state_text(simulation, provenance_json));
}

bool is_as_written(const fs::path& file) {
  const auto text = base::read_file_if_there(file);
  return text && seal_in(*text) == Seal::whole;
}

SavedState read_state(const fs::path& file) {
  const std::string text = base::read_whole_file(file);
  if (seal_in(text) == Seal::broken) {
    base::refuse(file, "was changed since repose wrote it", kFix);
  }
  const VtkPoints points = parse_vtk(file.string(), text);
  try {
    const ArrayReader fields(points.field_arrays);
    check_format(fields);
    SimulationSetup setup = setup_in(fields);
    Checkpoint checkpoint = checkpoint_in(points, setup);
    const auto& provenance = fields.texts("provenance");
    return {.setup = std::move(setup),
            .checkpoint = std::move(checkpoint),
            .provenance_json = provenance.empty() ? "" : provenance.front()};
  } catch (const base::InputError& error) {
    base::refuse(file, fmt::format("not a state that repose can resume from: {}", error.what()),
                 kFix);
  }
}

}  // namespace repose::dem
