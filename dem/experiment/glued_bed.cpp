#include "dem/experiment/glued_bed.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "dem/experiment/experiment.h"
#include "dem/experiment/model_setup.h"
#include "dem/wall/facets.h"

namespace repose::dem {
namespace {

constexpr int kGrains = 100;
constexpr int kMaxTries = 20;
constexpr int kSpreadings = 600;
/// While spreading, the grains are enlarged as if they had this coverage, which leaves no holes.
constexpr double kSpreadCoverage = .88;
/// Maximum overlap of glued grains, as a fraction of their thickness.
constexpr double kMaxOverlap = .1;
/// Places per grain thickness at which holes are looked for.
constexpr int kPlacesPerGrain = 8;

/// A grain on the board.
struct Glued {
  Vector place = Vector::Zero();
  std::vector<FixedSphere> spheres;  ///< relative to its place
};

double width_along(const ClumpShape& grain, const Quaternion& pose, const Vector& direction) {
  return reach_towards(grain, pose, direction) + reach_towards(grain, pose, -direction);
}

/// Area of the board that a grain hides.
double hidden_m2(const ClumpShape& grain) {
  const Quaternion lying = lying_pose(grain);
  return std::numbers::pi / 4 * width_along(grain, lying, Vector::UnitX()) *
         width_along(grain, lying, Vector::UnitY());
}

class Spreading {
 public:
  Spreading(const ClumpShape& grain, double coverage, Random& random)
      : tile_(std::sqrt(kGrains * hidden_m2(grain) / coverage)),
        growth_(std::max(1.0, std::sqrt(kSpreadCoverage / coverage))),
        reach_(grain.reach_m()) {
    for (int k = 0; k < kGrains; ++k) {
      const double x = random.between(0, tile_);
      const double y = random.between(0, tile_);
      glue(grain, {x, y, 0}, random.between(0, 2 * std::numbers::pi));
    }
    for (int k = 0; k < kSpreadings; ++k) spread();
  }

  /// Deepest overlap of any two grains at their true size.
  double deepest_m() const {
    double deepest = 0;
    for (std::size_t a = 0; a < glued_.size(); ++a) {
      for (std::size_t b = a + 1; b < glued_.size(); ++b) {
        deepest = std::max(deepest, overlap(glued_[a], glued_[b], apart(a, b), 1));
      }
    }
    return deepest;
  }

  SphereBed bed() const {
    SphereBed bed{.spheres = {}, .tile = tile_};
    for (const Glued& grain : glued_) {
      for (const FixedSphere& sphere : grain.spheres) {
        bed.spheres.push_back({.centre = grain.place + sphere.centre, .radius = sphere.radius});
      }
    }
    return bed;
  }

 private:
  void glue(const ClumpShape& grain, const Vector& place, double turn) {
    const Quaternion pose =
        Quaternion(Eigen::AngleAxisd(turn, Vector::UnitZ())) * lying_pose(grain);
    Glued glued{.place = place, .spheres = {}};
    glued.place.z() = reach_towards(grain, pose, -Vector::UnitZ());
    for (const ClumpSphere& sphere : grain.spheres) {
      glued.spheres.push_back({.centre = pose * sphere.centre, .radius = sphere.radius});
    }
    glued_.push_back(std::move(glued));
  }

  /// From grain a to the nearest image of grain b.
  Vector apart(std::size_t a, std::size_t b) const {
    Vector way = glued_[b].place - glued_[a].place;
    for (int axis = 0; axis < 2; ++axis) way[axis] -= tile_ * std::round(way[axis] / tile_);
    return way;
  }

  /// Overlap of two grains enlarged `growth` times along the board.
  double overlap(const Glued& a, const Glued& b, const Vector& way, double growth) const {
    if (way.norm() > 2 * growth * reach_) return 0;
    const Vector closer = {way.x() / growth, way.y() / growth, way.z()};
    double deepest = 0;
    for (const FixedSphere& one : a.spheres) {
      for (const FixedSphere& other : b.spheres) {
        const double distance = (closer + other.centre - one.centre).norm();
        deepest = std::max(deepest, one.radius + other.radius - distance);
      }
    }
    return deepest;
  }

  /// Moves overlapping grains apart, each by half of the overlap.
  void spread() {
    std::vector<Vector> shifts(glued_.size(), Vector::Zero());
    for (std::size_t a = 0; a < glued_.size(); ++a) {
      for (std::size_t b = a + 1; b < glued_.size(); ++b) {
        const Vector way = apart(a, b);
        const double depth = overlap(glued_[a], glued_[b], way, growth_);
        const double length = way.head<2>().norm();
        if (depth == 0 || length == 0) continue;
        const Vector shift = .5 * depth / length * Vector(way.x(), way.y(), 0);
        shifts[a] -= shift;
        shifts[b] += shift;
      }
    }
    constexpr double kCaution = .7;  // as several push each grain
    for (std::size_t k = 0; k < glued_.size(); ++k) glued_[k].place += kCaution * shifts[k];
  }

  double tile_;
  double growth_;
  double reach_;
  std::vector<Glued> glued_;
};

}  // namespace

void find_coverage_error(std::string_view experiment, double coverage, base::Faults& errors) {
  errors.require(coverage >= kMinCoverage && coverage <= kMaxCoverage,
                 {.subject = fmt::format("{}.coverage", experiment),
                  .value = fmt::format("is {:g}", coverage),
                  .rule = fmt::format("{:g} to {:g}: below, the bed has holes that a grain falls "
                                      "into; above, glued grains would lie on each other",
                                      kMinCoverage, kMaxCoverage),
                  .fix = "0.75."});
}

ProtocolKey coverage_key(double& coverage) {
  return number_key("coverage", "0.75", from_to(kMinCoverage, kMaxCoverage), coverage);
}

SphereBed glued_bed(const ClumpShape& grain, double coverage, Random& random) {
  const double thickness = width_along(grain, lying_pose(grain), Vector::UnitZ());
  for (int k = 0; k < kMaxTries; ++k) {
    const Spreading spreading(grain, coverage, random);
    if (spreading.deepest_m() > kMaxOverlap * thickness) continue;
    SphereBed bed = spreading.bed();
    if (!has_hole(bed, .5 * thickness)) return bed;
  }
  throw NoMeasurement(fmt::format(
      "the board could not be covered in {} tries: with a coverage of {:g} these grains lie on "
      "each other, or leave holes that one of them fits in. Fix: another coverage, such as 0.75.",
      kMaxTries, coverage));
}

std::vector<Wall> grain_covered(const Wall& board, const SphereBed& bed, double height_m) {
  Wall plain = board;
  plain.material = kGrainMaterial;
  Wall covering = plain;
  covering.shape = bed;
  covering.pose.position += height_m * (board.pose.orientation * Vector::UnitZ());
  return {plain, covering};
}

double top_m(const SphereBed& bed) { return BedFacets(bed).top(); }

bool has_hole(const SphereBed& bed, double radius_m) {
  const BedFacets facets(bed);
  const int places = static_cast<int>(std::ceil(bed.tile / (2 * radius_m))) * kPlacesPerGrain;
  std::vector<int> near;
  for (int i = 0; i < places; ++i) {
    for (int j = 0; j < places; ++j) {
      facets.near({i * bed.tile / places, j * bed.tile / places, radius_m}, radius_m, near);
      if (near.empty()) return true;
    }
  }
  return false;
}

}  // namespace repose::dem
