#include "dem/state/trajectory.h"

#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/input_error.h"
#include "base/whole_file.h"
#include "dem/state/state_file.h"

namespace repose::dem {
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
