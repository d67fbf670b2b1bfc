#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/bench/bench.h"
#include "calibrate/statistics/left_out.h"
#include "calibrate/statistics/table/table.h"

/// Readings of a bench test as recorded at the bench: a CSV table, one per row.
namespace repose::calibrate {

/// The column that names the grain, which a sheet may have in addition to those of its test.
inline constexpr std::string_view kSampleColumn = "sample";

/// Required and optional columns of a sheet.
std::vector<std::string> column_names(BenchTest test);
std::vector<std::string> optional_column_names(BenchTest test);

/// "drops.csv: line 5 is left out (labelled "Mean")."
std::string text_of(const LeftOut& left_out, const std::filesystem::path& file);

/// Contents of a sheet.
struct Sheet {
  std::vector<BenchReading> readings;
  std::vector<LeftOut> left_out;   ///< rows and columns that are not readings of the test
  std::vector<std::string> notes;  ///< what a person should check, a sentence each
};

/// The rows of a sheet's table, without those that are not readings (take_other_rows). Readings
/// that are the same in all rows may be in `constants` instead of a column. Adds every error:
/// columns that are missing or given twice, cells that are not numbers, no rows below the header
/// unless that is allowed. Rows with such a cell are left out.
Sheet sheet_of(Table table, BenchTest test, const std::map<std::string, double>& constants,
               NoRows no_rows, base::Faults& errors);

/// sheet_of a file's table.
/// @throws base::InputError  it is not a table, see parse_table.
Sheet read_sheet(const std::filesystem::path& file, BenchTest test,
                 const std::map<std::string, double>& constants, NoRows no_rows,
                 base::Faults& errors);

}  // namespace repose::calibrate
