#include "dem/experiment/filling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {

namespace {

/// Assumed fraction of the run for filling.
constexpr double kFillFraction = .35;
/// Places tried per layer: more would find few.
constexpr int kTriesPerLayer = 400;
/// Assumed height of fall of the rain, in reaches of a grain.
constexpr double kFall = 4;
/// Height to which grains heap over the rim before levelling, in reaches of a grain.
constexpr double kHeaped = 4;

double rain_speed_m_s(double reach_m) {
  return std::sqrt(2 * kStandardGravity_m_s2 * kFall * reach_m);
}

class Rain {
 public:
  /// `draws`: random numbers already used by the rain to resume.
  Rain(const RainPlan& plan, double reach_m, std::uint64_t seed, std::uint64_t draws)
      : plan_(plan), reach_m_(reach_m), random_(seed, draws) {}

  void fill(ExperimentRun& run);

 private:
  int left(const Simulation& simulation) const {
    return plan_.grains ? *plan_.grains - simulation.grain_count()
                        : std::numeric_limits<int>::max();
  }
  double highest_point_m(const ExperimentRun& run) const;
  void rain_up_to(ExperimentRun& run, double height_m);
  /// Adds at most `most` grains; returns the number added.
  int add_layer(ExperimentRun& run, double height_m, int most);

  /// Initial speed of grains added at a height: as if from the spout, or in a steady rain.
  double speed_m_s(double height_m) const {
    if (!plan_.spout_m) return rain_speed_m_s(reach_m_);
    const double fall_m = std::max(reach_m_, *plan_.spout_m - height_m);
    return std::sqrt(2 * kStandardGravity_m_s2 * fall_m);
  }

  /// All kinds are equally likely.
  int kind_of_next(const SimulationSetup& setup) {
    const auto kinds = static_cast<double>(setup.kinds.size());
    return kinds == 1 ? 0 : static_cast<int>(kinds * random_.uniform());
  }

  const RainPlan& plan_;
  double reach_m_;  ///< of the largest grain
  Random random_;
};

double Rain::highest_point_m(const ExperimentRun& run) const {
  double highest = plan_.floor_m;
  for (int k = 0; k < run.simulation().grain_count(); ++k) {
    highest = std::max(highest, highest_m(run.simulation(), k));
  }
  return highest;
}

int Rain::add_layer(ExperimentRun& run, double height_m, int most) {
  std::vector<Vector> taken;
  for (int k = 0; k < kTriesPerLayer && left(run.simulation()) > 0; ++k) {
    if (static_cast<int>(taken.size()) == most) break;
    Vector place = plan_.place(random_);
    place.z() = height_m;
    const bool is_free = std::all_of(taken.begin(), taken.end(), [&](const Vector& other) {
      return (place - other).norm() > 2 * reach_m_;
    });
    if (!is_free) continue;
    taken.push_back(place);
    run.simulation().add({.kind = kind_of_next(run.simulation().setup()),
                          .position = place,
                          .orientation = random_.orientation(),
                          .velocity = {0, 0, -speed_m_s(height_m)}});
  }
  run.progress().random_draws = random_.draws();
  return static_cast<int>(taken.size());
}

/// Layers go in one at a time just above the last one, which by then has fallen by its own height
/// or lies on the grains below. With a rate, a layer holds the grains that are due; those that find
/// no place are dropped, except one at most.
void Rain::rain_up_to(ExperimentRun& run, double height_m) {
  double due = 1;
  for (double highest = highest_point_m(run); highest < height_m && left(run.simulation()) > 0;
       highest = highest_point_m(run)) {
    const double layer_m = highest + 1.01 * reach_m_;
    const int most = plan_.grains_per_s ? static_cast<int>(due) : kTriesPerLayer;
    const int added = add_layer(run, layer_m, most);
    double wait_s = 2 * reach_m_ / speed_m_s(layer_m);
    if (plan_.grains_per_s) {
      const double left_over = std::min(due - added, 1.);
      wait_s = std::max(wait_s, (1 - left_over) / *plan_.grains_per_s);
      due = std::min<double>(left_over + wait_s * *plan_.grains_per_s, kTriesPerLayer);
    }
    run.advance_for(wait_s);
    run.report_progress(kFillFraction * (highest - plan_.floor_m) / (height_m - plan_.floor_m));
  }
}

void Rain::fill(ExperimentRun& run) {
  int& stage = run.progress().stage;
  do {
    if (stage == HeapStage::rain) {
      rain_up_to(run, plan_.rim_m + kHeaped * reach_m_);
      begin_settling(run, HeapStage::settle_in_tube);
    }
    settle(run, kFillFraction);
    stage = HeapStage::rain;
  } while (left(run.simulation()) > 0 && above_rim(run.simulation(), plan_.rim_m).empty());
}

}  // namespace

