#include "calibrate/experiment/run_spec.h"

#include <utility>

#include "base/fingerprint.h"
#include "calibrate/experiment/model_fields.h"
#include "calibrate/experiment/simulator_version.h"
#include "dem/contact/model_names.h"

namespace repose::calibrate {
namespace {

Json protocol_json(dem::Protocol protocol) {
  Json json = Json::object();
  for (const dem::ProtocolKey& key : with_effect(dem::entry_of(protocol).keys(protocol))) {
    if (key.is_of_pictures) continue;
    const auto value = dem::value_of(key);
    json[key.name] = value ? Json(*value) : Json(nullptr);
  }
  return json;
}

}  // namespace

NamedGrain::NamedGrain(dem::ClumpFile file)
    : fingerprint(base::fingerprint({dem::clump_json(file)})) {
  shape = std::move(file.shape);
}

RunSpec spec_of(const dem::Study& study, dem::Experiment experiment, const NamedGrain& grain,
                int views) {
  RunSpec spec{.protocol = study.experiments.at(experiment).protocol,
               .model = dem::model_for(study, experiment),
               .grain_fingerprint = grain.fingerprint,
               .grain_size = grain.size,
               .viewing = {.views = experiment->is_pictured ? views : 0, .camera = {}},
               .definition = study.experiments.at(experiment).definition};
  spec.model.grain = grain.shape;
  if (experiment->camera != nullptr) spec.viewing.camera = experiment->camera(spec.protocol);
  return spec;
}

std::string description_of(const RunSpec& spec, std::uint64_t seed) {
  const dem::Model& model = spec.model;
  Json json{{"experiment", spec.entry().name},
            {"protocol", protocol_json(spec.protocol)},
            {"grain", spec.grain_fingerprint},
            {"particle", json_of_fields(model.grain_material)},
            {"wall", json_of_fields(model.wall_material)},
            {"particle_wall", json_of_fields(model.grain_wall)}};
  if (spec.grain_size != 1) json["grain_size"] = spec.grain_size;
  if (dem::has_grain_contacts(&spec.entry())) {
    json["particle_particle"] = json_of_fields(model.grain_grain);
  }
  for (const auto& [part, surface] : model.parts) {
    json[name_of(part)] = json_of_fields(surface.material);
    json["particle_" + name_of(part)] = json_of_fields(surface.with_grain);
  }
  if (model.size_cv > 0) json["size_sd_fraction"] = model.size_cv;
  json["rolling_model"] = dem::name_of(model.rolling);
  if (model.damping != dem::DampingModel::per_contact) {
    json["damping"] = dem::name_of(model.damping);
  }
  json["stiffness_factor"] = model.stiffness_factor;
  json["timestep_fraction"] = model.timestep_fraction;
  json["timestep_s"] = model.timestep_s ? Json(*model.timestep_s) : Json(nullptr);
  if (const std::string engine = spec.simulator->identity(spec); !engine.empty()) {
    json["engine"] = Json::parse(engine);
  }
  json["seed"] = seed;
  json["simulator_version"] = kSimulatorVersion;
  return json.dump();
}

std::string key_of(const RunSpec& spec, std::uint64_t seed) {
  return std::string(spec.entry().name) + '-' + base::fingerprint({description_of(spec, seed)});
}

}  // namespace repose::calibrate
