#include <filesystem>

#include <fmt/format.h>

#include "base/csv.h"
#include "cli/track/track_json.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

constexpr const char* kDropHeader =
    "sample,bounce,drop_mm,rebound_mm,in_air,drop_uncertainty_mm,rebound_uncertainty_mm,"
    "restitution,restitution_uncertainty,time_s,status\n";

constexpr const char* kRollHeader =
    "sample,incline_deg,released_mm,stopped_mm,incline_uncertainty_deg,released_uncertainty_mm,"
    "stopped_uncertainty_mm,stopped_s,status\n";

constexpr const char* kTiltHeader =
    "sample,angle_deg,angle_uncertainty_deg,rate_deg_s,rate_uncertainty_deg_s,onset_s,status\n";

std::string number(double value) { return fmt::format("{:.6g}", value); }

std::string sample_of(const TrackedFilm& film) {
  return std::filesystem::path(film.file).stem().string();
}

std::string drop_row(const TrackedFilm& film, std::size_t k) {
  const vision::Bounce& bounce = film.drop.bounces[k];
  const std::vector<std::string> cells = {sample_of(film),
                                          fmt::format("{}", bounce.number),
                                          number(bounce.drop_mm.value),
                                          number(bounce.rebound_mm.value),
                                          "0",  // heights of falls without air
                                          number(bounce.drop_mm.uncertainty),
                                          number(bounce.rebound_mm.uncertainty),
                                          number(bounce.restitution.value),
                                          number(bounce.restitution.uncertainty),
                                          number(bounce.time_s),
                                          name_of(film.drop.status)};
  return base::csv_row(cells);
}

std::string roll_row(const TrackedFilm& film) {
  const vision::RollTrack& roll = film.roll;
  const std::vector<std::string> cells = {sample_of(film),
                                          number(roll.incline_deg.value),
                                          number(roll.released_mm.value),
                                          number(roll.stopped_mm.value),
                                          number(roll.incline_deg.uncertainty),
                                          number(roll.released_mm.uncertainty),
                                          number(roll.stopped_mm.uncertainty),
                                          number(roll.stopped_s),
                                          name_of(roll.status)};
  return base::csv_row(cells);
}

std::string tilt_row(const TrackedFilm& film) {
  const vision::TiltTrack& tilt = film.tilt;
  const std::vector<std::string> cells = {sample_of(film),
                                          number(tilt.angle_deg.value),
                                          number(tilt.angle_deg.uncertainty),
                                          number(tilt.rate_deg_s.value),
                                          number(tilt.rate_deg_s.uncertainty),
                                          number(tilt.onset_s),
                                          name_of(tilt.status)};
  return base::csv_row(cells);
}

}  // namespace

std::string track_csv(const std::vector<TrackedFilm>& films, const TrackPlan& plan) {
  if (plan.filmed != Filmed::drop) {
    const bool rolls = plan.filmed == Filmed::roll;
    std::string csv = rolls ? kRollHeader : kTiltHeader;
    for (const TrackedFilm& film : films) {
      if (film.copy_of.empty() && has_reading(film)) csv += rolls ? roll_row(film) : tilt_row(film);
    }
    return csv;
  }
  std::string csv = kDropHeader;
  for (const TrackedFilm& film : films) {
    if (!film.copy_of.empty()) continue;
    const std::size_t bounces = film.drop.bounces.size();
    // Of a film whose first bounce was not read there is none to give.
    const std::size_t first = film.drop.has_first_bounce() ? 1 : 0;
    const std::size_t count = plan.tells_all_bounces ? bounces : first;
    for (std::size_t k = 0; k < count; ++k) csv += drop_row(film, k);
  }
  return csv;
}

}  // namespace repose::cli
