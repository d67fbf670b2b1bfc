#include "cli/track/track_table.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "calibrate/statistics/summary.h"
#include "cli/common/table.h"
#include "vision/measure/repose_angle.h"

namespace repose::cli {
namespace {

std::string cell(const vision::Estimate& estimate, int decimals) {
  // Values smaller than usual still need a significant digit.
  while (decimals < 6 && std::abs(estimate.value) < 5 * std::pow(10, -decimals)) ++decimals;
  return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, decimals, estimate.uncertainty, decimals);
}

std::string scale_text(const vision::DropTrack& drop) {
  if (!drop.gravity_m_s2) {
    return fmt::format(
        "heights by gravity and {:.4g} frames per second, {:.4g} mm per pixel: there is no scale",
        drop.film.frames_per_s, drop.mm_per_px.value_or(0));
  }
  return fmt::format("heights by the {}, which makes gravity {:.2f} ± {:.2f} m/s²",
                     drop.board.empty() ? "scale" : "board", drop.gravity_m_s2->value,
                     drop.gravity_m_s2->uncertainty);
}

/// Why there is no number, and notes.
void add_notes(Table& table, const TrackedFilm& film) {
  if (film.error.empty() && status_of(film) == vision::MeasureStatus::refused) {
    table.add_note(fmt::format("{}refused: ", kNoteIndent), reason_of(film));
  }
  for (const vision::Warning& warning : warnings_of(film)) {
    table.add_note(fmt::format("{}! ", kNoteIndent), warning.message);
  }
}

std::string status_text(const TrackedFilm& film) {
  return film.error.empty() ? name_of(status_of(film)) : "not read";
}

void add_drop(Table& table, const TrackedFilm& film, bool has_colour) {
  const vision::DropTrack& drop = film.drop;
  const Colour colour = has_colour ? colour_of(status_of(film)) : Colour::none;
  const std::string status = status_text(film);
  if (drop.bounces.empty()) {
    table.add_row({film.file, kMissing, kMissing, kMissing, kMissing, kMissing, status}, colour);
  }
  bool is_first = true;
  const auto add_row = [&](int number, const std::string& time, const std::string& restitution,
                           const std::string& drop_mm, const std::string& rebound_mm) {
    table.add_row({is_first ? film.file : "", fmt::format("{}", number), time, restitution, drop_mm,
                   rebound_mm, is_first ? status : ""},
                  is_first ? colour : Colour::none);
    is_first = false;
  };
  auto unread = drop.unread_bounces.begin();
  const auto add_unread = [&](int before) {
    for (; unread != drop.unread_bounces.end() && unread->number < before; ++unread) {
      add_row(unread->number, unread->time_s ? fmt::format("{:.3f}", *unread->time_s) : kMissing,
              kMissing, kMissing, kMissing);
    }
  };
  for (const vision::Bounce& bounce : drop.bounces) {
    add_unread(bounce.number);
    add_row(bounce.number, fmt::format("{:.3f}", bounce.time_s), cell(bounce.restitution, 3),
            cell(bounce.drop_mm, 1), cell(bounce.rebound_mm, 1));
  }
  add_unread(std::numeric_limits<int>::max());
  if (!drop.bounces.empty()) table.add_note(kNoteIndent, scale_text(drop));
  add_notes(table, film);
}

void add_roll(Table& table, const TrackedFilm& film, bool has_colour) {
  const vision::RollTrack& roll = film.roll;
  const Colour colour = has_colour ? colour_of(status_of(film)) : Colour::none;
  const std::string status = status_text(film);
  if (roll.has_reading) {
    table.add_row({film.file, cell(roll.incline_deg, 1), cell(roll.released_mm, 1),
                   cell(roll.stopped_mm, 1), fmt::format("{:.2f}", roll.stopped_s), status},
                  colour);
  } else {
    table.add_row({film.file, kMissing, kMissing, kMissing, kMissing, status}, colour);
  }
  add_notes(table, film);
}

void add_tilt(Table& table, const TrackedFilm& film, bool has_colour) {
  const vision::TiltTrack& tilt = film.tilt;
  const Colour colour = has_colour ? colour_of(status_of(film)) : Colour::none;
  const std::string status = status_text(film);
  if (tilt.has_reading) {
    table.add_row({film.file, cell(tilt.angle_deg, 2), cell(tilt.rate_deg_s, 3),
                   fmt::format("{:.2f}", tilt.onset_s), status},
                  colour);
  } else {
    table.add_row({film.file, kMissing, kMissing, kMissing, status}, colour);
  }
  add_notes(table, film);
}

void add_film(Table& table, const TrackedFilm& film, bool has_colour) {
  switch (film.filmed) {
    case vision::Filmed::drop:
      return add_drop(table, film, has_colour);
    case vision::Filmed::roll:
      return add_roll(table, film, has_colour);
    case vision::Filmed::tilt:
      return add_tilt(table, film, has_colour);
  }
}

/// The value averaged over several films.
double value_of(const TrackedFilm& film) {
  switch (film.filmed) {
    case vision::Filmed::drop:
      return film.drop.bounces.front().restitution.value;
    case vision::Filmed::roll:
      return film.roll.stopped_mm.value;
    case vision::Filmed::tilt:
      break;
  }
  return film.tilt.angle_deg.value;
}

std::string mean_text(const std::vector<TrackedFilm>& films, vision::Filmed filmed) {
  std::vector<double> values;
  for (const TrackedFilm& film : films) {
    if (film.copy_of.empty() && has_reading(film) &&
        (filmed != vision::Filmed::drop || film.drop.has_first_bounce())) {
      values.push_back(value_of(film));
    }
  }
  if (values.size() < 2) return {};
  const calibrate::Summary summary = calibrate::summarise(values);
  const auto text = [&](const char* of, int decimals, const char* unit) {
    return fmt::format("mean of {0} {1}: {2:.{5}f} ± {3:.{5}f}{6}, standard deviation {4:.{5}f}{6}",
                       summary.n, of, summary.mean, summary.mean_uncertainty.value_or(0),
                       summary.sd.value_or(0), decimals, unit);
  };
  if (filmed == vision::Filmed::tilt) return text("tilts", 2, "°");
  return filmed == vision::Filmed::drop ? text("first bounces", 3, "") : text("rolls", 1, " mm");
}

Table empty_table(vision::Filmed filmed) {
  if (filmed == vision::Filmed::drop) {
    return Table({{.heading = "film"},
                  number_column("bounce"),
                  number_column("time [s]"),
                  {.heading = "restitution"},
                  {.heading = "drop [mm]"},
                  {.heading = "rebound [mm]"},
                  {.heading = "status"}});
  }
  if (filmed == vision::Filmed::tilt) {
    return Table({{.heading = "film"},
                  {.heading = "slides at [°]"},
                  {.heading = "rate [°/s]"},
                  number_column("after [s]"),
                  {.heading = "status"}});
  }
  return Table({{.heading = "film"},
                {.heading = "incline [°]"},
                {.heading = "released [mm]"},
                {.heading = "stopped [mm]"},
                number_column("after [s]"),
                {.heading = "status"}});
}

}  // namespace

std::string track_table(const std::vector<TrackedFilm>& films, vision::Filmed filmed, int columns,
                        bool has_colour) {
  Table table = empty_table(filmed);
  for (const TrackedFilm& film : films) add_film(table, film, has_colour);
  Page page(columns);
  page.add(table);
  const std::string mean = mean_text(films, filmed);
  if (!mean.empty()) page.add(mean);
  return page.text();
}

}  // namespace repose::cli
