#include "calibrate/measured/tracked_film.h"

#include <exception>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/memory.h"
#include "base/text.h"
#include "calibrate/measured/json_text.h"
#include "calibrate/measured/measured_command.h"
#include "vision/drawing/track_overlays.h"
#include "vision/measure/repose_angle.h"

namespace repose::calibrate {

const char* name_of(vision::Filmed filmed) {
  switch (filmed) {
    case vision::Filmed::drop:
      return "drop";
    case vision::Filmed::roll:
      return "roll";
    case vision::Filmed::tilt:
      break;
  }
  return "tilt";
}

namespace {

vision::Picture overlay_of(const TrackedFilm& film) {
  const std::string title = std::filesystem::path(film.file).filename().string();
  switch (film.filmed) {
    case vision::Filmed::drop:
      return vision::draw_drop_overlay(film.drop, title);
    case vision::Filmed::roll:
      return vision::draw_roll_overlay(film.roll, title);
    case vision::Filmed::tilt:
      break;
  }
  return vision::draw_tilt_overlay(film.tilt, title);
}

}  // namespace

TrackedFilm tracked_film(const FilmTracking& tracking) {
  TrackedFilm tracked;
  tracked.file = tracking.film.path.string();
  tracked.filmed = tracking.filmed;
  const vision::ScaleOptions& scale = tracking.scale;
  vision::TrackOptions options{.scale = scale.scale,
                               .released_mm = tracking.released_mm,
                               .draws_strobe = tracking.take_overlay != nullptr,
                               .progress = tracking.progress};
  if (scale.finds_board) {
    options.board = vision::BoardPlacing{scale.square_mm, scale.board_offset_mm};
  }
  try {
    static_cast<vision::FilmTrack&>(tracked) =
        vision::track_film(tracking.filmed, tracking.film, options);
    try {
      if (tracking.take_overlay) tracking.take_overlay(overlay_of(tracked));
    } catch (const base::InputError& error) {
      tracked.overlay_error = error.what();
    }
    drop_strobe(tracked);
  } catch (const base::InputError& error) {
    tracked.error = base::naming_file(tracked.file, error.what());
  } catch (const std::exception& error) {
    tracked.is_internal_error = !base::is_out_of_memory(error);
    tracked.error = tracked.is_internal_error
                        ? base::naming_file(tracked.file, error.what())
                        : base::no_memory(tracked.file, "a smaller film, or fewer --threads");
  }
  return tracked;
}

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
                                          "0",  // fall heights without air
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

std::string track_csv(const std::vector<TrackedFilm>& films, vision::Filmed filmed,
                      BouncesToTell bounces_to_tell) {
  if (filmed != vision::Filmed::drop) {
    const bool rolls = filmed == vision::Filmed::roll;
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
    // A film whose first bounce was not read has none to output.
    const std::size_t first = film.drop.has_first_bounce() ? 1 : 0;
    const std::size_t count = bounces_to_tell == BouncesToTell::all ? bounces : first;
    for (std::size_t k = 0; k < count; ++k) csv += drop_row(film, k);
  }
  return csv;
}

namespace {

using Json = nlohmann::ordered_json;

Json bounce_json(const vision::Bounce& bounce) {
  return {{"number", bounce.number},
          {"time_s", bounce.time_s},
          {"restitution", bounce.restitution.value},
          {"restitution_uncertainty", bounce.restitution.uncertainty},
          {"drop_mm", bounce.drop_mm.value},
          {"drop_uncertainty_mm", bounce.drop_mm.uncertainty},
          {"rebound_mm", bounce.rebound_mm.value},
          {"rebound_uncertainty_mm", bounce.rebound_mm.uncertainty},
          {"place_px", {bounce.place.x, bounce.place.y}},
          {"frames_before", bounce.sightings_before},
          {"frames_after", bounce.sightings_after}};
}

Json bounces_json(const std::vector<vision::Bounce>& bounces) {
  Json json = Json::array();
  for (const vision::Bounce& bounce : bounces) json.push_back(bounce_json(bounce));
  return json;
}

Json unread_bounces_json(const std::vector<vision::UnreadBounce>& bounces) {
  Json json = Json::array();
  for (const vision::UnreadBounce& bounce : bounces) {
    json.push_back(
        {{"number", bounce.number}, {"time_s", bounce.time_s ? Json(*bounce.time_s) : Json()}});
  }
  return json;
}

Json path_json(const std::vector<vision::GrainPlace>& places) {
  Json json = Json::array();
  for (const vision::GrainPlace& place : places) {
    json.push_back({place.time_s, place.centre.x, place.centre.y});
  }
  return json;
}

Json board_json(const std::vector<vision::Point>& board) {
  return board.empty() ? Json() : places_json(board);
}

/// The source of millimetres.
template <typename Track>
const char* scale_json(const Track& track, const char* otherwise) {
  if (!track.has_scale) return otherwise;
  return track.board.empty() ? "given" : "board";
}

/// Everything known about a path with bounces.
Json drop_track_json(const vision::DropTrack& drop) {
  Json gravity = nullptr, gravity_uncertainty = nullptr;
  if (drop.gravity_m_s2) {
    gravity = drop.gravity_m_s2->value;
    gravity_uncertainty = drop.gravity_m_s2->uncertainty;
  }
  return {{"scale", scale_json(drop, "gravity")},
          {"board_px", board_json(drop.board)},
          {"mm_per_px", drop.mm_per_px ? Json(*drop.mm_per_px) : Json()},
          {"gravity_m_s2", gravity},
          {"gravity_uncertainty_m_s2", gravity_uncertainty},
          {"lean_deg", rounded_degrees(drop.roll_rad)},
          {"readout_ms", drop.readout_ms},
          {"noise_px", drop.noise_px},
          {"grain_px", drop.grain_px},
          {"path", path_json(drop.places)}};
}

Json roll_json(const vision::RollTrack& roll) {
  return {{"stopped_mm", roll.stopped_mm.value},
          {"stopped_uncertainty_mm", roll.stopped_mm.uncertainty},
          {"released_mm", roll.released_mm.value},
          {"released_uncertainty_mm", roll.released_mm.uncertainty},
          {"incline_deg", roll.incline_deg.value},
          {"incline_uncertainty_deg", roll.incline_deg.uncertainty},
          {"stopped_s", roll.stopped_s},
          {"foot_px", {roll.foot.x, roll.foot.y}},
          {"released_px", {roll.released.x, roll.released.y}},
          {"stopped_px", {roll.stopped.x, roll.stopped.y}}};
}

Json roll_track_json(const vision::RollTrack& roll) {
  return {{"scale", scale_json(roll, "released")},
          {"board_px", board_json(roll.board)},
          {"mm_per_px", roll.mm_per_px},
          {"noise_px", roll.noise_px},
          {"grain_px", roll.grain_px},
          {"path", path_json(roll.places)}};
}

Json tilt_json(const vision::TiltTrack& tilt) {
  return {{"angle_deg", tilt.angle_deg.value},
          {"angle_uncertainty_deg", tilt.angle_deg.uncertainty},
          {"rate_deg_s", tilt.rate_deg_s.value},
          {"rate_uncertainty_deg_s", tilt.rate_deg_s.uncertainty},
          {"onset_s", tilt.onset_s},
          {"begin_deg", tilt.begin_deg},
          {"turned_deg", tilt.turned_deg},
          {"onset_px", {tilt.onset.x, tilt.onset.y}}};
}

Json tilt_track_json(const vision::TiltTrack& tilt) {
  Json plate = Json::array();
  for (const vision::PlateAngle& one : tilt.plate) plate.push_back({one.time_s, one.angle_deg});
  return {{"noise_deg", tilt.noise_deg},
          {"noise_px", tilt.noise_px},
          {"grain_px", tilt.grain_px},
          {"plate", plate},
          {"path", path_json(tilt.places)}};
}

/// Fields specific to one experiment's films.
void add_readings(const TrackedFilm& film, Json& json) {
  const bool has_track = has_reading(film);
  if (film.filmed == vision::Filmed::drop) {
    json["bounces"] = bounces_json(film.drop.bounces);
    json["unread_bounces"] = unread_bounces_json(film.drop.unread_bounces);
    json["track"] = has_track ? drop_track_json(film.drop) : Json();
  } else if (film.filmed == vision::Filmed::roll) {
    json["roll"] = has_track ? roll_json(film.roll) : Json();
    json["track"] = has_track ? roll_track_json(film.roll) : Json();
  } else {
    json["tilt"] = has_track ? tilt_json(film.tilt) : Json();
    json["track"] = has_track ? tilt_track_json(film.tilt) : Json();
  }
}

}  // namespace

Json tracked_json(const TrackedFilm& film) {
  Json json{{"file", film.file},
            {"experiment", name_of(film.filmed)},
            {"status", name_of(status_of(film))}};
  add_readings(film, json);
  json["copy_of"] = film.copy_of.empty() ? Json() : Json(film.copy_of);
  json["film"] = film.error.empty() ? film_json(facts_of(film)) : Json();
  json["warnings"] = warnings_json(warnings_of(film));
  if (!film.error.empty()) {
    json["reason"] = film.error;
  } else if (status_of(film) == vision::MeasureStatus::refused) {
    json["reason"] = reason_of(film);
  }
  return json;
}

std::string track_json(const std::vector<TrackedFilm>& films) {
  return json_text(films, tracked_json);
}

std::string track_command(const FilmTracking& tracking) {
  std::string command = fmt::format("repose track {} {}", name_of(tracking.filmed),
                                    base::shell_word(tracking.film.path.string()));
  command += scale_options(tracking.scale);
  if (tracking.released_mm) command += fmt::format(" --released {:g}", *tracking.released_mm);
  return command;
}

}  // namespace repose::calibrate
