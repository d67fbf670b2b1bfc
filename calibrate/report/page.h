#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/report/document.h"

namespace repose::calibrate::report {

/// In every page that is written here, and in no other.
inline constexpr std::string_view kPageMark = R"(<meta name="generator" content="repose)";

/// A table with the name of its file.
struct NamedTable {
  std::string name;
  const DataTable* data = nullptr;
};

/// Every chart's table, and every shown table that has a name.
std::vector<NamedTable> tables_of(const Document& document);

/// RFC 4180, a header with units; six significant digits. What does not exist is empty.
std::string csv_of(const DataTable& table);

/// {"charts": [...]} with the same numbers column by column, for the page's script. No "<" in it:
/// it can stand in HTML.
std::string charts_json(const Document& document);

/// The document as one HTML file that needs nothing else: style, script, data, pictures and
/// plotly.js are in it, and its content-security policy lets it fetch nothing. Names from files are
/// text, whatever they contain. The same document gives the same bytes.
std::string html_of(const Document& document);

}  // namespace repose::calibrate::report
