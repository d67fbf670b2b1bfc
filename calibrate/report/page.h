#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "calibrate/report/document.h"

namespace repose::calibrate::report {

/// Contained in every page written here, and in no other.
inline constexpr std::string_view kPageMark = R"(<meta name="generator" content="repose)";

/// A table with the name of its file.
struct NamedTable {
  std::string name;
  const DataTable* data = nullptr;
};

/// The tables of all charts, and all shown tables that have a name.
std::vector<NamedTable> tables_of(const Document& document);

/// RFC 4180, a header with units; six significant digits. Missing values are empty.
std::string csv_of(const DataTable& table);

/// {"charts": [...]} with the same numbers column by column, for the page's script. Contains no
/// "<", so it can be embedded in HTML.
std::string charts_json(const Document& document);

/// The document as one self-contained HTML file: style, script, data, pictures and plotly.js are in
/// it, and its content security policy lets it fetch nothing. Names from files are escaped as text.
/// The same document gives the same bytes.
std::string html_of(const Document& document);

}  // namespace repose::calibrate::report
