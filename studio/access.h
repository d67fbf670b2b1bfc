#pragma once

#include <string>
#include <string_view>

/// Who may talk to the studio: the person who started it, from a page of its own.
namespace repose::studio {

/// 128 random bits of the system's, as hexadecimal digits. Whoever has it may do all that the page
/// can do.
/// @throws std::system_error  the system has none.
std::string new_token();

/// What a request says of where it comes from; empty: it does not say.
struct Caller {
  std::string_view host;    ///< the address it was sent to
  std::string_view origin;  ///< the page that sent it
  std::string_view query_token;
  std::string_view cookies;
};

/// Whether a request is taken, and if not, why.
///
/// The server listens to this machine alone; what is left are pages of others in the same browser.
/// A name of theirs that they let lead to this machine (DNS rebinding) is refused by `host`, their
/// forms and scripts by `origin` (RFC 6454), all else by the token, which they do not know. It is
/// compared in a time that does not depend on how much of it is right.
/// Proved by Access.* in tests/studio/access_test.cpp.
class Access {
 public:
  Access(std::string token, int port);

  /// Empty: it is taken.
  std::string refusal(const Caller& caller) const;
  /// Of a cookie that lets the browser show the page's pictures; one for each port, for cookies
  /// know no ports.
  std::string cookie() const;
  const std::string& token() const { return token_; }

 private:
  std::string token_;
  std::string cookie_name_;
  std::string hosts_[2];
  std::string origins_[2];
};

}  // namespace repose::studio
