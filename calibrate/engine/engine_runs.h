#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/engine/engine.h"
#include "calibrate/runs/next_runs.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/statistics/table/table.h"

namespace repose::calibrate {

/// What runs are made for.
enum class RunsFor { fit, check };

/// The runs that an engine makes: FOLDER/runs/runs.csv, a table of runs as anybody's, and beside it
/// a folder of each run, which the column "run" names. Those that check a fit, and have no part in
/// one, are in FOLDER/runs/checks.csv, with seeds of their own. Rows without a reading and a status
/// are still to be made. The table is all that is known of the runs, so that whoever changes it, or
/// adds rows, is heeded; it is written after each run. Proved by EngineStudyTest.* in
/// tests/calibrate.
class EngineRuns {
 public:
  /// @throws base::InputError  there is a table that lacks a parameter or a reading of the study,
  /// or
  ///   whose runs have a parameter that the study has not.
  EngineRuns(const TableStudy& study, const std::filesystem::path& folder,
             RunsFor purpose = RunsFor::fit);

  const std::filesystem::path& file() const { return file_; }
  const std::filesystem::path& folder() const { return folder_; }
  bool exists() const { return !table_.rows.empty(); }

  /// Rows within the bounds, in their order.
  std::vector<std::size_t> to_make() const;
  /// Rows with these parameters, made or not.
  std::vector<std::size_t> rows_at(const std::vector<double>& values) const;
  bool is_made(std::size_t row) const;
  std::size_t made() const;    ///< whatever became of them
  std::size_t failed() const;  ///< of these, all of whose readings are missing
  bool has_reading() const;

  /// Where no run has a reading, whatever kept them from it may have been mended since: those that
  /// failed are to be made again.
  void retry_if_none_succeeded();

  /// Adds rows that are to be made.
  /// @param table  what has been read of all runs
  void plan(const TableRuns& table, const std::vector<NextRun>& runs);

  EngineRun run(std::size_t row) const;
  std::filesystem::path folder_of(std::size_t row) const;

  /// Keeps what a run gave. What a table of runs cannot have, such as an angle of 400 degrees or a
  /// picture that cannot be read, makes it a failed run.
  /// @return why it failed; empty: it did not
  std::string keep(std::size_t row, EngineOutcome outcome);

 private:
  std::string& cell(std::size_t row, const std::string& column);
  const std::string& cell(std::size_t row, const std::string& column) const;
  void add_column(const std::string& name);
  void name_rows();
  void refuse_other_parameters() const;
  bool has_reading(std::size_t row) const;
  bool is_within_bounds(std::size_t row) const;
  std::string fault_of(std::size_t row, const EngineOutcome& outcome) const;
  void save() const;

  const TableStudy& study_;
  RunsFor purpose_;
  std::filesystem::path folder_;
  std::filesystem::path file_;
  Table table_;
};

}  // namespace repose::calibrate
