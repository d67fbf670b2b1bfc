#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/experiment/experiment.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// A tube filled with grains and lifted off a plate.
///
/// The result is `Repeat::envelopes`, the heap's outline from all around: a line through them gives
/// its angle, and there is no value yet. Readings: "grains" (when the lift began),
/// "grains_on_plate", "grains_off_plate", "height_mm", "no_heap" (1: the grains spread in a layer
/// too low to be a heap, below 2.5 grain diameters), "at_rest" (0: still creeping 5 s after the
/// tube was away, as constant torques let heaps do), "time_s" (of lift and settling). Throws
/// NoMeasurement when the grains stay in the tube or leave the plate.
struct HeapProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .4;
  double tube_thickness_m = .002;
  double lift_speed_m_s = .03;
  double plate_m = .4;  ///< side of the square plate
  double plate_thickness_m = .002;
  std::optional<int> grains;  ///< or as many as fill the tube, levelled at its rim
  /// Of a level camera that takes pictures of the heap, from the tube's axis; none: from so far
  /// away that its rays are parallel. What is simulated takes no notice of it.
  std::optional<double> camera_distance_m = {};
  double camera_height_m = .04;  ///< of its lens, above the plate
  /// How many fit depends on their friction: where `grains` do not, take those that do. Without it
  /// they are refused.
  bool allow_partial_fill = false;
};

Repeat run_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// Goes on with a heap that was interrupted, to the same bytes as one that was not. `from` must be
/// of the same bench, protocol and seed, which is not checked.
Repeat resume_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                   const Restart& from, const ProgressReport& report = {},
                   const RunRecord& record = {});

/// Grains that another program's tube left on the plate.
struct StandingHeap {
  std::vector<Grain> grains;  ///< of the model's grain
  int lifted = 0;             ///< how many there were when the lift began
  bool is_at_rest = true;
};

/// What such a heap gives, as one of run_heap(). Times and steps are none of ours, and 0.
/// @throws base::InputError, NoMeasurement  as run_heap().
Repeat heap_from(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                 const StandingHeap& heap);

/// What goes on in a heap experiment, in this order: the values of RunProgress::stage.
struct HeapStage {
  enum : int { rain, settle_in_tube, lift, settle };
};

/// The envelopes of a heap of spheres on the ground z = 0 from `views` sides, equally spaced over
/// half a turn; the first looks along +y.
///
/// Columns are a twentieth of a mean sphere's radius wide. The heap is what is connected with the
/// highest column: grains beyond a gap are not part of it. Proved by HeapEnvelope.* in
/// tests/dem/experiment_envelope_test.cpp.
///
/// Throws base::InputError for less than one view and where no sphere reaches above the
/// ground.
std::vector<Envelope> heap_envelopes(const std::vector<ClumpSphere>& spheres, int views);

/// Heaps lower than this many grain diameters are layers, which have no angle of repose.
inline constexpr double kLowestHeap = 2.5;

/// The highest point of all envelopes, m.
double height_m(const std::vector<Envelope>& envelopes);

}  // namespace repose::dem
