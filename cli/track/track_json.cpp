#include "cli/track/track_json.h"

#include <nlohmann/json.hpp>

#include "cli/common/degrees.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

Json bounce_json(const vision::Bounce& bounce) {
  return {{"time_s", bounce.time_s},
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

Json path_json(const std::vector<vision::GrainPlace>& places) {
  Json json = Json::array();
  for (const vision::GrainPlace& place : places) {
    json.push_back({place.time_s, place.centre.x, place.centre.y});
  }
  return json;
}

Json warnings_json(const std::vector<vision::Warning>& warnings) {
  Json json = Json::array();
  for (const vision::Warning& warning : warnings) {
    json.push_back({{"code", warning.code}, {"message", warning.message}});
  }
  return json;
}

Json film_json(const vision::FilmFacts& film) {
  return {{"width", film.width},       {"height", film.height},
          {"frames", film.frames},     {"frames_per_s", film.frames_per_s},
          {"length_s", film.length_s}, {"dropped_frames", film.dropped_frames}};
}

/// What is known of the path that has bounces.
Json track_json(const vision::DropTrack& drop) {
  Json gravity = nullptr, gravity_uncertainty = nullptr;
  if (drop.gravity_m_s2) {
    gravity = drop.gravity_m_s2->value;
    gravity_uncertainty = drop.gravity_m_s2->uncertainty;
  }
  return {{"scale", drop.has_scale ? "given" : "gravity"},
          {"mm_per_px", drop.mm_per_px ? Json(*drop.mm_per_px) : Json()},
          {"gravity_m_s2", gravity},
          {"gravity_uncertainty_m_s2", gravity_uncertainty},
          {"lean_deg", rounded_degrees(drop.lean_rad)},
          {"readout_ms", drop.readout_ms},
          {"noise_px", drop.noise_px},
          {"grain_px", drop.grain_px},
          {"path", path_json(drop.places)}};
}

Json json_of(const TrackedFilm& film) {
  const vision::DropTrack& drop = film.drop;
  Json json{{"file", film.file},
            {"experiment", "drop"},
            {"status", name_of(drop.status)},
            {"bounces", bounces_json(drop.bounces)},
            {"track", drop.bounces.empty() ? Json() : track_json(drop)},
            {"film", film.error.empty() ? film_json(drop.film) : Json()},
            {"warnings", warnings_json(drop.warnings)}};
  if (!film.error.empty()) {
    json["reason"] = film.error;
  } else if (drop.status == vision::MeasureStatus::refused) {
    json["reason"] = drop.reason;
  }
  return json;
}

}  // namespace

std::string track_json(const std::vector<TrackedFilm>& films) {
  Json json = Json::array();
  for (const TrackedFilm& film : films) json.push_back(json_of(film));
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
