#include "calibrate/measured/measured_workbook.h"

#include <charconv>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>
#include <xlsxwriter.h>

#include "base/atomic_file.h"
#include "base/version.h"
#include "calibrate/measured/measured_columns.h"
#include "calibrate/measured/measured_json.h"
#include "calibrate/measured/measured_set.h"

namespace repose::calibrate {

namespace {

namespace fs = std::filesystem;

void require(lxw_error error) {
  if (error == LXW_NO_ERROR) return;
  throw std::runtime_error(fmt::format("the workbook cannot be made: {}", lxw_strerror(error)));
}

/// A temporary file for the library, which writes to a named file, to be read back; deleted by the
/// destructor.
class Place {
 public:
  Place() : file_((fs::temp_directory_path() / "repose-XXXXXX.xlsx").string()) {
    constexpr int kEnding = 5;
    const int descriptor = ::mkstemps(file_.data(), kEnding);
    if (descriptor < 0) throw std::runtime_error("the workbook cannot be made: no temporary file");
    ::close(descriptor);
  }
  ~Place() {
    std::error_code ignored;
    fs::remove(file_, ignored);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  Place(Place&&) = delete;
  Place& operator=(Place&&) = delete;

  const std::string& file() const { return file_; }

 private:
  std::string file_;
};

/// A sheet filled from the top, row by row.
class Sheet {
 public:
  Sheet(lxw_workbook* book, const char* name) : sheet_(workbook_add_worksheet(book, name)) {}

  void add_text(std::string_view text, lxw_format* format = nullptr) {
    if (!text.empty()) {
      // Spreadsheets cannot open longer ones.
      constexpr std::size_t kMost = 8000;
      require(worksheet_write_string(sheet_, row_, column_,
                                     std::string(text.substr(0, kMost)).c_str(), format));
    }
    ++column_;
  }
  void add_number(double number) {
    require(worksheet_write_number(sheet_, row_, column_++, number, nullptr));
  }
  /// Anything that is not a number is text.
  void add(const std::string& cell, bool is_text) {
    double number = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
    if (!is_text && error == std::errc() && end == cell.data() + cell.size())
      return add_number(number);
    add_text(cell);
  }
  void end_row() {
    ++row_;
    column_ = 0;
  }
  /// Of columns, numbered from 0.
  void set_width(int from, int to, double letters) {
    require(worksheet_set_column(sheet_, static_cast<lxw_col_t>(from), static_cast<lxw_col_t>(to),
                                 letters, nullptr));
  }
  /// These rows and columns stay visible.
  void freeze(int rows, int columns) {
    worksheet_freeze_panes(sheet_, static_cast<lxw_row_t>(rows), static_cast<lxw_col_t>(columns));
  }

