#pragma once

#include "calibrate/experiment/json_fields.h"
#include "calibrate/result/result.h"

/// Names of provenance fields in result.json: what a result was made from, and with what.
namespace repose::calibrate {

template <typename Io>
void fields(Io& io, Held<Io, StudyIdentity>& study) {
  io("program", study.program);
  io.object("study", [&](Io& inner) {
    inner("file", study.file);
    inner("hash", study.hash);
    inner("settings", study.settings);
  });
  if (!io.has("budget", !study.budget.empty())) return;  // nothing was simulated
  io.object("budget", [&](Io& inner) {
    inner("name", study.budget);
    inner("description", study.budget_description);
    if (inner.has("mixed", study.is_mixed.has_value())) inner("mixed", study.is_mixed);
  });
}

template <typename Io>
void fields(Io& io, Held<Io, ClumpFacts>& clump) {
  io("source", clump.source);
  io("spheres", clump.spheres);
  io("volume_error", clump.volume_error);
  io("inertia_error", clump.inertia_error);
  if (io.has("size_sd_percent", clump.size_sd_percent.has_value())) {
    io("size_sd_percent", clump.size_sd_percent);
  }
}

template <typename Io>
void fields(Io& io, Held<Io, HeapDefinition>& definition) {
  io("name", definition.name);
  io("is_assumed", definition.is_assumed);
  io("simulated_deg", definition.simulated_deg);
}

template <typename Io>
void fields(Io& io, Held<Io, SimulatorFacts>& simulator) {
  io("name", simulator.name);
  io("differences", simulator.differences);
}

template <typename Io>
void fields(Io& io, Held<Io, ModelFacts>& model) {
  io("first_seed", model.first_seed);
  io("contact_model", model.contact_model);
  io("rolling_model", model.rolling_model);
  io("rolling_definition", model.rolling_definition);
  if (io.has("damping", true)) {
    io("damping", model.damping);
    io("damping_definition", model.damping_definition);
  }
  io("clump", model.clump);
  io("stiffness_factor", model.stiffness_factor);
  io("shortest_timestep_s", model.shortest_timestep_s);
  if (io.has("heap_definition", model.heap_definition.has_value())) {
    io("heap_definition", model.heap_definition);
  }
  if (io.has("engine", model.simulator.has_value())) io("engine", model.simulator);
}

template <typename Io>
void fields(Io& io, Held<Io, EngineFacts>& engine) {
  io("command", engine.command);
  io("runs", engine.runs);
  io("failed", engine.failed);
  io("ended_by", engine.ended_by);
  if (io.has("check_runs", true)) {
    io("check_runs", engine.check_runs);
    io("check_failed", engine.check_failed);
  }
}

template <typename Io>
void fields(Io& io, Held<Io, TableFacts>& table) {
  io("files", table.files);
  io("rows", table.rows);
  io("failed", table.failed);
  io("without_reading", table.without_reading);
  io("left_out", table.left_out);
  if (io.has("engine", table.engine.has_value())) io("engine", table.engine);
}

template <typename Io>
void fields(Io& io, Held<Io, Provenance>& provenance) {
  fields(io, provenance.study);
  if (io.has("table", provenance.table.has_value())) {
    io("table", provenance.table);
  } else {
    if constexpr (Io::kReads) provenance.model.emplace();
    fields(io, *provenance.model);
  }
  if (io.has("assumed", !provenance.assumed.empty())) io("assumed", provenance.assumed);
}

}  // namespace repose::calibrate
