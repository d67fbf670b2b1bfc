#include "cli/track/track_table.h"

#include <cmath>

#include <fmt/format.h>

#include "calibrate/statistics/summary.h"
#include "cli/common/page.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

constexpr const char* kBelow = "  ";

std::string cell(const vision::Estimate& estimate, int decimals) {
  return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, decimals, estimate.uncertainty, decimals);
}

Colour colour_of(const TrackedFilm& film, bool has_colour) {
  if (!has_colour) return Colour::none;
  switch (film.drop.status) {
    case vision::MeasureStatus::ok:
      return Colour::green;
    case vision::MeasureStatus::flagged:
      return Colour::yellow;
    case vision::MeasureStatus::refused:
      break;
  }
  return Colour::red;
}

std::string scale_text(const vision::DropTrack& drop) {
  if (!drop.gravity_m_s2) {
    return fmt::format(
        "heights by gravity and {:.4g} frames per second, {:.4g} mm per pixel: there is no --scale",
        drop.film.frames_per_s, drop.mm_per_px.value_or(0));
  }
  return fmt::format("heights by the scale, which makes gravity {:.2f} ± {:.2f} m/s²",
                     drop.gravity_m_s2->value, drop.gravity_m_s2->uncertainty);
}

void add_film(Table& table, const TrackedFilm& film, bool has_colour) {
  const vision::DropTrack& drop = film.drop;
  const Colour colour = colour_of(film, has_colour);
  const std::string status = film.error.empty() ? name_of(drop.status) : "not read";
  if (drop.bounces.empty()) {
    table.add_row({film.file, kNothing, kNothing, kNothing, kNothing, kNothing, status}, colour);
  }
  for (std::size_t k = 0; k < drop.bounces.size(); ++k) {
    const vision::Bounce& bounce = drop.bounces[k];
    table.add_row({k == 0 ? film.file : "", fmt::format("{}", k + 1),
                   fmt::format("{:.3f}", bounce.time_s), cell(bounce.restitution, 3),
                   cell(bounce.drop_mm, 1), cell(bounce.rebound_mm, 1), k == 0 ? status : ""},
                  k == 0 ? colour : Colour::none);
  }
  if (!drop.bounces.empty()) table.add_note(kBelow, scale_text(drop));
  if (film.error.empty() && drop.status == vision::MeasureStatus::refused) {
    table.add_note(fmt::format("{}refused: ", kBelow), drop.reason);
  }
  for (const vision::Warning& warning : drop.warnings) {
    table.add_note(fmt::format("{}! ", kBelow), warning.message);
  }
}

std::string mean_text(const std::vector<TrackedFilm>& films) {
  std::vector<double> values;
  for (const TrackedFilm& film : films) {
    if (!film.drop.bounces.empty()) values.push_back(film.drop.bounces.front().restitution.value);
  }
  if (values.size() < 2) return {};
  const calibrate::Summary summary = calibrate::summarise(values);
  return fmt::format("mean of {} first bounces: {:.3f} ± {:.3f}, standard deviation {:.3f}",
                     summary.n, summary.mean, summary.mean_uncertainty.value_or(0),
                     summary.sd.value_or(0));
}

}  // namespace

std::string track_table(const std::vector<TrackedFilm>& films, int columns, bool has_colour) {
  Table table({{.heading = "film"},
               number_column("bounce"),
               number_column("time [s]"),
               {.heading = "restitution"},
               {.heading = "drop [mm]"},
               {.heading = "rebound [mm]"},
               {.heading = "status"}});
  for (const TrackedFilm& film : films) add_film(table, film, has_colour);
  Page page(columns);
  page.add(table);
  const std::string mean = mean_text(films);
  if (!mean.empty()) page.add(mean);
  return page.text();
}

}  // namespace repose::cli
