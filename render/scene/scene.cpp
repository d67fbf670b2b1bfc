#include "render/scene/scene.h"

#include <algorithm>
#include <cmath>

namespace repose::render {
namespace {

std::vector<dem::ClumpShape> shapes_of(const std::vector<dem::GrainKind>& kinds) {
  std::vector<dem::ClumpShape> shapes;
  shapes.reserve(kinds.size());
  for (const dem::GrainKind& kind : kinds) shapes.push_back(kind.shape);
  return shapes;
}

PlacedGrain placed(const dem::Grain& grain, int number) {
  return {.shape = grain.kind,
          .number = number,
          .pose = {.position = grain.position, .orientation = grain.orientation},
          .velocity = grain.velocity};
}

std::vector<PlacedWall> placed(const std::vector<dem::Wall>& walls, double time_s) {
  std::vector<PlacedWall> present;
  for (const dem::Wall& wall : walls) {
    if (wall.is_present) present.push_back({wall.shape, dem::wall_at(wall, time_s).pose});
  }
  return present;
}

}  // namespace

bool is_pane(const PlacedWall& wall) {
  constexpr double kUpright = 1e-6;  // sine of the tilt from vertical
  const dem::Vector normal = wall.pose.orientation * dem::Vector::UnitZ();
  return std::holds_alternative<dem::Plane>(wall.shape) && std::abs(normal.z()) < kUpright;
}

Scene scene_of(const dem::SavedState& state) {
  const dem::Checkpoint& checkpoint = state.checkpoint;
  const double time_s = checkpoint.equal_steps.time_s(checkpoint.step, state.setup.timestep_s);
  Scene scene{.shapes = shapes_of(state.setup.kinds),
              .grains = {},
              .walls = placed(state.setup.walls, time_s)};
  for (std::size_t k = 0; k < checkpoint.grains.size(); ++k) {
    if (!checkpoint.is_present[k]) continue;
    scene.grains.push_back(placed(checkpoint.grains[k], static_cast<int>(k)));
  }
  return scene;
}

Scene scene_of(const dem::Simulation& simulation) {
  Scene scene{.shapes = shapes_of(simulation.setup().kinds),
              .grains = {},
              .walls = placed(simulation.setup().walls, simulation.time_s())};
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (simulation.is_present(k)) scene.grains.push_back(placed(simulation.grain(k), k));
  }
  return scene;
}

double reach_m(const dem::ClumpShape& shape) {
  double reach = shape.reach_m();
  for (const dem::Vector& vertex : shape.surface.vertices) reach = std::max(reach, vertex.norm());
  return reach;
}

std::vector<double> reaches_of(const Scene& scene) {
  std::vector<double> reaches_m;
  for (const dem::ClumpShape& shape : scene.shapes) reaches_m.push_back(reach_m(shape));
  return reaches_m;
}

}  // namespace repose::render
