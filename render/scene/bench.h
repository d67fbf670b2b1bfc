#pragma once

#include <optional>
#include <vector>

#include "render/scene/scene.h"

namespace repose::render {

/// The apparatus of a run as the camera sees it from beginning to end.
///
/// Infinite level and tilting planes become plates that cover the grains' paths; one that turns
/// reaches to its hinge, the origin of its frame. Boards much wider than the paths become as narrow
/// as those of a bench. Nothing that a grain touches changes.
class Bench {
 public:
  /// @param moments  from the whole run, including the first and the last; at least one
  explicit Bench(const std::vector<Scene>& moments);

  /// A moment of the run on this bench, with the setting common to all.
  Scene set(Scene moment) const;

  const Setting& setting() const { return setting_; }

 private:
  /// A wall cut to size, in the original wall's frame.
  struct Plate {
    dem::Vector middle = dem::Vector::Zero();
    dem::Vector half_size = dem::Vector::Zero();
  };

  std::optional<Plate> plate_of(const std::vector<Scene>& moments, std::size_t wall) const;
  PlacedWall cut(const PlacedWall& wall, std::size_t number) const;
  void set_floor(const std::vector<Scene>& moments);

  std::vector<std::optional<Plate>> plates_;  ///< for each wall; std::nullopt: unchanged
  std::vector<bool> turns_;                   ///< whether each wall rotates
  Setting setting_;
};

}  // namespace repose::render
