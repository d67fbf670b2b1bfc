#include "cli/common/table.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "base/text.h"

namespace repose::cli {

namespace {

constexpr std::size_t kGap = 2;
constexpr std::size_t kNarrowestFirst = 8;  // of a first column with cells too long to fit
constexpr std::size_t kNarrowestLast = 20;  // of a wrapped last column
constexpr int kNarrowestTerminal = 40;

std::size_t usable(int terminal_columns) {
  return static_cast<std::size_t>(std::max(kNarrowestTerminal, terminal_columns));
}

std::string coloured(const std::string& text, Colour colour) {
  switch (colour) {
    case Colour::green:
      return "\033[32m" + text + "\033[0m";
    case Colour::yellow:
      return "\033[33m" + text + "\033[0m";
    case Colour::red:
      return "\033[31m" + text + "\033[0m";
    case Colour::none:
      break;
  }
  return text;
}

std::string aligned(const std::string& cell, const Column& column, std::size_t width) {
  const std::string blanks(width - std::min(width, base::letters(cell)), ' ');
  return column.align == Align::right ? blanks + cell : cell + blanks;
}

void add_line(std::string line, std::string& text) {
  line.erase(line.find_last_not_of(' ') + 1);
  text += line + '\n';
}

}  // namespace

Table::Table(std::vector<Column> columns) : columns_(std::move(columns)) {
  for (Column& column : columns_) column.heading = base::printable(column.heading);
}

void Table::add_row(std::vector<std::string> cells, Colour last) {
  cells.resize(columns_.size());
  for (std::string& cell : cells) cell = base::printable(cell);
  rows_.push_back({.cells = std::move(cells), .last = last, .mark = {}, .note = {}});
}

void Table::add_note(std::string mark, std::string text) {
  rows_.push_back({.cells = {}, .mark = std::move(mark), .note = std::move(text), .is_note = true});
}

std::vector<std::size_t> Table::widths(std::size_t available) const {
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    std::size_t width = std::max(columns_[i].min_width, base::letters(columns_[i].heading));
    for (const Row& row : rows_) {
      if (!row.is_note) width = std::max(width, base::letters(row.cells[i]));
    }
    widths.push_back(width);
  }
  const auto left_for = [&](std::size_t column) {
    const std::size_t all = std::accumulate(widths.begin(), widths.end(), std::size_t{0});
    const std::size_t others = all - widths[column] + kGap * (widths.size() - 1);
    return available - std::min(available, others);
  };
  if (columns_.back().align == Align::left) {
    widths.back() = std::min(widths.back(), std::max(kNarrowestLast, left_for(widths.size() - 1)));
  }
  const std::size_t most = std::max(left_for(0), columns_.front().min_width);
  if (widths.front() <= most) return widths;
  widths.front() = std::max(
      {kNarrowestFirst, columns_.front().min_width, base::letters(columns_.front().heading)});
  for (const Row& row : rows_) {
    const std::size_t width = row.is_note ? 0 : base::letters(row.cells.front());
    if (width <= most) widths.front() = std::max(widths.front(), width);
  }
  return widths;
}

void Table::add_lines(const std::vector<std::string>& cells, Colour last,
                      const std::vector<std::size_t>& widths, std::string& text) const {
  std::string line;
  const bool fits = base::letters(cells.front()) <= widths.front();
  if (!fits) add_line(cells.front(), text);
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    line += aligned(i > 0 || fits ? cells[i] : "", columns_[i], widths[i]);
    line += std::string(kGap, ' ');
  }
  if (base::letters(cells.back()) <= widths.back()) {
    add_line(line + coloured(aligned(cells.back(), columns_.back(), widths.back()), last), text);
    return;
  }
  const std::string below(base::letters(line), ' ');
  for (const std::string& part : base::wrapped(cells.back(), widths.back())) {
    add_line(std::exchange(line, below) + part, text);
  }
}

std::string Table::text(int terminal_columns) const {
  const auto widest = widths(usable(terminal_columns));
  std::vector<std::string> headings;
  for (const Column& column : columns_) headings.push_back(column.heading);
  std::string text;
  if (std::any_of(headings.begin(), headings.end(), [](const auto& name) { return !name.empty(); }))
    add_lines(headings, Colour::none, widest, text);
  for (const Row& row : rows_) {
    if (row.is_note) {
      text += paragraph(row.mark, row.note, terminal_columns);
    } else {
      add_lines(row.cells, row.last, widest, text);
    }
  }
  return text;
}

std::string paragraph(std::string_view mark, std::string_view text, int terminal_columns) {
  const std::size_t indent = base::letters(mark);
  std::string before(mark), lines;
  for (const std::string& line :
       base::wrapped(base::printable(text),
                     usable(terminal_columns) - std::min(indent, usable(terminal_columns) / 2))) {
    add_line(before + line, lines);
    before = std::string(indent, ' ');
  }
  return lines;
}

}  // namespace repose::cli
