#include "cli/render/render_json.h"

#include <numbers>
#include <optional>

#include <nlohmann/json.hpp>

#include "base/units.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

Json vector_mm(const dem::Vector& vector_m) {
  return {kMmPerM * vector_m.x(), kMmPerM * vector_m.y(), kMmPerM * vector_m.z()};
}

Json camera_json(const render::Camera& camera) {
  if (const auto* level = std::get_if<render::OrthographicCamera>(&camera)) {
    return {{"kind", "orthographic"}, {"azimuth_deg", level->azimuth_rad * kDegreesPerRadian}};
  }
  const auto& lens = std::get<render::PerspectiveCamera>(camera);
  return {{"kind", "perspective"},
          {"position_mm", vector_mm(lens.position_m)},
          {"azimuth_deg", lens.azimuth_rad * kDegreesPerRadian},
          {"pitch_deg", lens.pitch_rad * kDegreesPerRadian},
          {"roll_deg", lens.roll_rad * kDegreesPerRadian},
          {"focal_mm", lens.focal_mm},
          {"k1", lens.k1},
          {"k2", lens.k2}};
}

Json ends(const std::optional<vision::Segment>& line) {
  if (!line) return nullptr;
  return {line->from.x, line->from.y, line->to.x, line->to.y};
}

}  // namespace

std::string truth_json(const render::Truth& truth) {
  Json outline = Json::array();
  for (const vision::Point& point : truth.outline) outline.push_back({point.x, point.y});
  const Json json{{"width_px", truth.size.width},        {"height_px", truth.size.height},
                  {"camera", camera_json(truth.camera)}, {"mm_per_px", truth.mm_per_px},
                  {"ground_px", ends(truth.ground)},     {"outline_px", outline}};
  return json.dump() + '\n';
}

std::string film_truth_json(const render::FilmTruth& truth) {
  Json frames = Json::array();
  for (const render::FilmTruth::Frame& frame : truth.frames) {
    Json places_mm = Json::array(), places_px = Json::array();
    for (const render::GrainPlace& grain : frame.grains) {
      places_mm.push_back(vector_mm(grain.position_m));
      places_px.push_back({grain.picture.x, grain.picture.y});
    }
    frames.push_back({{"time_s", frame.run_s}, {"grains_mm", places_mm}, {"grains_px", places_px}});
  }
  const vision::Segment& scale = truth.scale;
  const Json json{{"width_px", truth.size.width},
                  {"height_px", truth.size.height},
                  {"camera", camera_json(truth.camera)},
                  {"frames_per_s", truth.frames_per_s},
                  {"exposure_ms", kMsPerS * truth.exposure_s},
                  {"mm_per_px", truth.mm_per_px},
                  {"scale", {scale.from.x, scale.from.y, scale.to.x, scale.to.y, truth.scale_mm}},
                  {"frames", frames}};
  return json.dump() + '\n';
}

}  // namespace repose::cli
