#include <filesystem>

#include <fmt/format.h>

#include "base/csv.h"
#include "cli/track/track_json.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

constexpr const char* kHeader =
    "sample,bounce,drop_mm,rebound_mm,drop_uncertainty_mm,rebound_uncertainty_mm,"
    "restitution,restitution_uncertainty,time_s,status\n";

std::string row_of(const TrackedFilm& film, std::size_t k) {
  const vision::Bounce& bounce = film.drop.bounces[k];
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  const std::vector<std::string> cells = {std::filesystem::path(film.file).stem().string(),
                                          fmt::format("{}", k + 1),
                                          number(bounce.drop_mm.value),
                                          number(bounce.rebound_mm.value),
                                          number(bounce.drop_mm.uncertainty),
                                          number(bounce.rebound_mm.uncertainty),
                                          number(bounce.restitution.value),
                                          number(bounce.restitution.uncertainty),
                                          number(bounce.time_s),
                                          name_of(film.drop.status)};
  return base::csv_row(cells);
}

}  // namespace

std::string track_csv(const std::vector<TrackedFilm>& films, bool tells_all_bounces) {
  std::string csv = kHeader;
  for (const TrackedFilm& film : films) {
    const std::size_t count = tells_all_bounces
                                  ? film.drop.bounces.size()
                                  : std::min<std::size_t>(1, film.drop.bounces.size());
    for (std::size_t k = 0; k < count; ++k) csv += row_of(film, k);
  }
  return csv;
}

}  // namespace repose::cli
