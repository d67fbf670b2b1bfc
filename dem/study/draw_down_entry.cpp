#include "dem/study/entries.h"

namespace repose::dem {
namespace {

std::vector<ProtocolKey> keys_of_draw_down(Protocol& protocol) {
  auto& draw_down = std::get<DrawDownProtocol>(protocol);
  return {length_key("length_mm", "500", draw_down.length_m),
          length_key("depth_mm", "150", draw_down.depth_m),
          length_key("slot_mm", "120", draw_down.slot_m),
          length_key("fill_mm", "150", draw_down.fill_m),
          length_key("drop_mm", "250", draw_down.drop_m)};
}

double cost_of_draw_down_s(const Model& model, const Protocol& protocol) {
  // Filling, flow and coming to rest.
  constexpr double kPacked = .6, kSimulated_s = 4, kFallSpeed_m_s = 2;
  const auto& draw_down = std::get<DrawDownProtocol>(protocol);
  const double box_m3 = draw_down.length_m * draw_down.depth_m * draw_down.fill_m;
  const double grains = kPacked * box_m3 / model.grain.volume_m3;
  return bulk_step_s(model) * grains * kSimulated_s / bulk_timestep_s(model, kFallSpeed_m_s);
}

}  // namespace

ExperimentEntry draw_down_entry() {
  return {.experiment = Experiment::draw_down,
          .name = "draw_down",
          .unit = "%",
          .value_name = "discharged mass",
          .description =
              "Grains in a box run out through a slot in its floor, into another box below it. "
              "What runs out is weighed, as a percentage of the fill.",
          .readings = {{"upper_angle_deg", "deg", true},
                       {"lower_angle_deg", "deg", true},
                       {"filled_g", "g", true},
                       {"discharged_g", "g", true},
                       {"time_s", "s", true},
                       {"rate_g_s", "g/s"},
                       {"grains", ""},
                       {"grains_out", ""},
                       {"at_rest", ""}},
          .coefficients = {kWallRestitution, kWallSliding, kWallRolling, kGrainRestitution,
                           kGrainSliding, kGrainRolling},
          .parts = {WallPart::pane},
          .sheet = {.test = "draw_down", .value = "discharged_percent", .protocol = {}},
          .is_bulk = true,
          .is_default = false,
          .usual_model_error = .03,
          .usual = DrawDownProtocol{},
          .keys = keys_of_draw_down,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_draw_down(model, std::get<DrawDownProtocol>(protocol), seed, report,
                                     record);
              },
          .possible = [](const Model& /*model*/,
                         const Protocol& /*protocol*/) { return from_to(0, 100); },
          .cost_s = cost_of_draw_down_s};
}

}  // namespace repose::dem
