#pragma once

#include <string>

#include "calibrate/report/document.h"

namespace repose::calibrate::report {

/// The document as one HTML file that needs nothing else: style, script, data, pictures and
/// plotly.js are in it, and its content-security policy lets it fetch nothing. Names from files are
/// text, whatever they contain. The same document gives the same bytes.
std::string html_of(const Document& document);

}  // namespace repose::calibrate::report
