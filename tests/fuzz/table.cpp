#include "calibrate/statistics/table/table.h"

#include "tests/fuzz/scratch_file.h"

namespace repose::fuzz {

void read_table(Bytes bytes) {
  const calibrate::Table table = calibrate::parse_table("table.csv", text_of(bytes));
  std::vector<calibrate::NumberColumn> columns;
  for (const std::string& name : table.columns) columns.push_back({.name = name});
  calibrate::numbers_of(table, columns);
}

}  // namespace repose::fuzz
