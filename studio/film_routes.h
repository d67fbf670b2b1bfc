#pragma once

#include "studio/film_tracks.h"
#include "studio/http.h"
#include "studio/study_folder.h"

namespace repose::studio {

/// What the page asks of films. What an address gives is said in film_routes.cpp beside it.
void serve_films(httplib::Server& http, FilmTracks& films, StudyFolder& studies);

}  // namespace repose::studio
