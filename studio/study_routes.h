#pragma once

#include "studio/http.h"
#include "studio/study_folder.h"

namespace repose::studio {

/// What the page asks of studies and their sheets. What an address gives is said in
/// study_routes.cpp beside it.
void serve_studies(httplib::Server& http, StudyFolder& studies);

}  // namespace repose::studio
