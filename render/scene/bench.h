#pragma once

#include <optional>
#include <vector>

#include "render/scene/scene.h"

namespace repose::render {

/// What a run is done on, as it stands before a camera from its beginning to its end.
///
/// Level and tilting planes without end become plates as long as the grains' way on them, which for
/// a plate that turns reaches to its hinge, the origin of its frame; boards much wider than the
/// way become as narrow as a bench's. Nothing that a grain touches changes.
class Bench {
 public:
  /// @param moments  from all over the run, the first and the last among them; at least one
  explicit Bench(const std::vector<Scene>& moments);

  /// A moment of the run on this bench, with the setting of all.
  Scene set(Scene moment) const;

  const Setting& setting() const { return setting_; }

 private:
  /// A wall cut to size, in the frame of the wall that it is cut from.
  struct Plate {
    dem::Vector middle = dem::Vector::Zero();
    dem::Vector half_size = dem::Vector::Zero();
  };

  std::optional<Plate> plate_of(const std::vector<Scene>& moments, std::size_t wall) const;
  PlacedWall cut(const PlacedWall& wall, std::size_t number) const;
  void set_floor(const std::vector<Scene>& moments);

  std::vector<std::optional<Plate>> plates_;  ///< for each wall; none: it stays as it is
  std::vector<bool> turns_;                   ///< each wall
  Setting setting_;
};

}  // namespace repose::render
