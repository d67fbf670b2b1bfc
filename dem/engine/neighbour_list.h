#pragma once

#include <cstdint>
#include <vector>

#include "dem/engine/bodies.h"
#include "dem/engine/contact_force.h"
#include "dem/engine/near_spheres.h"
#include "dem/wall/wall_set.h"

namespace repose::dem {

/// Two grains near each other, and where their near spheres are listed. a < b.
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

/// All that may touch soon, in the one order in which forces are summed: by grain, then by sphere.
/// It does not show in the results when the list was made: what does not touch adds nothing.
struct NeighbourList {
  std::vector<NeighbourPair> grains;
  std::vector<NearSpheres> spheres;
  std::vector<ContactHistory> memories;  ///< one for each of `spheres`
  std::vector<std::uint8_t>
      has_touched;                      ///< whether each of `spheres` did at the last step, 1 or 0
  std::vector<TouchingChunk> touching;  ///< of each kPairsTogether `grains`
  std::vector<int>
      body_start;  ///< one more than bodies: where each one's part of body_pairs starts
  std::vector<int> body_pairs;  ///< numbers of `grains` in which a body takes part, rising; for
                                ///< more threads than one alone, as `body_start`
  std::vector<NearWall> walls;
  std::vector<NearFacet> facets;
  std::vector<ContactHistory> wall_memories;  ///< one for each of `facets`
};

/// Keeps a NeighbourList up to date. Once some grain has used up its margin, what is near it and
/// near those that soon will have is listed anew.
class Neighbours {
 public:
  const NeighbourList& list() const { return list_; }
  NeighbourList& list() { return list_; }

  /// All must be listed anew before the next step.
  void expire() { is_expired_ = true; }

  /// What touching pairs share is looked up again before the next step: it depends on its length.
  void look_up_again();

  /// A grain or a wall that is taken out touches nothing any more. Expires the list.
  void forget_grain(int grain);
  void forget_wall(int wall);

  /// The contacts that touched at the last step, in order.
  std::vector<ContactState> touching(const Bodies& bodies) const;
  /// Gives the contacts of a fresh list the memories that they had. Throws base::InputError
  /// when one of them is of spheres that are not near each other.
  void restore(const Bodies& bodies, const std::vector<ContactState>& contacts);

  /// Brings the list up to date if that is due. It does not depend on the number of threads.
  void update(const Bodies& bodies, const WallSet& walls, double time_s, double timestep_s,
              int threads);

 private:
  /// What one thread has found: of a part of the bodies, or of the pairs.
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
  double due_s_ = 0;  ///< all is listed anew then: a wall will have used up its margin
  double wall_margin_ = 0;
  Margins margins_;
  std::vector<std::uint8_t> has_moved_;  ///< whether each body is listed anew now, 1 or 0
  CellGrid grid_;
  SphereColumns columns_;
  std::vector<int> near_;
  std::vector<Found> found_;          ///< of each part
  std::vector<NeighbourPair> pairs_;  ///< of bodies that have moved; their spheres in found_
};

}  // namespace repose::dem
