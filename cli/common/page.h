#pragma once

#include <string>
#include <string_view>

#include "cli/common/table.h"

namespace repose::cli {

/// Tables and paragraphs below each other, for a terminal of some width.
class Page {
 public:
  explicit Page(int terminal_columns) : columns_(terminal_columns) {}

  void add_gap() { text_ += '\n'; }
  void add(const Table& table) { text_ += table.text(columns_); }
  void add(std::string_view text) { add("", text); }
  /// To be copied: as they are, each with its end.
  void add_lines(std::string_view lines) { text_ += lines; }
  void add(std::string_view mark, std::string_view text) {
    text_ += paragraph(mark, text, columns_);
  }

  const std::string& text() const { return text_; }

 private:
  int columns_;
  std::string text_;
};

}  // namespace repose::cli
