#include "studio/calibration_routes.h"

#include <filesystem>
#include <string>

#include "studio/answers.h"

namespace repose::studio {
namespace {

using httplib::Request;
using httplib::Response;

std::string value_in(const Request& request, const char* name) {
  return request.get_param_value(name);
}

/// The report contains its own scripts; it may display itself and offer its figures for download,
/// but make no requests: it cannot use the page's token.
constexpr const char* kReportRules =
    "sandbox allow-scripts allow-downloads; default-src 'none'; script-src 'unsafe-inline'; "
    "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

void send_report(Response& response, const std::string& html) {
  response.headers.erase("Content-Security-Policy");
  response.set_header("Content-Security-Policy", kReportRules);
  response.set_content(html, "text/html; charset=utf-8");
}

}  // namespace

/// All but the first with study=NAME; answered by Calibrations:
///
/// GET /api/tasks                             tasks()
/// POST, DELETE /api/tasks?task=NAME          start() with amount=TEXT, stop()
/// GET /api/calibration                       state()
/// POST /api/export?to=NAME&approximate=1     exported()
/// GET /files/report                          report()
/// GET /files/calibration?name=NAME           file() as a download
void serve_calibrations(httplib::Server& http, Calibrations& calibrations) {
  http.Get("/api/tasks", json_of([&](const Request&) { return calibrations.tasks(); }));
  http.Post("/api/tasks", json_of([&](const Request& request) {
              calibrations.start(value_in(request, "study"), value_in(request, "task"),
                                 value_in(request, "amount"));
              return calibrations.tasks();
            }));
  http.Delete("/api/tasks", json_of([&](const Request& request) {
                calibrations.stop(value_in(request, "study"), value_in(request, "task"));
                return calibrations.tasks();
              }));
  http.Get("/api/calibration", json_of([&](const Request& request) {
             return calibrations.state(value_in(request, "study"));
           }));
  http.Post("/api/export", json_of([&](const Request& request) {
              return calibrations.exported(value_in(request, "study"), value_in(request, "to"),
                                           value_in(request, "approximate") == "1");
            }));
  http.Get("/files/report", answering([&](const Request& request, Response& response) {
             send_report(response, calibrations.report(value_in(request, "study")));
           }));
  http.Get("/files/calibration", answering([&](const Request& request, Response& response) {
             const std::string name = value_in(request, "name");
             send_file(response, std::filesystem::path(name).filename().string(),
                       calibrations.file(value_in(request, "study"), name),
                       "application/octet-stream");
           }));
}

}  // namespace repose::studio
