#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "dem/engine/simulation.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/state/state_file.h"
#include "dem/vector.h"
#include "dem/wall/wall.h"

/// The contents of a picture. Metres, z upwards.
namespace repose::render {

/// A grain at its place.
struct PlacedGrain {
  int shape = 0;                               ///< which of the scene's shapes
  int number = 0;                              ///< in the simulation; determines its appearance
  dem::Pose pose;                              ///< of the centre of mass
  dem::Vector velocity = dem::Vector::Zero();  ///< of the centre of mass, m/s
};

/// A wall at its place.
struct PlacedWall {
  dem::WallShape shape;
  dem::Pose pose;
};

/// A vertical plane: it is infinite and would hide everything behind it, so it counts as glass,
/// like the panes in front of and behind a bench's boxes, and is not drawn.
bool is_pane(const PlacedWall& wall);

/// What stays the same while grains move; it determines a film's camera, lamps, table and backdrop.
struct Setting {
  Eigen::AlignedBox3d extent;  ///< that cameras fit into the picture and lamps light
  double floor_m = 0;          ///< top of the table
};

struct Scene {
  std::vector<dem::ClumpShape> shapes;
  std::vector<PlacedGrain> grains;
  std::vector<PlacedWall> walls;
  std::optional<Setting> setting = {};  ///< by default derived from the grains
};

/// The grains and walls present at the time of the state.
Scene scene_of(const dem::SavedState& state);
Scene scene_of(const dem::Simulation& simulation);

/// Bounding radius of a shape about its centre of mass, spheres and surface, m.
double reach_m(const dem::ClumpShape& shape);

/// The same for each shape of a scene.
std::vector<double> reaches_of(const Scene& scene);

}  // namespace repose::render