 private:
  lxw_worksheet* sheet_;
  lxw_row_t row_ = 0;
  lxw_col_t column_ = 0;
};

struct Formats {
  lxw_format* heading = nullptr;
  lxw_format* unit = nullptr;
};

Formats formats_of(lxw_workbook* book) {
  Formats formats{.heading = workbook_add_format(book), .unit = workbook_add_format(book)};
  format_set_bold(formats.heading);
  format_set_italic(formats.unit);
  format_set_bottom(formats.unit, LXW_BORDER_THIN);
  return formats;
}

void add_heaps(lxw_workbook* book, const Formats& formats,
               const std::vector<MeasuredPicture>& pictures) {
  constexpr double kName = 28, kNumber = 14;
  constexpr int kHeaders = 2;
  const auto columns = measured_columns();
  Sheet sheet(book, "heaps");
  sheet.set_width(0, 0, kName);
  sheet.set_width(1, static_cast<int>(columns.size()) - 1, kNumber);
  sheet.freeze(kHeaders, 1);
  for (const MeasuredColumn& column : columns) sheet.add_text(column.name, formats.heading);
  sheet.end_row();
  for (const MeasuredColumn& column : columns) {
    // A rule below all cells, so there is a word where there is no unit.
    sheet.add_text(column.unit.empty() ? (column.is_text ? "text" : "1") : column.unit,
                   formats.unit);
  }
  sheet.end_row();
  for (const MeasuredPicture& picture : pictures) {
    const std::vector<std::string> cells = measured_cells(picture);
    for (std::size_t k = 0; k < cells.size(); ++k) sheet.add(cells[k], columns[k].is_text);
    sheet.end_row();
  }
}

void add_mean(lxw_workbook* book, const Formats& formats,
              const std::vector<MeasuredPicture>& pictures) {
  constexpr double kName = 30, kNumber = 14, kMeaning = 70;
  Sheet sheet(book, "mean");
  sheet.set_width(0, 0, kName);
  sheet.set_width(1, 2, kNumber);
  sheet.set_width(3, 3, kMeaning);
  for (const char* heading : {"of all as one set", "value", "unit", "meaning"}) {
    sheet.add_text(heading, formats.heading);
  }
  sheet.end_row();
  const auto add = [&](const char* name, const std::optional<double>& value, const char* unit,
                       const char* meaning) {
    sheet.add_text(name);
    value ? sheet.add_number(*value) : sheet.add_text("none");
    sheet.add_text(unit);
    sheet.add_text(meaning);
    sheet.end_row();
  };
  const MeasuredSet set = measured_set(pictures);
  const std::optional<Summary>& mean = set.pictures.heaps_deg;
  const auto of = [&](auto value) { return mean ? value(*mean) : std::optional<double>(); };
  const auto end = [](double sign) {
    return [sign](const Summary& of_set) {
      const auto half = of_set.mean_uncertainty;
      return half ? std::optional(of_set.mean + sign * *half) : std::nullopt;
    };
  };
  add("n", mean ? mean->n : 0, "heaps", "heaps that are in the mean; copies count once");
  add("mean", of([](const Summary& one) { return std::optional(one.mean); }), "°",
      "mean of the heaps' angles of repose");
  add("standard deviation", of([](const Summary& one) { return one.sd; }), "°", "of single heaps");
  add("interval, from", of(end(-1)), "°", "95 % interval of the mean (Student)");
  add("interval, to", of(end(1)), "°", "95 % interval of the mean (Student)");
  add("flagged", set.pictures.flagged, "pictures", "of those in the mean: look at them");
  add("refused", set.pictures.refused, "pictures", "without an angle");
  add("not read", set.not_read, "files", "");
  add("copies", set.copies, "files", "of others, not counted");
  for (const NamedOutlier& outlier : set.outliers) {
    add("outlier", outlier.angle_deg, "°",
        (outlier.file + (outlier.is_counted ? ", counted" : ", left out")).c_str());
  }
}

void add_columns(lxw_workbook* book, const Formats& formats) {
  constexpr double kName = 30, kUnit = 14, kMeaning = 70;
  Sheet sheet(book, "columns");
  sheet.set_width(0, 0, kName);
  sheet.set_width(1, 1, kUnit);
  sheet.set_width(2, 2, kMeaning);
  for (const char* heading : {"column", "unit", "meaning"})
    sheet.add_text(heading, formats.heading);
  sheet.end_row();
  for (const MeasuredColumn& column : measured_columns()) {
    sheet.add_text(column.name);
    sheet.add_text(column.unit);
    sheet.add_text(column.meaning);
    sheet.end_row();
  }
}

}  // namespace

std::string measure_workbook(const std::vector<MeasuredPicture>& pictures) {
  const Place place;
  lxw_workbook* book = workbook_new(place.file().c_str());
  if (book == nullptr) require(LXW_ERROR_MEMORY_MALLOC_FAILED);
  const Formats formats = formats_of(book);
  add_heaps(book, formats, pictures);
  add_mean(book, formats, pictures);
  add_columns(book, formats);
  // The current time would give different bytes for the same results.
  constexpr time_t kNoTime = 315532800;  // 1 January 1980, the earliest that a ZIP file can hold
  std::string comments(base::kProgram);
  lxw_doc_properties about{};
  about.comments = comments.data();
  about.created = kNoTime;
  require(workbook_set_properties(book, &about));
  require(workbook_close(book));
  return base::read_whole_file(place.file());
}

}  // namespace repose::calibrate
