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

/// The purpose of runs.
enum class RunsFor { fit, check };

/// The runs that an engine makes: FOLDER/runs/runs.csv, an ordinary table of runs, and beside it a
/// folder for each run, named in the column "run". Runs that check a fit, and are not used in it,
/// are in FOLDER/runs/checks.csv, with seeds of their own. Rows without a reading and a status are
/// still to be made. The table holds the whole state, so changes to it and added rows take effect;
/// it is written after each run. Proved by EngineStudyTest.* in tests/calibrate.
class EngineRuns {
 public:
  /// @throws base::InputError  a table exists that lacks a parameter or a reading of the study, or
  ///   whose runs have a parameter that the study does not have.
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
  std::size_t made() const;    ///< whether or not they succeeded
  std::size_t failed() const;  ///< of these, those without any reading
  bool has_reading() const;

  /// If no run has a reading, the cause may have been fixed since: failed runs are made again.
  void retry_if_none_succeeded();

  /// Adds rows that are to be made.
  /// @param table  all runs as read so far
  void plan(const TableRuns& table, const std::vector<NextRun>& runs);

  EngineRun run(std::size_t row) const;
  std::filesystem::path folder_of(std::size_t row) const;

  /// Saves the outcome of a run. Anything that a table of runs cannot hold, such as an angle of 400
  /// degrees or an unreadable picture, makes it a failed run.
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
