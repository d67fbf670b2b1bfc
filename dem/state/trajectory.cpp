#include "dem/state/trajectory.h"

#include <cmath>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "dem/state/atomic_file.h"
#include "dem/state/state_file.h"

namespace repose::dem {
namespace {

namespace fs = std::filesystem;

/// Times are sums of steps: a frame may be early by this share of the interval.
constexpr double kRounding = 1e-6;

std::string frame_name(std::size_t number) { return fmt::format("frame_{:05}.vtp", number); }

}  // namespace

TrajectoryWriter::TrajectoryWriter(fs::path folder, double interval_s, std::string provenance_json)
    : folder_(std::move(folder)),
      interval_s_(interval_s),
      provenance_json_(std::move(provenance_json)) {
  if (!(interval_s > 0) || !std::isfinite(interval_s)) {
    throw std::invalid_argument(fmt::format(
        "time between two frames = {:g} s. Rule: above 0. Fix: for example 0.1.", interval_s));
  }
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) {
    throw std::invalid_argument(
        fmt::format("{}: the folder cannot be made ({}). Fix: choose a place you may write to.",
                    folder_.string(), error.message()));
  }
}

void TrajectoryWriter::offer(const Simulation& simulation) {
  const double now_s = simulation.time_s();
  if (now_s < last_s_) start_s_ += last_s_ + interval_s_;
  last_s_ = now_s;
  const double film_s = start_s_ + now_s;
  const bool is_due = times_s_.empty() || film_s - times_s_.back() >= interval_s_ * (1 - kRounding);
  if (!is_due) return;
  write_state(folder_ / frame_name(times_s_.size() + 1), simulation, provenance_json_);
  times_s_.push_back(film_s);
  write_collection();
}

void TrajectoryWriter::write_collection() const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t k = 0; k < times_s_.size(); ++k) {
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", times_s_[k],
                        frame_name(k + 1));
  }
  write_atomically(folder_ / "trajectory.pvd", text + "</Collection>\n</VTKFile>\n");
}

}  // namespace repose::dem
