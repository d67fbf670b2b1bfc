#pragma once

#include "studio/http.h"
#include "studio/study_folder.h"

namespace repose::studio {

/// The page's requests about studies and their sheets. Routes are documented in study_routes.cpp.
void serve_studies(httplib::Server& http, StudyFolder& studies);

}  // namespace repose::studio
