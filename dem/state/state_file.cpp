#include "dem/state/state_file.h"

#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/atomic_file.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "dem/state/checkpoint_arrays.h"
#include "dem/state/setup_arrays.h"
#include "dem/state/vtk_file.h"

namespace repose::dem {

namespace {

namespace fs = std::filesystem;

/// Incremented when older programs can no longer read the arrays.
constexpr std::int64_t kStateFormat = 1;
constexpr const char* kFix = "give a .vtp file that repose wrote, unchanged.";

void check_format(const ArrayReader& fields) {
  const std::int64_t format = fields.integers("repose_state_format", 1).take();
  if (format != kStateFormat) {
    throw base::InputError({.value = fmt::format("its format is {}, this program reads format {}",
                                                 format, kStateFormat)});
  }
}

/// A comment after the document, with the fingerprint of everything before it.
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
  fields.numbers("TimeValue", 1, {simulation.time_s()});  // the name that VTK recognises
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

namespace {

namespace fs = std::filesystem;

std::string frame_name(std::size_t number) { return fmt::format("frame_{:05}.vtp", number); }

}  // namespace

TrajectoryWriter::TrajectoryWriter(fs::path folder, double interval_s, std::string provenance_json,
                                   Film film)
    : folder_(std::move(folder)),
      interval_s_(interval_s),
      provenance_json_(std::move(provenance_json)),
      film_(std::move(film)) {
  if (!(interval_s > 0) || !std::isfinite(interval_s)) {
    throw base::InputError({.value = fmt::format("time between two frames = {:g} s", interval_s),
                            .rule = "above 0",
                            .fix = "for example 0.1."});
  }
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    base::refuse(folder_, fmt::format("the folder cannot be created ({})", error.message()),
                 "choose a writable place.");
  }
}

void TrajectoryWriter::add(const Simulation& simulation) {
  const double now_s = simulation.time_s();
  if (now_s < film_.last_s) film_.start_s += film_.last_s + interval_s_;
  film_.last_s = now_s;
  write_state(folder_ / frame_name(film_.times_s.size() + 1), simulation, provenance_json_);
  film_.times_s.push_back(film_.start_s + now_s);
  write_collection();
}

void TrajectoryWriter::write_collection() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t k = 0; k < film_.times_s.size(); ++k) {
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", film_.times_s[k],
                        frame_name(k + 1));
  }
  base::write_whole_file(folder_ / "trajectory.pvd", text + "</Collection>\n</VTKFile>\n");
}

std::vector<TrajectoryFrame> read_trajectory(const fs::path& file) {
  const std::string text = base::read_whole_file(file);
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(text.data(), text.size());
  std::vector<TrajectoryFrame> frames;
  for (const pugi::xml_node& frame : document.child("VTKFile").child("Collection").children()) {
    const std::string name = frame.attribute("file").as_string();
    if (name.empty()) continue;
    frames.push_back(
        {.time_s = frame.attribute("timestep").as_double(), .file = file.parent_path() / name});
  }
  if (frames.empty()) {
    throw base::InputError(
        {.where = file.string(),
         .value =
             fmt::format("no film of states ({})", parsed ? "it names none" : parsed.description()),
         .fix = "name the trajectory.pvd of a run that was simulated with one."});
  }
  return frames;
}

}  // namespace repose::dem
