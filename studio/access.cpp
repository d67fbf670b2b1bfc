#include "studio/access.h"

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <sys/random.h>

namespace repose::studio {
namespace {

bool is_same(std::string_view one, std::string_view other) {
  if (one.size() != other.size()) return false;
  unsigned difference = 0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    difference |= static_cast<unsigned char>(one[k]) ^ static_cast<unsigned char>(other[k]);
  }
  return difference == 0;
}

/// The value of a cookie in "a=1; b=2"; empty if absent.
std::string_view cookie_in(std::string_view cookies, std::string_view name) {
  while (!cookies.empty()) {
    const std::size_t end = cookies.find(';');
    std::string_view one = cookies.substr(0, end);
    cookies.remove_prefix(end == std::string_view::npos ? cookies.size() : end + 1);
    one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
    const std::size_t equals = one.find('=');
    if (equals != std::string_view::npos && one.substr(0, equals) == name) {
      return one.substr(equals + 1);
    }
  }
  return {};
}

}  // namespace

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::system_error(errno, std::generic_category(), "no random numbers");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

Access::Access(std::string token, int port)
    : token_(std::move(token)),
      cookie_name_(fmt::format("repose_{}", port)),
      hosts_{fmt::format("127.0.0.1:{}", port), fmt::format("localhost:{}", port)},
      origins_{"http://" + hosts_[0], "http://" + hosts_[1]} {}

std::string Access::refusal(const Caller& caller) const {
  if (caller.host != hosts_[0] && caller.host != hosts_[1]) {
    return fmt::format("This is repose studio, which answers at http://{} alone.", hosts_[0]);
  }
  if (!caller.origin.empty() && caller.origin != origins_[0] && caller.origin != origins_[1]) {
    return "Another page has sent this: the studio takes nothing from it.";
  }
  if (is_same(caller.query_token, token_) ||
      is_same(cookie_in(caller.cookies, cookie_name_), token_)) {
    return {};
  }
  return "The token is missing or wrong. Fix: open the whole address that repose studio has "
         "printed, "
         "with all that follows the question mark.";
}

std::string Access::cookie() const {
  return fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict", cookie_name_, token_);
}

}  // namespace repose::studio
