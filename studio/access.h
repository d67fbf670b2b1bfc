#pragma once

#include <string>
#include <string_view>

/// Access control: only the user who started the studio, from its own page.
namespace repose::studio {

/// 128 random bits from the system as hexadecimal digits. Whoever has them can do everything the
/// page can.
/// @throws std::system_error  the system provides none.
std::string new_token();

/// Where a request claims to come from; empty if not given.
struct Caller {
  std::string_view host;    ///< the address it was sent to
  std::string_view origin;  ///< origin of the page that sent it
  std::string_view query_token;
  std::string_view cookies;
};

/// Decides whether a request is accepted, and if not, why.
///
/// The server listens on this machine only, which leaves other sites' pages in the same browser.
/// Host names that they point at this machine (DNS rebinding) are refused by `host`, their forms
/// and scripts by `origin` (RFC 6454), everything else by the token, which they do not know. The
/// token is compared in constant time. Proved by Access.* in tests/studio/access_test.cpp.
class Access {
 public:
  Access(std::string token, int port);

  /// The reason for refusal; empty if accepted.
  std::string refusal(const Caller& caller) const;
  /// Set-Cookie value that lets the browser load the page's pictures; one name per port, since
  /// cookies are not separated by port.
  std::string cookie() const;
  const std::string& token() const { return token_; }

 private:
  std::string token_;
  std::string cookie_name_;
  std::string hosts_[2];
  std::string origins_[2];
};

}  // namespace repose::studio