double fastest_rain_m_s(double reach_m, std::optional<double> spout_m) {
  if (spout_m) return std::sqrt(2 * kStandardGravity_m_s2 * *spout_m);
  return std::sqrt(2) * rain_speed_m_s(reach_m);
}

void rain(ExperimentRun& run, const RainPlan& plan, std::uint64_t seed) {
  Rain(plan, reach_m(run.simulation().setup()), seed, run.progress().random_draws).fill(run);
}

std::vector<int> above_rim(const Simulation& simulation, double rim_m) {
  std::vector<int> above;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (simulation.grain(k).position.z() > rim_m) above.push_back(k);
  }
  return above;
}

void begin_settling(ExperimentRun& run, int stage) {
  RunProgress& progress = run.progress();
  progress.stage = stage;
  progress.rest = {};
  progress.until_s = run.simulation().time_s() + kLongestSettling_s;
}

bool settle(ExperimentRun& run, double fraction) {
  RunProgress& progress = run.progress();
  RestTest rest(run.simulation().setup(), progress.rest);
  while (!rest.is_at_rest(run.simulation())) {
    if (run.simulation().time_s() > progress.until_s) return false;
    progress.rest = rest.memory();
    run.advance_for(rest.interval_s());
    run.report_progress(fraction);
  }
  return true;
}

void tap(ExperimentRun& run, int taps, double height_m) {
  constexpr double kFraction = .35;  // of the run, for the filling before
  const double speed_m_s = std::sqrt(2 * kStandardGravity_m_s2 * height_m);
  for (int k = 0; k < taps; ++k) {
    Checkpoint now = run.simulation().checkpoint();
    for (std::size_t i = 0; i < now.grains.size(); ++i) {
      if (now.is_present[i]) now.grains[i].velocity.z() -= speed_m_s;
    }
    run.simulation() = Simulation(run.simulation().setup(), now);
    begin_settling(run, HeapStage::settle_in_tube);
    settle(run, kFraction + (1 - kFraction) * (k + 1) / taps);
  }
}

namespace {

/// Extra height of the tube during filling, in reaches of a grain.
constexpr double kTaller = 40;

Wall plate_of(const HeapProtocol& protocol) {
  const double half = .5 * protocol.plate_m;
  const double half_thickness = .5 * protocol.plate_thickness_m;
  return study_wall(Box{.half_size = {half, half, half_thickness}},
                    {.position = {0, 0, -half_thickness}});
}

Wall tube_of(const Model& model, const HeapProtocol& protocol, double height_m) {
  return part_wall(model, WallPart::tube,
                   Tube{.inner_radius = .5 * protocol.tube_diameter_m,
                        .thickness = protocol.tube_thickness_m,
                        .height = height_m});
}

/// Random places over the tube.
RainPlan rain_of(const HeapProtocol& protocol, double reach_m, std::optional<double> spout_m,
                 std::optional<double> grains_per_s) {
  const double room = .5 * protocol.tube_diameter_m - reach_m;
  const auto place = [room](Random& random) {
    const double radius = room * std::sqrt(random.uniform());
    const double turn = 2 * std::numbers::pi * random.uniform();
    return Vector(radius * std::cos(turn), radius * std::sin(turn), 0);
  };
  return {.place = place,
          .rim_m = protocol.tube_height_m,
          .grains = protocol.grains,
          .spout_m = spout_m,
          .grains_per_s = grains_per_s};
}

/// The grains up to the rim, with their contacts except those with the removed upper part of the
/// tube.
Checkpoint levelled(const HeapProtocol& protocol, const Simulation& filled) {
  Checkpoint now = filled.checkpoint();
  now.step = 0;
  now.equal_steps = {};
  for (const int grain : above_rim(filled, protocol.tube_height_m)) {
    now.is_present[static_cast<std::size_t>(grain)] = false;
  }
  std::erase_if(now.contacts, [&](const ContactState& contact) {
    const auto a = static_cast<std::size_t>(contact.grain_a);
    if (!now.is_present[a]) return true;
    if (contact.grain_b >= 0) return !now.is_present[static_cast<std::size_t>(contact.grain_b)];
    const bool is_tube = -1 - contact.grain_b == kHeapTube;
    return is_tube &&
           highest_m(shape_of(filled, now.grains[a]), now.grains[a]) > protocol.tube_height_m;
  });
  return now;
}

}  // namespace

AdaptiveTimestep pace_of_rain(const Model& model, std::optional<double> spout_m) {
  return {model, fastest_rain_m_s(largest_reach_m(model), spout_m)};
}

