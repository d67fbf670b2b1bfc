#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/particles/particles.h"
#include "calibrate/particles/standing_heap.h"
#include "render/scene/scene.h"
#include "vision/camera/heap_sizes.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// The angle of a heap whose particle positions are in a file: rendered from all around like
/// simulated heaps, each view measured like a photograph.
namespace repose::calibrate {

/// What the user states about such files.
struct PositionsOptions {
  ParticleReading reading;
  HeapPlacement placement;
};

/// Format name of repose's own files.
inline constexpr std::string_view kStateFormat = "state of repose";

/// A file of positions, ready to be drawn.
struct PositionsFile {
  StandingHeap heap;
  std::string format;  ///< "LIGGGHTS or LAMMPS dump"; "state of repose"
  std::string unit;    ///< of the file's numbers; empty: unknown
  std::string step;    ///< the one that was read, if there are several
  int steps = 1;
  bool has_clumps = false;
  Up up = Up::z;

  /// How it was interpreted, for people: "step 120000, the last of 12; ...".
  std::string text() const;
  bool is_state() const { return format == kStateFormat; }
};

/// Also reads repose's own states, which need none of the options.
/// @throws base::InputError  as read_particles() and standing_heap(), or options given for a state,
///   which needs none.
PositionsFile read_positions(const std::filesystem::path& file, const PositionsOptions& options);

struct MeasuredPositions {
  PositionsFile file;
  /// From directions equally spaced over half a turn; only the first has outline and edges.
  std::vector<vision::ReposeAngle> views;
  vision::Picture first_picture;            ///< the first view's
  std::optional<double> between_views_rad;  ///< standard deviation
  /// As mean_of_views(); also flagged if particles hang in the air or overlap deeply.
  vision::ReposeAngle angle;
  double mm_per_px = 0;  ///< 0: the unit is unknown
  vision::HeapSizes sizes;
};

/// The result does not depend on the number of threads.
/// @param report  called with the completed fraction, from any thread; an exception from it ends
/// the
///   work
/// @throws base::InputError  as read_positions(), and vision::measure_repose_angle().
MeasuredPositions measure_positions(const std::filesystem::path& file,
                                    const PositionsOptions& options,
                                    const vision::MeasureOptions& measuring,
                                    const std::function<void(double fraction)>& report = {});

}  // namespace repose::calibrate
