#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

/// The way back from an export: a study of runs that the target makes (calibrate/runs).
namespace repose::calibrate {

inline constexpr const char* kFurtherRunsFile = "further_runs.toml";

/// A coefficient varied in further runs, as the target defines it.
struct VariedCoefficient {
  std::string name = {};  ///< "grain with grain: Coefficient of Static Friction"
  double low = 0;
  double high = 0;
};

struct FurtherRuns {
  std::string target;  ///< its name
  std::vector<VariedCoefficient> coefficients = {};
  std::vector<BenchMean> readings = {};  ///< empty: the bench measured nothing that they affect

  /// Runs to begin with: more than the fit needs, including repeats.
  int first_count() const { return 3 * (static_cast<int>(coefficients.size()) + 1); }
  int next_count() const { return static_cast<int>(coefficients.size()) + 3; }
  /// "3 coefficients that the study did not determine".
  std::string parameters_text() const;
  bool are_all_varied = false;  ///< the study determined all of them
  /// The bench's tilt is not used: decks print the plate's angle once the body has slipped half a
  /// millimetre, whereas the bench measures the onset, which is less.
  bool is_tilt_left_out = false;
};

/// The coefficients that the study fitted but did not determine, or all if it determined all; and
/// the bench's results of experiments that the target has and that depend on any of them.
FurtherRuns further_runs(const ExportFacts& facts, ExportTarget target,
                         const std::vector<Conversion>& conversions,
                         const std::vector<BenchMean>& bench);

/// The study file, with the bounds of the exported study.
ExportedFile further_runs_study(const ExportFacts& facts, const FurtherRuns& further);

/// The definition by which the study's heaps are measured: a name in base/angle_definition.h.
std::string heap_definition(const ExportFacts& facts);

}  // namespace repose::calibrate