ExperimentRun empty_tube(const Model& model, const HeapProtocol& protocol,
                         const Observers& observers, std::optional<double> spout_m) {
  const double reach = largest_reach_m(model);
  const double tall = protocol.tube_height_m + kTaller * reach;
  return {Simulation(bulk_setup(model, {plate_of(protocol), tube_of(model, protocol, tall)},
                                fastest_rain_m_s(reach, spout_m))),
          observers, pace_of_rain(model, spout_m)};
}

void pour(ExperimentRun& filling, const HeapProtocol& protocol, std::uint64_t seed,
          std::optional<double> spout_m, std::optional<double> grains_per_s) {
  const double reach = reach_m(filling.simulation().setup());
  rain(filling, rain_of(protocol, reach, spout_m, grains_per_s), seed);
}

ExperimentRun struck_level(const ExperimentRun& filling, const Model& model,
                           const HeapProtocol& protocol, std::optional<double> spout_m) {
  const double reach = largest_reach_m(model);
  SimulationSetup setup =
      bulk_setup(model, {plate_of(protocol), tube_of(model, protocol, protocol.tube_height_m)},
                 fastest_rain_m_s(reach, spout_m));
  // Grains that fall off the plate are removed once they are well below it.
  setup.floor_m = -protocol.plate_thickness_m - 5 * reach;
  return {Simulation(std::move(setup), levelled(protocol, filling.simulation())),
          filling.observers(),
          pace_of_rain(model, spout_m),
          {.work = filling.progress().work}};
}

ExperimentRun fill_tube(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                        std::uint64_t seed) {
  pour(filling, protocol, seed);
  const auto over = above_rim(filling.simulation(), protocol.tube_height_m).size();
  if (protocol.grains && !protocol.allow_partial_fill && over > 0) {
    throw base::InputError(
        {.subject = "heap.grains",
         .value = fmt::format("is {}", *protocol.grains),
         .rule = fmt::format("at most what fits into the tube, {}",
                             static_cast<std::size_t>(filling.simulation().grain_count()) - over),
         .fix = "fewer grains, a taller or wider tube, or leave the number out to fill it."});
  }
  return struck_level(filling, model, protocol);
}

namespace {

/// Number of vertical lines across the tube.
constexpr int kLines = 200;

/// The highest point on each vertical line of a square grid around the tube.
class Surface {
 public:
  explicit Surface(double diameter_m)
      : spacing_m_(diameter_m / kLines), heights_m_(std::size_t{kLines} * kLines, 0.0) {}

  void raise(const ClumpSphere& sphere) {
    for (int row = first(sphere, sphere.centre.y()); row <= last(sphere, sphere.centre.y());
         ++row) {
      for (int column = first(sphere, sphere.centre.x()); column <= last(sphere, sphere.centre.x());
           ++column) {
        const double off_x = place_m(column) - sphere.centre.x();
        const double off_y = place_m(row) - sphere.centre.y();
        const double rest = sphere.radius * sphere.radius - off_x * off_x - off_y * off_y;
        if (rest < 0) continue;
        double& height_m = heights_m_[at(row, column)];
        height_m = std::max(height_m, sphere.centre.z() + std::sqrt(rest));
      }
    }
  }

  double mean_m() const {
    const double radius_m = spacing_m_ * kLines / 2;
    double sum = 0;
    int lines = 0;
    for (int row = 0; row < kLines; ++row) {
      for (int column = 0; column < kLines; ++column) {
        if (std::hypot(place_m(row), place_m(column)) > radius_m) continue;
        sum += heights_m_[at(row, column)];
        ++lines;
      }
    }
    return sum / lines;
  }

 private:
  static std::size_t at(int row, int column) {
    return static_cast<std::size_t>(row) * kLines + static_cast<std::size_t>(column);
  }

  double place_m(int line) const { return (line + .5 - kLines / 2.) * spacing_m_; }

  double line_at(double place_m) const { return place_m / spacing_m_ + kLines / 2. - .5; }

  int first(const ClumpSphere& sphere, double centre_m) const {
    return std::max(0, static_cast<int>(std::ceil(line_at(centre_m - sphere.radius))));
  }

  int last(const ClumpSphere& sphere, double centre_m) const {
    return std::min(kLines - 1, static_cast<int>(std::floor(line_at(centre_m + sphere.radius))));
  }

  double spacing_m_;
  std::vector<double> heights_m_;
};

}  // namespace

double filling_height_m(std::span<const ClumpSphere> spheres, double tube_diameter_m) {
  Surface surface(tube_diameter_m);
  for (const ClumpSphere& sphere : spheres) surface.raise(sphere);
  return surface.mean_m();
}

}  // namespace repose::dem
