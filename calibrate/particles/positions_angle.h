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

/// The angle of a heap whose particles' places are in a file: drawn from all around as simulated
/// heaps are, each view measured like a photograph.
namespace repose::calibrate {

/// What is told of such files.
struct PositionsOptions {
  ParticleReading reading;
  HeapPlacement placement;
};

/// What repose's own files are called.
inline constexpr std::string_view kStateFormat = "state of repose";

/// A file with places, ready to be drawn.
struct PositionsFile {
  StandingHeap heap;
  std::string format;  ///< "LIGGGHTS or LAMMPS dump"; "state of repose"
  std::string unit;    ///< of the file's numbers; empty: not known
  std::string step;    ///< of several, the one that is read
  int steps = 1;
  bool has_clumps = false;
  Up up = Up::z;

  /// What was made of it, for people: "step 120000, the last of 12; ...".
  std::string text() const;
  bool is_state() const { return format == kStateFormat; }
};

/// States of repose too, which know all that is told of other files.
/// @throws base::InputError  as read_particles() and standing_heap(), or options that a state does
///   not need.
PositionsFile read_positions(const std::filesystem::path& file, const PositionsOptions& options);

struct MeasuredPositions {
  PositionsFile file;
  /// From sides equally spaced over half a turn; without outline and edges, but for the first.
  std::vector<vision::ReposeAngle> views;
  vision::Picture first_picture;            ///< the first view's
  std::optional<double> between_views_rad;  ///< standard deviation
  /// As mean_of_views(); flagged, too, where particles hang in the air or overlap deeply.
  vision::ReposeAngle angle;
  double mm_per_px = 0;  ///< 0: no unit is known
  vision::HeapSizes sizes;
};

/// The same at any number of threads.
/// @param report  told which fraction is done, from any thread; what it throws ends the work
/// @throws base::InputError  as read_positions(), and vision::measure_repose_angle().
MeasuredPositions measure_positions(const std::filesystem::path& file,
                                    const PositionsOptions& options,
                                    const vision::MeasureOptions& measuring,
                                    const std::function<void(double fraction)>& report = {});

}  // namespace repose::calibrate
