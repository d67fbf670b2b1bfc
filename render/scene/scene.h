#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "dem/engine/simulation.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/state/state_file.h"
#include "dem/vector.h"
#include "dem/wall/wall.h"

/// What there is to see. Metres, z upwards.
namespace repose::render {

/// A grain where it lies.
struct PlacedGrain {
  int shape = 0;                               ///< which of the scene's shapes
  int number = 0;                              ///< in the simulation; its looks follow from it
  dem::Pose pose;                              ///< of the centre of mass
  dem::Vector velocity = dem::Vector::Zero();  ///< of the centre of mass, m/s
};

/// A wall where it stands.
struct PlacedWall {
  dem::WallShape shape;
  dem::Pose pose;
};

/// An upright plane, which has no end and would hide all that is behind it: it is taken for glass,
/// as before and behind the boxes of a bench, and not drawn.
bool is_pane(const PlacedWall& wall);

/// What stays as it is while grains move: a film's camera, lamps, table and backdrop.
struct Setting {
  Eigen::AlignedBox3d extent;  ///< what cameras fit into the picture and lamps light
  double floor_m = 0;          ///< top of the table
};

struct Scene {
  std::vector<dem::ClumpShape> shapes;
  std::vector<PlacedGrain> grains;
  std::vector<PlacedWall> walls;
  std::optional<Setting> setting = {};  ///< without it all follows from the grains
};

/// The grains and walls that are present, at the time of the state.
Scene scene_of(const dem::SavedState& state);
Scene scene_of(const dem::Simulation& simulation);

/// How far a shape reaches from its centre of mass, spheres and surface, m.
double reach_m(const dem::ClumpShape& shape);

/// The same for each of a scene's shapes.
std::vector<double> reaches_of(const Scene& scene);

}  // namespace repose::render
