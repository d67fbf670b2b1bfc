#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

/// From an export back to here: a study of runs that the target makes (calibrate/runs).
namespace repose::calibrate {

inline constexpr const char* kFurtherRunsFile = "further_runs.toml";

/// A coefficient that further runs vary, as the target defines it.
struct VariedCoefficient {
  std::string name = {};  ///< "grain with grain: Coefficient of Static Friction"
  double low = 0;
  double high = 0;
};

struct FurtherRuns {
  std::string target;  ///< its name
  std::vector<VariedCoefficient> coefficients = {};
  std::vector<BenchMean> readings = {};  ///< none: the bench measured nothing that they act on

  /// Runs to begin with: more than the fit needs places, repeats among them.
  int first_count() const { return 3 * (static_cast<int>(coefficients.size()) + 1); }
  int next_count() const { return static_cast<int>(coefficients.size()) + 3; }
  /// "3 coefficients that the study did not determine".
  std::string parameters_text() const;
  bool are_all_varied = false;  ///< the study determined all of them
  /// Of a bench that tilted: decks print the plate's angle once the body has slipped half a
  /// millimetre, and the bench's is the onset, which is less: no reading of such runs.
  bool is_tilt_left_out = false;
};

/// Those coefficients that the study sought and did not determine, or all where it determined all;
/// and what the bench measured, of experiments that the target has, in which one of them acts.
FurtherRuns further_runs(const ExportFacts& facts, ExportTarget target,
                         const std::vector<Conversion>& conversions,
                         const std::vector<BenchMean>& bench);

/// The study, with the bounds of the one that is exported.
ExportedFile further_runs_study(const ExportFacts& facts, const FurtherRuns& further);

/// By which the study's heaps are measured: a name of base/angle_definition.h.
std::string heap_definition(const ExportFacts& facts);

}  // namespace repose::calibrate
