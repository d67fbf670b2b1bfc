#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/input_error.h"
#include "studio/http.h"
#include "studio/json_answer.h"

/// Helpers for reading and answering any request.
namespace repose::studio {

inline void refuse(httplib::Response& response, int status, const std::string& why) {
  response.status = status;
  response.set_content(text_of({{"error", why}}), kJson);
}

/// The file that a request names; the caller checks it.
inline std::string file_in(const httplib::Request& request) {
  return request.get_param_value("file");
}

inline int number_in(const httplib::Request& request, const char* name, int from, int to,
                     int otherwise) {
  if (!request.has_param(name)) return otherwise;
  const std::string text = request.get_param_value(name);
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < from || number > to) {
    throw base::InputError({.where = name,
                            .value = "is " + text,
                            .rule = fmt::format("a whole number from {} to {}", from, to)});
  }
  return number;
}

inline Json json_in(const httplib::Request& request) {
  Json json = Json::parse(request.body, nullptr, false);
  if (json.is_discarded()) throw base::InputError({.value = "what was sent is no JSON"});
  return json;
}

/// Errors in the request become its answer.
template <typename Answer>
httplib::Server::Handler answering(const Answer& answer) {
  return [answer](const httplib::Request& request, httplib::Response& response) {
    try {
      answer(request, response);
    } catch (const ChangedMeanwhile& error) {
      refuse(response, 409, error.what());
    } catch (const base::InputError& error) {
      refuse(response, 400, base::with_names(error.what()));
    }
  };
}

template <typename Ask>
httplib::Server::Handler json_of(const Ask& ask) {
  return answering([ask](const httplib::Request& request, httplib::Response& response) {
    response.set_content(text_of(ask(request)), kJson);
  });
}

inline void send_file(httplib::Response& response, const std::string& name,
                      const std::string& content, const char* type) {
  response.set_header("Content-Disposition", fmt::format("attachment; filename=\"{}\"", name));
  response.set_content(content, type);
}

}  // namespace repose::studio
