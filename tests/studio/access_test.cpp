// Only the page of the person who started the studio gets answers.
#include "studio/access.h"

#include <set>
#include <string>

#include <gmock/gmock.h>

namespace repose::studio {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

std::string refusal(const Caller& caller) { return Access(kToken, 8080).refusal(caller); }

TEST(Access, TakesItsOwnPageByTokenOrCookie) {
  for (const char* host : {"127.0.0.1:8080", "localhost:8080"}) {
    EXPECT_THAT(refusal({.host = host, .origin = {}, .query_token = kToken, .cookies = {}}),
                IsEmpty());
    const std::string origin = std::string("http://") + host;
    const std::string cookies = std::string("a=b; repose_8080=") + kToken + "; c=d";
    EXPECT_THAT(refusal({.host = host, .origin = origin, .query_token = {}, .cookies = cookies}),
                IsEmpty());
  }
}

TEST(Access, RefusesWhoDoesNotKnowTheToken) {
  const std::string with_more = std::string(kToken) + "0";
  for (const std::string& token : {std::string(), std::string("0"), with_more,
                                   std::string("0123456789abcdef0123456789abcdeF")}) {
    EXPECT_THAT(
        refusal({.host = "127.0.0.1:8080", .origin = {}, .query_token = token, .cookies = {}}),
        HasSubstr("token"));
    const std::string cookie = "repose_8080=" + token;
    EXPECT_THAT(
        refusal({.host = "127.0.0.1:8080", .origin = {}, .query_token = {}, .cookies = cookie}),
        HasSubstr("token"));
  }
  // The cookie of another studio, on another port.
  const std::string other = std::string("repose_8081=") + kToken;
  EXPECT_THAT(
      refusal({.host = "127.0.0.1:8080", .origin = {}, .query_token = {}, .cookies = other}),
      HasSubstr("token"));
}

TEST(Access, RefusesOtherNamesOfThisMachine) {
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:8081", "evil.example:8080",
                           "127.0.0.1:80800", "127.0.0.1.evil.example:8080"}) {
    EXPECT_THAT(refusal({.host = host, .origin = {}, .query_token = kToken, .cookies = {}}),
                HasSubstr("http://127.0.0.1:8080"))
        << host;
  }
}

TEST(Access, RefusesWhatOtherPagesSend) {
  for (const char* origin : {"null", "http://evil.example", "https://127.0.0.1:8080",
                             "http://127.0.0.1:8081", "http://127.0.0.1"}) {
    EXPECT_THAT(
        refusal({.host = "127.0.0.1:8080", .origin = origin, .query_token = kToken, .cookies = {}}),
        HasSubstr("Another page"))
        << origin;
  }
}

TEST(Access, ItsCookieIsForItsPortAndNoScriptOrOtherPageHasIt) {
  EXPECT_EQ(Access(kToken, 8080).cookie(),
            std::string("repose_8080=") + kToken + "; Path=/; HttpOnly; SameSite=Strict");
}

TEST(Access, TokensAreLongAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int k = 0; k < 100; ++k) tokens.insert(new_token());
  EXPECT_EQ(tokens.size(), 100U);
  for (const std::string& token : tokens) {
    EXPECT_EQ(token.size(), 32U);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  }
}

}  // namespace
}  // namespace repose::studio
