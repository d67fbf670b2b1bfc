#include "calibrate/particles/standing_heap.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/vector.h"

namespace repose::calibrate {
namespace {

using dem::ClumpSphere;
using dem::Vector;
using Indices = std::vector<std::size_t>;

constexpr double kTouch = .1;     // of the smaller radius
constexpr double kStands = .2;    // of the median radius
constexpr double kStanding = .5;  // of n^(2/3), n the number of grains
constexpr std::size_t kFewestStanding = 3;
constexpr double kMostInTheAir = .05;  // of the grains
constexpr double kSecondHeap = .1;     // of the first one's grains
constexpr double kLowestHeap = 2.5;    // grains, as for simulated heaps
constexpr double kHangsTogether = .3;  // of the grains, at least, belong to the heap
constexpr double kDeep = .4;           // overlap, of the smaller radius

/// Rotates a position from the file's axes to the heap's.
Vector turned(const Vector& place, Up up) {
  switch (up) {
    case Up::x:
      return {place.y(), place.z(), place.x()};
    case Up::y:
      return {place.z(), place.x(), place.y()};
    case Up::z:
      return place;
    case Up::minus_x:
      return {place.z(), place.y(), -place.x()};
    case Up::minus_y:
      return {place.x(), place.z(), -place.y()};
    case Up::minus_z:
      break;
  }
  return {place.y(), place.x(), -place.z()};
}

bool is_down(Up up) { return up == Up::minus_x || up == Up::minus_y || up == Up::minus_z; }

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Disjoint sets (union-find).
class Groups {
 public:
  explicit Groups(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t of(std::size_t one) {
    while (parent_[one] != one) one = parent_[one] = parent_[parent_[one]];
    return one;
  }
  void join(std::size_t one, std::size_t other) {
    const std::size_t a = of(one), b = of(other);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  Indices parent_;
};

/// Finds touching spheres: each level holds those with sizes within a factor of two, in cells as
/// wide as the largest.
class Neighbours {
 public:
  explicit Neighbours(const std::vector<ClumpSphere>& spheres) : spheres_(spheres) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const ClumpSphere& sphere : spheres) smallest = std::min(smallest, sphere.radius);
    std::array<std::vector<double>, 3> places;
    for (const ClumpSphere& sphere : spheres) {
      for (int axis = 0; axis < 3; ++axis) {
        places[static_cast<std::size_t>(axis)].push_back(sphere.centre[axis]);
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = median(std::move(places[static_cast<std::size_t>(axis)]));
    }
    std::map<int, Level> levels;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      Level& level = levels[static_cast<int>(std::log2(spheres[k].radius) - std::log2(smallest))];
      level.largest = std::max(level.largest, spheres[k].radius);
      level.members.push_back(k);
    }
    for (auto& [step, level] : levels) {
      level.cell = (2 + kTouch) * level.largest;
      for (const std::size_t k : level.members) {
        level.cells.emplace_back(key(cell_of(k, level.cell)), k);
      }
      std::sort(level.cells.begin(), level.cells.end());
      levels_.push_back(std::move(level));
    }
  }

