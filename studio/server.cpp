#include "studio/server.h"

#include <atomic>
#include <exception>
#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "base/version.h"
#include "studio/access.h"
#include "studio/answers.h"
#include "studio/calibration_routes.h"
#include "studio/calibrations.h"
#include "studio/film_routes.h"
#include "studio/film_tracks.h"
#include "studio/http.h"
#include "studio/picture_folder.h"
#include "studio/set_comparisons.h"
#include "studio/study_folder.h"
#include "studio/study_routes.h"

namespace repose::studio {

namespace page {

std::string_view embedded_file(std::string_view name);

}  // namespace page

namespace {

using httplib::Request;
using httplib::Response;

constexpr const char* kHost = "127.0.0.1";
constexpr std::size_t kLargestUpload_bytes = std::size_t{128} << 20;

std::string version_in(const Request& request) { return request.get_param_value("version"); }

template <typename Ask>
httplib::Server::Handler text_answer_of(const Ask& ask) {
  return answering([ask](const Request& request, Response& response) {
    response.set_content(ask(request), kJson);
  });
}

void send(Response& response, const PictureFolder::Bytes& bytes, const char* type) {
  response.set_content(reinterpret_cast<const char*>(bytes.data()), bytes.size(), type);
}

}  // namespace

struct Server::Parts {
  explicit Parts(const StudioOptions& options)
      : pictures(options.folder), studies(options.folder), calibrations(studies, options.program) {}

  PictureFolder pictures;
  SetComparisons comparisons{pictures};
  FilmTracks films{pictures};
  StudyFolder studies;
  Calibrations calibrations;
  httplib::Server http;
  std::unique_ptr<Access> access;
  std::string address;
  std::atomic<bool> has_started = false;
  std::atomic<bool> has_ended = false;
  std::atomic<bool> is_to_stop = false;

