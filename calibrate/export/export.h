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

/// A program that studies are exported to (target_entry.h).
using ExportTarget = const TargetEntry*;

ExportTarget liggghts_target();
ExportTarget yade_target();
ExportTarget lammps_target();
ExportTarget edem_target();

/// All of them.
std::array<ExportTarget, 4> export_targets();

/// Its name on the command line and in folders.
std::string name_of(ExportTarget target);
/// What is written for it, in a few words.
std::string summary_of(ExportTarget target);
/// Null if there is none of that name.
ExportTarget export_target_named(std::string_view name);

/// A fitted coefficient.
struct FittedValue {
  std::string name = {};  ///< "contact.particle_wall.restitution"
  double value = 0;
  double low = 0;  ///< of the 95 % interval; both 0: no interval
  double high = 0;
  std::string verdict = {};  ///< "determined", "one-sided", "undetermined"; empty: none
};

/// Those of the published method are points without intervals.
std::vector<FittedValue> fitted_values(const StudyResult& result);

/// The fitted values and the equally good sets, numbered from 1: the values of a set belong
/// together. Each in the order of fitted_values().
std::vector<std::vector<double>> exported_sets(const StudyResult& result);

/// The bench's result for an experiment.
struct BenchMean {
  std::string experiment = {};  ///< by name
  std::string unit = {};
  double mean = 0;
  double uncertainty = 0;  ///< standard uncertainty of the mean
};

/// Of the experiments whose own reading was measured and fitted; those of the published method have
/// no uncertainty and are omitted.
std::vector<BenchMean> bench_means_of(const StudyResult& result);

/// How well the target's law represents ours.
enum class Fidelity {
  exact,        ///< the same equation
  close,        ///< the same force or torque while it slides or rolls, but built up differently
  approximate,  ///< another law, equal only on average or for some motions
};

std::string name_of(Fidelity fidelity);

/// The conversion of one coefficient.
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
  /// If false, coefficients whose conversion is only approximate are refused.
  bool takes_approximate = false;
  /// The equally good set whose values are exported; 1 is the best.
  std::size_t set_number = 1;
};

/// Decks for the material, the contacts, the clump and each experiment of the study, and a
/// README.txt that explains how each coefficient was converted.
/// @param study  as simulated; free coefficients are NaN in it, or have their value
/// @param fitted  names and intervals, and the values unless there are sets
/// @param sets  from exported_sets(), chosen by request.set_number; or empty
/// @param bench  measurements that further runs of the target are calibrated to
/// @throws base::InputError  there is no set of that number; or coefficients that have no value, or
///   that the target cannot represent or only approximately: all of them, a line each.
StudyExport export_study(const dem::Study& study, const dem::ClumpShape& grain,
                         const std::vector<FittedValue>& fitted, const ExportRequest& request,
                         const std::vector<std::vector<double>>& sets = {},
                         const std::vector<BenchMean>& bench = {});

/// Writes each file atomically, replacing those of an earlier export; creates the folder.
/// @param is_ours  existing files of these names are from an earlier version of repose
/// @throws base::InputError  the folder or a file cannot be written, or a user's files would be
///   lost; then nothing is written.
void write_export(const std::filesystem::path& folder, const std::vector<ExportedFile>& files,
                  bool is_ours = false);

}  // namespace repose::calibrate