  template <typename Found>
  void each_pair(const Found& found) const {
    for (std::size_t own = 0; own < levels_.size(); ++own) {
      for (const std::size_t k : levels_[own].members) {
        for (std::size_t other = own; other < levels_.size(); ++other) {
          look(k, levels_[other], other == own, found);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  struct Level {
    double largest = 0;
    double cell = 0;
    Indices members;
    std::vector<std::pair<std::uint64_t, std::size_t>> cells;
  };

  static constexpr std::int64_t kHalf = 1 << 20;  // cells on either side of the middle

  Cell cell_of(std::size_t k, double cell) const {
    Cell at{};
    for (int axis = 0; axis < 3; ++axis) {
      // For numbers near the largest double, neither the difference nor the cell is finite.
      const double apart = std::floor((spheres_[k].centre[axis] - origin_[axis]) / cell);
      const double place = std::isnan(apart) ? 0 : apart;
      at[static_cast<std::size_t>(axis)] =
          kHalf + static_cast<std::int64_t>(std::clamp(place, -1. * kHalf + 2, 1. * kHalf - 2));
    }
    return at;
  }

  static std::uint64_t key(const Cell& cell) {
    constexpr unsigned kBits = 21;
    return (static_cast<std::uint64_t>(cell[0]) << (2 * kBits)) |
           (static_cast<std::uint64_t>(cell[1]) << kBits) | static_cast<std::uint64_t>(cell[2]);
  }

  template <typename Found>
  void look(std::size_t k, const Level& level, bool is_own, const Found& found) const {
    const Cell at = cell_of(k, level.cell);
    const ClumpSphere& one = spheres_[k];
    for (std::int64_t x = at[0] - 1; x <= at[0] + 1; ++x) {
      for (std::int64_t y = at[1] - 1; y <= at[1] + 1; ++y) {
        const std::uint64_t last = key({x, y, at[2] + 1});
        auto next = std::lower_bound(level.cells.begin(), level.cells.end(),
                                     std::pair(key({x, y, at[2] - 1}), std::size_t{0}));
        for (; next != level.cells.end() && next->first <= last; ++next) {
          if (is_own && next->second <= k) continue;
          const ClumpSphere& other = spheres_[next->second];
          const double reach =
              one.radius + other.radius + kTouch * std::min(one.radius, other.radius);
          if ((one.centre - other.centre).squaredNorm() <= reach * reach) found(k, next->second);
        }
      }
    }
  }

  const std::vector<ClumpSphere>& spheres_;
  Vector origin_ = Vector::Zero();
  std::vector<Level> levels_;
};

/// A connected component.
struct Component {
  Indices grains;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double from_x = std::numeric_limits<double>::infinity();
  double to_x = -std::numeric_limits<double>::infinity();
};

/// Spheres turned so that z is up, and the grains that they belong to.
class Field {
 public:
  Field(const Particles& particles, Up up) : up_(up), spheres_(particles.spheres) {
    std::vector<double> radii;
    for (ClumpSphere& sphere : spheres_) {
      sphere.centre = turned(sphere.centre, up);
      radii.push_back(sphere.radius);
    }
    radius_ = median(std::move(radii));
    std::map<std::int64_t, std::size_t> numbers;
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
      const bool has_clumps = !particles.grains.empty();
      grain_.push_back(
          has_clumps ? numbers.try_emplace(particles.grains[k], numbers.size()).first->second : k);
    }
    const std::size_t grains = particles.grains.empty() ? spheres_.size() : numbers.size();
    lowest_.assign(grains, std::numeric_limits<double>::infinity());
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
      double& lowest = lowest_[grain_[k]];
      lowest = std::min(lowest, spheres_[k].centre.z() - spheres_[k].radius);
    }
  }

  Up up() const { return up_; }
  const std::vector<ClumpSphere>& spheres() const { return spheres_; }
  std::size_t grain_of(std::size_t sphere) const { return grain_[sphere]; }
  std::size_t grains() const { return lowest_.size(); }
  double lowest(std::size_t grain) const { return lowest_[grain]; }
  double radius() const { return radius_; }

  /// Components of the grains for which `counts` is true, largest first.
  std::vector<Component> components(const std::vector<bool>& counts) const {
    Groups groups(grains());
    Neighbours(spheres_).each_pair([&](std::size_t one, std::size_t other) {
      const std::size_t a = grain_[one], b = grain_[other];
      if (a == b || !counts[a] || !counts[b]) return;
      groups.join(a, b);
    });
    std::map<std::size_t, Component> found;
    for (std::size_t grain = 0; grain < grains(); ++grain) {
      if (counts[grain]) found[groups.of(grain)].grains.push_back(grain);
    }
    for (std::size_t k = 0; k < spheres_.size(); ++k) {
      if (!counts[grain_[k]]) continue;
      Component& of = found[groups.of(grain_[k])];
      const ClumpSphere& sphere = spheres_[k];
      of.lowest = std::min(of.lowest, sphere.centre.z() - sphere.radius);
      of.highest = std::max(of.highest, sphere.centre.z() + sphere.radius);
      of.from_x = std::min(of.from_x, sphere.centre.x() - sphere.radius);
      of.to_x = std::max(of.to_x, sphere.centre.x() + sphere.radius);
    }
    std::vector<Component> all;
    for (auto& [first, component] : found) all.push_back(std::move(component));
    std::ranges::stable_sort(all, std::ranges::greater(),
                             [](const Component& one) { return one.grains.size(); });
    return all;
  }

  /// Percentage of touching spheres of different grains that overlap deeply.
  double deep_percent() const {
    std::size_t pairs = 0, deep = 0;
    Neighbours(spheres_).each_pair([&](std::size_t one, std::size_t other) {
      if (grain_[one] == grain_[other]) return;
      ++pairs;
      const ClumpSphere &a = spheres_[one], &b = spheres_[other];
      const double reach = a.radius + b.radius - kDeep * std::min(a.radius, b.radius);
      if ((a.centre - b.centre).squaredNorm() < reach * reach) ++deep;
    });
    constexpr double kPercent = 100;
    return pairs == 0 ? 0 : kPercent * static_cast<double>(deep) / static_cast<double>(pairs);
  }

  /// Height at which a component's lowest grains stand; std::nullopt: too few do.
  std::optional<double> plate_under(const Component& component) const {
    std::vector<double> standing;
    for (const std::size_t grain : component.grains) {
      if (lowest_[grain] <= component.lowest + kStands * radius_) {
        standing.push_back(lowest_[grain]);
      }
    }
    const double wanted =
        kStanding * std::pow(static_cast<double>(component.grains.size()), 2. / 3);
    if (standing.size() < kFewestStanding || static_cast<double>(standing.size()) < wanted) {
      return std::nullopt;
    }
    return median(std::move(standing));
  }

 private:
  Up up_;
  std::vector<ClumpSphere> spheres_;
  Indices grain_;
  std::vector<double> lowest_;
  double radius_ = 0;
};

class Placer {
 public:
  Placer(const std::string& file, const Particles& particles, const HeapPlacement& placement)
      : file_(file),
        particles_(particles),
        placement_(placement),
        field_(particles, placement.up) {}

  StandingHeap take() {
    std::vector<bool> counts(field_.grains(), true);
    if (placement_.plate) leave_below(told_plate(), counts);
    std::vector<Component> all = field_.components(counts);
    if (all.empty()) {
      refuse(
          fmt::format("all particles are below the plate at {} = {:g}", axis(), *placement_.plate),
          "the plate's height in the file's unit, or another direction for up.");
    }
    check_hangs_together(all);
    heap_.deep_percent = field_.deep_percent();
    const double plate = placement_.plate ? told_plate() : found_plate(all.front());
    if (!placement_.plate) {
      leave_below(plate, counts);
      std::erase_if(all, [&](const Component& one) { return !counts[one.grains.front()]; });
    }
    check_stands(all.front(), plate);
    leave_in_the_air(all, plate, counts);
    check_single(all);
    heap_.plate = as_in_file(plate);
    heap_.is_plate_given = placement_.plate.has_value();
    heap_.has_unit = !particles_.unit.empty();
    draw(plate, counts);
    return std::move(heap_);
  }

 private:
  [[noreturn]] void refuse(std::string what, std::string fix) const {
    throw base::InputError({.where = file_, .value = std::move(what), .fix = std::move(fix)});
  }

  /// The file's vertical axis: "z".
  std::string axis() const {
    const std::string_view name = name_of(placement_.up);
    return std::string(name.substr(name.size() - 1));
  }
  double as_in_file(double height) const {
    // Positions have few digits: a plate at 0 is found at 1e-10.
    const double step = 1e-5 * field_.radius();
    const double rounded = step * std::round(height / step);
    return (is_down(placement_.up) ? -1 : 1) * rounded / particles_.unit_m;
  }
  double told_plate() const {
    return (is_down(placement_.up) ? -1 : 1) * *placement_.plate * particles_.unit_m;
  }

  /// Excludes grains whose lowest point is more than a radius below the plate.
  void leave_below(double plate, std::vector<bool>& counts) {
    for (std::size_t grain = 0; grain < field_.grains(); ++grain) {
      if (field_.lowest(grain) >= plate - field_.radius()) continue;
      counts[grain] = false;
      ++heap_.below_plate;
    }
  }

  void check_hangs_together(const std::vector<Component>& all) const {
    std::size_t grains = 0;
    for (const Component& one : all) grains += one.grains.size();
    const std::size_t most = all.front().grains.size();
    if (static_cast<double>(most) >= kHangsTogether * static_cast<double>(grains)) return;
    refuse(fmt::format("particles hardly touch: at most {} of {} hang together", most, grains),
           "check radii and their unit, which may be too small; or take a time step at which the "
           "heap is at rest.");
  }

  double found_plate(const Component& heap) const {
    if (const auto plate = field_.plate_under(heap)) return *plate;
    std::string other;
    for (const auto& [name, up] : kUpNames) {
      if (up == placement_.up) continue;
      const Field turned_field(particles_, up);
      const std::vector<Component> all =
          turned_field.components(std::vector<bool>(turned_field.grains(), true));
      if (!turned_field.plate_under(all.front())) continue;
      other = name;
      break;
    }
    const std::string no_plate =
        fmt::format("no level plate can be told under its {} particles: too few stand at one {}",
                    heap.grains.size(), axis());
    if (!other.empty()) {
      refuse(no_plate + fmt::format(", while many do if {} is up", other),
             fmt::format("say so: {} {}.", base::field("direction that is up"), other));
    }
    refuse(no_plate, "give it: " + base::field("plate's height") +
                         ", in the file's unit; and make sure that the heap is at rest.");
  }

  void check_stands(const Component& heap, double plate) const {
    double tallest = 0;
    for (const ClumpSphere& sphere : field_.spheres()) tallest = std::max(tallest, sphere.radius);
    if (heap.lowest <= plate + 2 * tallest) return;
    refuse(fmt::format("the plate is said to be at {} = {:g}, and the lowest of the heap's {} "
                       "particles is {:g} above it",
                       axis(), *placement_.plate, heap.grains.size(),
                       (heap.lowest - plate) / particles_.unit_m),
           "the plate's height in the file's unit, or leave it out to have it found.");
  }

  void leave_in_the_air(std::vector<Component>& all, double plate, std::vector<bool>& counts) {
    const auto is_flying = [&](const Component& one) {
      return &one != &all.front() && one.lowest > plate + kStands * field_.radius();
    };
    std::vector<Component> standing;
    std::size_t grains = 0;
    for (Component& one : all) {
      grains += one.grains.size();
      if (!is_flying(one)) continue;
      heap_.in_the_air += one.grains.size();
      for (const std::size_t grain : one.grains) counts[grain] = false;
    }
    std::erase_if(all, [&](const Component& one) { return !counts[one.grains.front()]; });
    if (static_cast<double>(heap_.in_the_air) <= kMostInTheAir * static_cast<double>(grains)) {
      return;
    }
    refuse(fmt::format("{} of {} particles touch neither the plate nor others: the heap is not at "
                       "rest, or radii are too small",
                       heap_.in_the_air, grains),
           "take a later time step; or check radii and their unit.");
  }

  void check_single(const std::vector<Component>& all) const {
    if (all.size() < 2) return;
    const Component& first = all.front();
    const auto second = std::find_if(all.begin() + 1, all.end(), [&](const Component& one) {
      return static_cast<double>(one.grains.size()) >=
                 kSecondHeap * static_cast<double>(first.grains.size()) &&
             one.highest - one.lowest >= 2 * kLowestHeap * field_.radius();
    });
    if (second == all.end()) return;
    refuse(fmt::format("there are two heaps that do not touch each other, of {} and {} particles: "
                       "seen from the side they would hide each other",
                       first.grains.size(), second->grains.size()),
           "write the particles of each heap to a file of its own.");
  }

  /// If there are many sizes, they are binned in steps of .5 % of the radius: at the maximum of 40
  /// pixels per grain this shifts an edge by up to .05 pixels.
  void draw(double plate, const std::vector<bool>& counts) {
    constexpr std::size_t kFew = 64;  // sizes drawn exactly
    constexpr double kClass = .005;
    constexpr double kUsualRadius_m = 1e-3;
    const double scale = heap_.has_unit ? 1 : kUsualRadius_m / field_.radius();
    std::map<double, int> sizes;
    for (const ClumpSphere& sphere : field_.spheres()) {
      if (sizes.size() <= kFew) sizes.try_emplace(sphere.radius, 0);
    }
    const bool has_classes = sizes.size() > kFew;
    const auto size_of = [&](double radius) {
      if (!has_classes) return scale * radius;
      const double step = std::round(std::log(radius / field_.radius()) / std::log1p(kClass));
      return scale * field_.radius() * std::exp(step * std::log1p(kClass));
    };
    sizes.clear();
    // Cameras use the first shape as the grain size.
    heap_.scene.shapes.push_back(dem::sphere_shape(size_of(field_.radius())));
    sizes.emplace(size_of(field_.radius()), 0);
    std::vector<bool> is_drawn(field_.grains(), false);
    for (std::size_t k = 0; k < field_.spheres().size(); ++k) {
      const std::size_t grain = field_.grain_of(k);
      if (!counts[grain]) continue;
      const ClumpSphere& sphere = field_.spheres()[k];
      const double radius = size_of(sphere.radius);
      const auto [shape, is_new] =
          sizes.try_emplace(radius, static_cast<int>(heap_.scene.shapes.size()));
      if (is_new) heap_.scene.shapes.push_back(dem::sphere_shape(radius));
      const Vector place = scale * (sphere.centre - plate * Vector::UnitZ());
      heap_.scene.grains.push_back({.shape = shape->second,
                                    .number = static_cast<int>(grain),
                                    .pose = {.position = place},
                                    .velocity = Vector::Zero()});
      ++heap_.spheres;
      if (!is_drawn[grain]) ++heap_.grains;
      is_drawn[grain] = true;
    }
    heap_.scene.walls.push_back({.shape = dem::Plane{}, .pose = {}});
  }

  const std::string& file_;
  const Particles& particles_;
  const HeapPlacement& placement_;
  Field field_;
  StandingHeap heap_;
};

}  // namespace

StandingHeap standing_heap(const std::string& file, const Particles& particles,
                           const HeapPlacement& placement) {
  return Placer(file, particles, placement).take();
}

}  // namespace repose::calibrate
