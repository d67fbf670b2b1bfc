#include "studio/study_routes.h"

#include <string>

#include "studio/answers.h"

namespace repose::studio {
namespace {

std::string study_in(const httplib::Request& request) { return request.get_param_value("study"); }

std::string experiment_in(const httplib::Request& request) {
  return request.get_param_value("experiment");
}

}  // namespace

/// Answered by StudyFolder:
///
/// GET /api/studies                    list()
/// POST /api/studies                   start_study() with the body
/// GET /api/new                        new_study_form()
/// POST /api/new                       drafted_study() with the body
/// GET /api/study?study=NAME           study()
/// POST, PUT /api/sheet?study=NAME&experiment=NAME   checked_sheet(), save_sheet() with the body
/// POST, PUT /api/numbers?study=NAME   checked_numbers(), save_numbers() with the body
void serve_studies(httplib::Server& http, StudyFolder& studies) {
  using httplib::Request;
  http.Get("/api/studies", json_of([&studies](const Request&) { return studies.list(); }));
  http.Post("/api/studies", json_of([&studies](const Request& request) {
              return start_study(studies.folder(), json_in(request));
            }));
  http.Get("/api/new", json_of([](const Request&) { return new_study_form(); }));
  http.Post("/api/new", json_of([&studies](const Request& request) {
              return drafted_study(studies.folder(), json_in(request));
            }));
  http.Get("/api/study", json_of([&studies](const Request& request) {
             return studies.study(study_in(request));
           }));
  http.Post("/api/sheet", json_of([&studies](const Request& request) {
              return studies.checked_sheet(study_in(request), experiment_in(request),
                                           json_in(request));
            }));
  http.Put("/api/sheet", json_of([&studies](const Request& request) {
             return studies.save_sheet(study_in(request), experiment_in(request), json_in(request));
           }));
  http.Post("/api/numbers", json_of([&studies](const Request& request) {
              return studies.checked_numbers(study_in(request), json_in(request));
            }));
  http.Put("/api/numbers", json_of([&studies](const Request& request) {
             return studies.save_numbers(study_in(request), json_in(request));
           }));
}

}  // namespace repose::studio
