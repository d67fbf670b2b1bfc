#pragma once

#include <cstdint>
#include <vector>

#include "dem/engine/bodies.h"
#include "dem/engine/contact_force.h"
#include "dem/engine/near_spheres.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// Two neighbouring grains, and their range in the list of near spheres. a < b.
struct NeighbourPair {
  int a = 0;
  int b = 0;
  int first = 0;
  int count = 0;
};

/// A grain near a wall.
struct NearWall {
  int body = 0;
  int wall = 0;
  int first = 0;
  int count = 0;
};

/// A sphere near a facet of a wall.
struct NearFacet {
  int sphere = 0;
  int facet = 0;
};

/// All that may touch soon, in the fixed order in which forces are summed: by grain, then by
/// sphere. Results do not depend on when the list was made: what does not touch adds nothing.
struct NeighbourList {
  std::vector<NeighbourPair> grains;
  std::vector<NearSpheres> spheres;
  std::vector<ContactHistory> memories;  ///< one per entry of `spheres`
  std::vector<std::uint8_t>
      has_touched;  ///< whether each of `spheres` touched at the last step, 1 or 0
  std::vector<TouchingChunk> touching;  ///< one per kPairsTogether `grains`
  std::vector<int>
      body_start;  ///< one more entry than bodies: where each one's part of body_pairs starts
  std::vector<int> body_pairs;  ///< indices of a body's `grains`, ascending; like `body_start`
                                ///< only kept for several threads
  std::vector<NearWall> walls;
  std::vector<NearFacet> facets;
  std::vector<ContactHistory> wall_memories;  ///< one per entry of `facets`
};

/// Keeps a NeighbourList up to date. Once any grain has used up its margin, its neighbours and
/// those of grains that soon will have are listed again.
class Neighbours {
 public:
  const NeighbourList& list() const { return list_; }
  NeighbourList& list() { return list_; }

  /// Everything must be listed again before the next step.
  void expire() { is_expired_ = true; }

  /// What touching pairs share is looked up again before the next step, as it depends on the time
  /// step.
  void look_up_again();

  /// A removed grain or wall touches nothing any more. Expires the list.
  void forget_grain(int grain);
  void forget_wall(int wall);

  /// The contacts that touched at the last step, in order.
  std::vector<ContactState> touching(const Bodies& bodies) const;
  /// Restores saved contact histories in a fresh list. Throws base::InputError if a contact is
  /// between spheres that are not near each other.
  void restore(const Bodies& bodies, const std::vector<ContactState>& contacts);

  /// Updates the list if due. The result does not depend on the number of threads.
  void update(const Bodies& bodies, const WallSet& walls, double time_s, double timestep_s,
              int threads);

 private:
  /// What one thread has found for some of the bodies, or of the pairs.
  struct Found {
    std::vector<int> near;
    std::vector<NeighbourPair> pairs;
    std::vector<NearSpheres> spheres;
  };

  void renew_margins(const Bodies& bodies, double timestep_s, int threads);
  void set_wall_margin(const Bodies& bodies, const WallSet& walls, double time_s,
                       double timestep_s);
  void find_pairs(const Bodies& bodies, int threads);
  void add_pairs(const Bodies& bodies, std::size_t body, Found& found) const;
  void find_spheres(const Bodies& bodies, int threads);
  void list_grains();
  void list_walls(const Bodies& bodies, const WallSet& walls);
  void note_touching();
  void index_by_body(std::size_t bodies);

  NeighbourList list_;
  NeighbourList next_;
  bool is_expired_ = true;
  double due_s_ = 0;  ///< everything is listed again then: a wall will have used up its margin
  double wall_margin_ = 0;
  Margins margins_;
  std::vector<std::uint8_t> has_moved_;  ///< whether each body is listed again now, 1 or 0
  CellGrid grid_;
  SphereColumns columns_;
  std::vector<int> near_;
  std::vector<Found> found_;          ///< one per chunk
  std::vector<NeighbourPair> pairs_;  ///< of bodies that have moved; their spheres are in found_
};

}  // namespace repose::dem