  void guard();
  void serve_page();
  void serve_pictures();
  void serve_files();
  void serve_comparisons();
};

/// Answers only the page; other sites' pages can neither embed it nor read what it loads.
void Server::Parts::guard() {
  http.set_pre_routing_handler([this](const Request& request, Response& response) {
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("Cache-Control", "no-store");
    response.set_header(
        "Content-Security-Policy",
        "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: "
        "blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'");
    const std::string host = request.get_header_value("Host");
    const std::string origin = request.get_header_value("Origin");
    const std::string token = request.get_param_value("token");
    const std::string cookies = request.get_header_value("Cookie");
    const std::string why =
        access->refusal({.host = host, .origin = origin, .query_token = token, .cookies = cookies});
    if (why.empty()) return httplib::Server::HandlerResponse::Unhandled;
    response.status = 403;
    response.set_content(why + "\n", "text/plain; charset=utf-8");
    return httplib::Server::HandlerResponse::Handled;
  });
  http.set_payload_max_length(kLargestUpload_bytes);
  // A browser keeps up to six connections open per page, each of which occupies a thread.
  http.new_task_queue = [] { return new httplib::ThreadPool(32); };
  http.set_keep_alive_timeout(2);
  http.set_error_handler([](const Request&, Response& response) {
    if (!response.body.empty()) return;
    refuse(response, response.status,
           response.status == 413
               ? fmt::format("it is larger than {} MB. Fix: copy it into the folder.",
                             kLargestUpload_bytes >> 20)
               : fmt::format("there is nothing here ({})", response.status));
  });
  http.set_exception_handler([](const Request&, Response& response, const std::exception_ptr& any) {
    try {
      std::rethrow_exception(any);
    } catch (const std::exception& error) {
      refuse(response, 500, fmt::format("internal error: {}", error.what()));
    } catch (...) {
      refuse(response, 500, "internal error");
    }
  });
}

/// GET /            the page; sets a cookie, so that it can be reloaded
/// GET /studio.js   its script
/// GET /studio.css  its style sheet
void Server::Parts::serve_page() {
  http.Get("/", [this](const Request&, Response& response) {
    response.set_header("Set-Cookie", access->cookie());
    response.set_content(std::string(page::embedded_file("page/index.html")),
                         "text/html; charset=utf-8");
  });
  http.Get("/studio.js", [](const Request&, Response& response) {
    response.set_content(std::string(page::embedded_file("studio.js")),
                         "text/javascript; charset=utf-8");
  });
  http.Get("/studio.css", [](const Request&, Response& response) {
    response.set_content(std::string(page::embedded_file("page/studio.css")),
                         "text/css; charset=utf-8");
  });
}

/// All but the first two with ?file=NAME; answered by PictureFolder:
///
/// GET /api/folder      list()
/// GET /api/set         set()
/// GET /api/measured    measured()
/// POST /api/measure    measured_as() with the body
/// PUT /api/hints       save() with the body; &version=
/// DELETE /api/hints    forget(); &version=
/// POST /api/file       add() the body under that name
void Server::Parts::serve_pictures() {
  http.Get("/api/folder", json_of([this](const Request&) {
             Json json = pictures.list();
             json["program"] = base::kProgram;
             json["largest_upload_bytes"] = kLargestUpload_bytes;
             return json;
           }));
  http.Get("/api/set", text_answer_of([this](const Request&) { return pictures.set(); }));
  http.Get("/api/measured", text_answer_of([this](const Request& request) {
             return pictures.measured(file_in(request));
           }));
  http.Post("/api/measure", json_of([this](const Request& request) {
              return pictures.measured_as(file_in(request), json_in(request));
            }));
  http.Put("/api/hints", text_answer_of([this](const Request& request) {
             return pictures.save(file_in(request), json_in(request), version_in(request));
           }));
  http.Delete("/api/hints", text_answer_of([this](const Request& request) {
                return pictures.forget(file_in(request), version_in(request));
              }));
  http.Post("/api/file", json_of([this](const Request& request) {
              return Json{{"file", pictures.add(file_in(request), request.body)}};
            }));
}

/// GET /api/picture?file=NAME&side=PX&turns=N   picture(), turned by N quarters
/// GET /api/overlay?file=NAME                   overlay()
/// GET /api/mask?file=NAME                      mask()
/// GET /files/angles.csv, /files/angles.xlsx, /files/photos.html    csv(), workbook(), report()
void Server::Parts::serve_files() {
  http.Get("/api/picture", answering([this](const Request& request, Response& response) {
             constexpr int kSmallest_px = 16, kLargest_px = 4096, kUsual_px = 1600;
             const int side_px = number_in(request, "side", kSmallest_px, kLargest_px, kUsual_px);
             const int turn_deg = 90 * number_in(request, "turns", 0, 3, 0);
             send(response, pictures.picture(file_in(request), side_px, turn_deg), "image/jpeg");
           }));
  http.Get("/api/overlay", answering([this](const Request& request, Response& response) {
             send(response, pictures.overlay(file_in(request)), "image/jpeg");
           }));
  http.Get("/api/mask", answering([this](const Request& request, Response& response) {
             send(response, pictures.mask(file_in(request)), "image/png");
           }));
  http.Get("/files/angles.csv", answering([this](const Request&, Response& response) {
             send_file(response, "angles.csv", pictures.csv(), "text/csv; charset=utf-8");
           }));
  http.Get("/files/angles.xlsx", answering([this](const Request&, Response& response) {
             send_file(response, "angles.xlsx", pictures.workbook(),
                       "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet");
           }));
  http.Get("/files/photos.html", answering([this](const Request&, Response& response) {
             send_file(response, "photos.html", pictures.report(), "text/html; charset=utf-8");
           }));
}

/// GET /api/sets                                 folders()
/// POST /api/comparison                          compare() with the body
/// GET /files/comparison.png?number=N&width=PX   figure()
/// GET /files/comparison.json?number=N           json()
void Server::Parts::serve_comparisons() {
  constexpr int kMost = 1 << 30;
  http.Get("/api/sets", json_of([this](const Request&) { return comparisons.folders(); }));
  http.Post("/api/comparison", json_of([this](const Request& request) {
              return comparisons.compare(json_in(request));
            }));
  http.Get("/files/comparison.png", answering([this](const Request& request, Response& response) {
             constexpr int kSmallest_px = 200, kLargest_px = 5600;
             const int width_px =
                 number_in(request, "width", kSmallest_px, kLargest_px, vision::kSetsFigure_px);
             send(response, comparisons.figure(number_in(request, "number", 0, kMost, 0), width_px),
                  "image/png");
           }));
  http.Get("/files/comparison.json", answering([this](const Request& request, Response& response) {
             send_file(response, "comparison.json",
                       comparisons.json(number_in(request, "number", 0, kMost, 0)), kJson);
           }));
}

Server::Server(const StudioOptions& options) : parts_(std::make_unique<Parts>(options)) {
  Parts& parts = *parts_;
  // Not SO_REUSEPORT, the library's default: it would allow binding a port that another studio is
  // using.
  parts.http.set_socket_options([](int socket) {
    const int yes = 1;
    setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  int port = options.port;
  if (port == 0) {
    port = parts.http.bind_to_any_port(kHost);
  } else if (!parts.http.bind_to_port(kHost, port)) {
    port = -1;
  }
  if (port < 0) {
    throw base::InputError({.where = "port",
                            .value = fmt::format("{} cannot be taken", options.port),
                            .fix = "choose another, or leave it out: one that is free is taken."});
  }
  parts.access = std::make_unique<Access>(new_token(), port);
  parts.address = fmt::format("http://{}:{}/?token={}", kHost, port, parts.access->token());
  parts.guard();
  parts.serve_page();
  parts.serve_pictures();
  parts.serve_files();
  serve_films(parts.http, parts.films, parts.studies);
  serve_studies(parts.http, parts.studies);
  serve_calibrations(parts.http, parts.calibrations);
  parts.serve_comparisons();
}

Server::~Server() = default;

const std::string& Server::address() const { return parts_->address; }

void Server::run() {
  parts_->has_started = true;
  if (!parts_->is_to_stop) parts_->http.listen_after_bind();
  parts_->has_ended = true;
}

void Server::stop() {
  parts_->is_to_stop = true;
  if (!parts_->has_started) return;
  // The library ignores a stop before it listens, which run() may be about to do.
  while (!parts_->http.is_running() && !parts_->has_ended) std::this_thread::yield();
  parts_->http.stop();
}

}  // namespace repose::studio
