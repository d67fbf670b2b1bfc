#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "render/gl/objects.h"
#include "render/scene/scene.h"
#include "render/scene/style.h"
#include "render/scene/surface.h"
#include "render/scene/view.h"

namespace repose::render {

/// Grains of one shape, or a wall, ready to be drawn in one call.
struct Batch {
  enum class Kind { grains, spheres, wall };
  Kind kind = Kind::grains;
  std::shared_ptr<const gl::Shape> shape;
  std::shared_ptr<const Surface> surface = {};  ///< that a grain's shape was made from
  std::vector<float> instances = {};            ///< kInstanceFloats each
  bool is_closed = true;                        ///< its back faces are never visible
  /// Axis of the shell's pattern: points to the blunt end; its length is the shape's reach, m.
  dem::Vector blunt_end = dem::Vector::UnitX();
};

/// Vertex: position, normal. Instance: three rows of the matrix to the stage; the grain's own four
/// random numbers, 0 to 1.
inline const std::vector<int> kVertexParts = {3, 3};
inline const std::vector<int> kInstanceParts = {4, 4, 4, 4};
inline constexpr std::size_t kInstanceFloats = 16;
inline const std::vector<const char*> kAttributes = {"position", "normal", "row_x",
                                                     "row_y",    "row_z",  "chance"};

/// A scene in the driver's memory. Positions are relative to `origin`, where floats are precise.
struct Stage {
  dem::Vector origin = dem::Vector::Zero();
  double radius_m = 0;  ///< of a ball about the origin that holds all grains
  std::vector<Batch> grains = {};
  std::vector<Batch> walls = {};
};

/// Uploads scenes, and caches surfaces for reuse.
class SceneUploader {
 public:
  explicit SceneUploader(const gl::Functions& gl) : gl_(gl) {}

  /// Grains are as detailed as the view can show.
  Stage set(const Scene& scene, const View& view, Shown shown, std::uint64_t seed);

 private:
  /// Hash of the shape; whether spheres or mesh; step of the tolerance.
  using Key = std::tuple<std::uint64_t, bool, int>;
  struct GrainShape {
    std::shared_ptr<const gl::Shape> shape;
    std::shared_ptr<const Surface> surface;
  };

  GrainShape grain_shape(const dem::ClumpShape& shape, bool as_spheres, double tolerance_m);

  const gl::Functions& gl_;
  std::map<Key, GrainShape> saved_;
};

}  // namespace repose::render
