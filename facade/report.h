#pragma once

#include "base/input_error.h"
#include "calibrate/report/measure_report.h"
#include "calibrate/report/study_report.h"

/// A calibrated study as a page to be read, sent and printed: one HTML file that needs no network.
/// Link repose::calibrate.
///
///     #include <repose/report.h>
///
///     int main(int, char* arguments[]) { repose::write_report(arguments[1]); }
///
/// with the folder that run_study() or `repose calibrate` wrote.
namespace repose {

using base::InputError;

// FOLDER/report.html, and the data of its charts in FOLDER/tables.
using calibrate::report::write_report;

// The page as text, of a folder or of a result.
using calibrate::report::CsvFile;
using calibrate::report::Report;
using calibrate::report::study_report;

// The page of `repose measure --report`.
using calibrate::report::measure_report;

}  // namespace repose
