#pragma once

#include "calibrate/report/document.h"
#include "calibrate/report/study_report.h"

namespace repose::calibrate::report {

/// The document's page and the tables behind it.
Report report_of(Document document);

}  // namespace repose::calibrate::report
