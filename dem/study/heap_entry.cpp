#include <algorithm>
#include <numbers>

#include "dem/experiment/model_setup.h"
#include "dem/study/entries.h"

namespace repose::dem {
namespace {

std::vector<ProtocolKey> keys_of_heap(Protocol& protocol) {
  auto& heap = std::get<HeapProtocol>(protocol);
  ProtocolKey distance =
      length_key("camera_distance_mm", "1500", heap.camera_distance_m, "far away");
  ProtocolKey height = length_key("camera_height_mm", "40", heap.camera_height_m);
  height.needs = "camera_distance_mm";
  distance.is_of_pictures = height.is_of_pictures = true;
  return {length_key("tube_diameter_mm", "100", heap.tube_diameter_m),
          length_key("tube_height_mm", "400", heap.tube_height_m),
          length_key("tube_thickness_mm", "2", heap.tube_thickness_m),
          length_key("lift_speed_mm_s", "30", heap.lift_speed_m_s),
          length_key("plate_mm", "400", heap.plate_m),
          length_key("plate_thickness_mm", "2", heap.plate_thickness_m),
          count_key("grains", "455", kMaxGrains, heap.grains, "as many as fit"),
          distance,
          height};
}

double grains_in(const HeapProtocol& heap, const ClumpShape& grain) {
  constexpr double kPacked = .6;
  const double radius = heap.tube_diameter_m / 2;
  const double tube_m3 = std::numbers::pi * radius * radius * heap.tube_height_m;
  const double full = kPacked * tube_m3 / grain.volume_m3;
  return heap.grains ? std::min<double>(*heap.grains, full) : full;
}

double cost_of_heap_s(const Model& model, const Protocol& protocol) {
  // Once the tube is a diameter up, what is left in it falls out.
  constexpr double kFillAndSettle_s = 1.5, kSpeed_m_s = .5;
  const auto& heap = std::get<HeapProtocol>(protocol);
  const double simulated_s = heap.tube_diameter_m / heap.lift_speed_m_s + kFillAndSettle_s;
  return bulk_step_s(model) * grains_in(heap, model.grain) * simulated_s /
         bulk_timestep_s(model, kSpeed_m_s);
}

}  // namespace

ExperimentEntry heap_entry() {
  return {.experiment = Experiment::heap,
          .name = "heap",
          .unit = "deg",
          .value_name = "angle of repose",
          .description =
              "A tube full of grains stands on the plate and is lifted slowly. A heap stays.",
          .readings = {{"base_radius_mm", "mm", true},
                       {"height_mm", "mm", true},
                       {"grains_off_plate", "", true},
                       {"grains", ""},
                       {"grains_on_plate", ""},
                       {"between_views_deg", "deg"},
                       {"angle_xz_deg", "deg"},
                       {"inner_window_deg", "deg"},
                       {"no_heap", ""},
                       {"at_rest", ""},
                       {"time_s", "s"}},
          .coefficients = {kWallRestitution, kWallSliding, kWallRolling, kGrainRestitution,
                           kGrainSliding, kGrainRolling},
          .parts = {WallPart::tube},
          .sheet = {.test = "heap", .value = "angle_deg"},
          .is_bulk = true,
          .is_pictured = true,
          .is_filmed = true,
          .usual_model_error = .03,
          .usual = HeapProtocol{},
          .keys = keys_of_heap,
          .run =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const ProgressReport& report, const RunRecord& record) {
                return run_heap(model, std::get<HeapProtocol>(protocol), seed, report, record);
              },
          .resume =
              [](const Model& model, const Protocol& protocol, std::uint64_t seed,
                 const HeapRestart& from, const ProgressReport& report, const RunRecord& record) {
                return resume_heap(model, std::get<HeapProtocol>(protocol), seed, from, report,
                                   record);
              },
          .possible = [](const Model& /*model*/,
                         const Protocol& /*protocol*/) { return from_to(-90, 90); },
          .cost_s = cost_of_heap_s};
}

}  // namespace repose::dem
