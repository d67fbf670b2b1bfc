#include "studio/film_routes.h"

#include <string>

#include "studio/answers.h"

namespace repose::studio {
namespace {

using httplib::Request;
using httplib::Response;

constexpr int kMostNumber = 1 << 30;

int film_number_in(const Request& request) {
  return number_in(request, "number", 0, kMostNumber, 0);
}

void send_jpeg(Response& response, const FilmTracks::Bytes& bytes) {
  response.set_content(reinterpret_cast<const char*>(bytes.data()), bytes.size(), "image/jpeg");
}

}  // namespace

/// Answered by FilmTracks, the last one by StudyFolder:
///
/// GET /api/film?file=NAME                        film()
/// GET /api/film/frame?file=NAME&number=N         frame()
/// POST /api/film/track?file=NAME                 track() with the body
/// GET /api/film/overlay?number=N                 overlay()
/// POST /api/film/readings?number=N&study=NAME    add_readings() of readings() with the body
void serve_films(httplib::Server& http, FilmTracks& films, StudyFolder& studies) {
  http.Get("/api/film",
           json_of([&](const Request& request) { return films.film(file_in(request)); }));
  http.Get("/api/film/frame", answering([&](const Request& request, Response& response) {
             send_jpeg(response, films.frame(file_in(request), film_number_in(request)));
           }));
  http.Post("/api/film/track", json_of([&](const Request& request) {
              return films.track(file_in(request), json_in(request));
            }));
  http.Get("/api/film/overlay", answering([&](const Request& request, Response& response) {
             send_jpeg(response, films.overlay(film_number_in(request)));
           }));
  http.Post("/api/film/readings", json_of([&](const Request& request) {
              const auto readings = films.readings(film_number_in(request), json_in(request));
              return studies.add_readings(request.get_param_value("study"), readings.experiment,
                                          readings.csv);
            }));
}

}  // namespace repose::studio
