#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "dem/shape/clump/clump_shape.h"
#include "dem/study/study.h"

/// A calibrated study as input of other discrete element programs, in their own definitions.

namespace repose::calibrate {

struct StudyResult;

struct TargetEntry;

/// Another program that studies are exported to (target_entry.h).
using ExportTarget = const TargetEntry*;

ExportTarget liggghts_target();
ExportTarget yade_target();
ExportTarget lammps_target();
ExportTarget edem_target();

/// All of them.
std::array<ExportTarget, 4> export_targets();

/// What the command line and the folders call it.
std::string name_of(ExportTarget target);
/// In a few words, what is written for it.
std::string summary_of(ExportTarget target);
/// Null where there is none of that name.
ExportTarget export_target_named(std::string_view name);

/// A coefficient that was found.
struct FittedValue {
  std::string name = {};  ///< "contact.particle_wall.restitution"
  double value = 0;
  double low = 0;  ///< of the 95 % interval; both 0: there is none
  double high = 0;
  std::string verdict = {};  ///< "determined", "one-sided", "undetermined"; empty: nothing was said
};

/// The published method's are single points without intervals.
std::vector<FittedValue> fitted_values(const StudyResult& result);

/// The fitted values and the sets that fit as well, numbered from 1: the values of one belong
/// together. Each in the order of fitted_values().
std::vector<std::vector<double>> exported_sets(const StudyResult& result);

/// What the bench gave for an experiment.
struct BenchMean {
  std::string experiment = {};  ///< by name
  std::string unit = {};
  double mean = 0;
  double uncertainty = 0;  ///< standard uncertainty of the mean
};

/// Of the experiments whose own reading was measured and fitted; the published method's have no
/// uncertainty, and are left out.
std::vector<BenchMean> bench_means_of(const StudyResult& result);

/// How well the target's law stands for ours.
enum class Fidelity {
  exact,        ///< the same equation
  close,        ///< the same force or torque while it slides or rolls; another way there
  approximate,  ///< another law, which gives the same only in the mean or in part of the motions
};

std::string name_of(Fidelity fidelity);

/// What becomes of one coefficient.
struct Conversion {
  std::string coefficient = {};  ///< "contact.particle_wall.rolling_friction"
  double value = 0;              ///< ours
  double exported = 0;           ///< the target's
  std::string target_name = {};  ///< what the target calls it
  Fidelity fidelity = Fidelity::exact;
  std::string ours = {};    ///< definition
  std::string theirs = {};  ///< definition
  std::string limits = {};  ///< what does not carry over; may be empty
};

struct ExportedFile {
  std::string name;
  std::string text;
};

struct StudyExport {
  std::vector<ExportedFile> files = {};
  std::vector<Conversion> conversions = {};
  std::vector<std::string> warnings = {};  ///< such as coefficients that the data did not determine
};

struct ExportRequest {
  ExportTarget target = liggghts_target();
  /// Otherwise a coefficient whose conversion is approximate is refused.
  bool takes_approximate = false;
  /// Of the equally good sets, the one whose values are exported; 1 is the best.
  std::size_t set_number = 1;
};

/// Decks for the material, the contacts, the clump and each experiment of the study, and a
/// README.txt that says what became of each coefficient.
/// @param study   as simulated; coefficients that were sought are NaN in it, or have their value
/// @param fitted  names and intervals, and the values unless there are sets
/// @param sets    of exported_sets(): request.set_number says which one; or none
/// @param bench   what further runs of the target are calibrated to
/// @throws base::InputError  there is no set of that number; or a coefficient without a value,
///   or one that the target cannot have or has only approximately: all of them, a line each.
StudyExport export_study(const dem::Study& study, const dem::ClumpShape& grain,
                         const std::vector<FittedValue>& fitted, const ExportRequest& request,
                         const std::vector<std::vector<double>>& sets = {},
                         const std::vector<BenchMean>& bench = {});

/// Writes each file whole or not at all, in place of those of an earlier export; makes the folder.
/// @param is_ours  files of these names that are there are of an earlier version of repose
/// @throws base::InputError  the folder or a file cannot be written, or files of a user's
///   would be lost. Nothing is written then.
void write_export(const std::filesystem::path& folder, const std::vector<ExportedFile>& files,
                  bool is_ours = false);

}  // namespace repose::calibrate
