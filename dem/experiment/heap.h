#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "dem/experiment/experiment.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

/// A tube is filled with grains and lifted off a plate.
///
/// The result is `Repeat::envelopes`, the heap's outlines from all sides: lines fitted to them give
/// its angle later; there is no value yet. Readings: "grains" (when the lift began),
/// "grains_on_plate", "grains_off_plate", "height_mm", "no_heap" (1: the grains spread in a layer
/// too low to be a heap, below 2.5 grain diameters), "at_rest" (0: still creeping 5 s after the
/// tube was removed, as heaps do with constant-torque rolling friction), "time_s" (of lift and
/// settling). Throws NoMeasurement if the grains stay in the tube or leave the plate.
struct HeapProtocol {
  double tube_diameter_m = .1;  ///< inner
  double tube_height_m = .4;
  double tube_thickness_m = .002;
  double lift_speed_m_s = .03;
  double plate_m = .4;  ///< side of the square plate
  double plate_thickness_m = .002;
  std::optional<int> grains;  ///< std::nullopt: as many as fill the tube, levelled at its rim
  /// Distance of a level camera that photographs the heap from the tube's axis; std::nullopt: so
  /// far away that its rays are parallel. Does not affect the simulation.
  std::optional<double> camera_distance_m = {};
  double camera_height_m = .04;  ///< of the camera's lens, above the plate
  /// If `grains` do not fit (which depends on friction), take those that do; otherwise that is an
  /// error.
  bool allow_partial_fill = false;
};

Repeat run_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report = {}, const RunRecord& record = {});

/// Resumes an interrupted heap, with a result identical to an uninterrupted run. `from` must be of
/// the same model, protocol and seed, which is not checked.
Repeat resume_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                   const Restart& from, const ProgressReport& report = {},
                   const RunRecord& record = {});

/// Grains that another program's tube left on the plate.
struct StandingHeap {
  std::vector<Grain> grains;  ///< of the model's grain
  int lifted = 0;             ///< their number when the lift began
  bool is_at_rest = true;
};

/// The result for such a heap, as of run_heap(). Times and steps are not known, and 0.
/// @throws base::InputError, NoMeasurement  as run_heap().
Repeat heap_from(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                 const StandingHeap& heap);

/// Stages of a heap experiment, in this order: the values of RunProgress::stage.
struct HeapStage {
  enum : int { rain, settle_in_tube, lift, settle };
};

/// The envelopes of a heap of spheres on the ground z = 0 from `views` sides, equally spaced over
/// half a turn; the first looks along +y.
///
/// Columns are a twentieth of the mean sphere radius wide. The heap is what is connected to the
/// highest column: grains beyond a gap are not part of it. Proved by HeapEnvelope.* in
/// tests/dem/experiment_envelope_test.cpp.
///
/// Throws base::InputError for less than one view or if no sphere reaches above the ground.
std::vector<Envelope> heap_envelopes(const std::vector<ClumpSphere>& spheres, int views);

/// Heaps lower than this many grain diameters are layers, which have no angle of repose.
inline constexpr double kLowestHeap = 2.5;

/// The highest point of all envelopes, m.
double height_m(const std::vector<Envelope>& envelopes);

}  // namespace repose::dem
