#include "cli/report/report.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "base/whole_file.h"
#include "calibrate/report/study_report.h"
#include "cli/common/output.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

/// Before the long work: where the page and its tables would go can be written.
void check_places(const fs::path& page, const fs::path& tables) {
  base::check_can_write(page);
  if (tables.empty()) return;
  std::error_code error;
  fs::create_directories(tables, error);
  if (std::error_code ignored; error || !fs::is_directory(tables, ignored)) {
    throw std::invalid_argument(
        fmt::format("--tables {}: the folder cannot be made ({}). Fix: choose a place you may "
                    "write to, or none.",
                    tables.string(), error ? error.message() : "there is a file of that name"));
  }
  base::check_can_write(tables / "table.csv");
}

}  // namespace

ExitCode run_report(const ReportArguments& arguments) {
  const fs::path folder = arguments.folder;
  const fs::path page =
      arguments.out_file.empty() ? folder / "report.html" : fs::path(arguments.out_file);
  fs::path tables =
      arguments.tables_folder.empty() ? folder / "tables" : fs::path(arguments.tables_folder);
  if (arguments.tables_folder == "none") tables.clear();
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) check_places(page, tables);
  const calibrate::report::Report report = calibrate::report::study_report(folder);
  if (!tables.empty()) {
    for (const calibrate::report::CsvFile& table : report.tables) {
      base::write_whole_file(tables / table.name, table.text);
    }
  }
  base::write_whole_file(page, report.html);
  Outputs outputs;
  outputs.show(page.string() + '\n');
  outputs.write();
  return ExitCode::done;
}

}  // namespace repose::cli
