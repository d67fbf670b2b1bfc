#pragma once

#include "studio/film_tracks.h"
#include "studio/http.h"
#include "studio/study_folder.h"

namespace repose::studio {

/// The page's requests about films. Routes are documented in film_routes.cpp.
void serve_films(httplib::Server& http, FilmTracks& films, StudyFolder& studies);

}  // namespace repose::studio
