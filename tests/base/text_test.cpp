#include "base/text.h"

#include <gmock/gmock.h>

namespace repose::base {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Text, LettersAreNotBytes) { EXPECT_EQ(letters("23° ± 1 …"), 9U); }

TEST(Text, WhatIsNoUtf8BecomesTheLetterForIt) {
  EXPECT_TRUE(is_utf8("23° ± 1 …"));
  EXPECT_FALSE(
      is_utf8("Gr\xF6\xDF"
              "e"));
  EXPECT_EQ(as_utf8("Gr\xF6\xDF"
                    "e"),
            "Gr\uFFFD\uFFFDe");
  EXPECT_EQ(as_utf8("23° ± 1 …"), "23° ± 1 …");
}

TEST(Text, LinesBreakAtBlanksAndLongWordsStayWhole) {
  EXPECT_THAT(wrapped("one two three_is_too_long four", 8),
              ElementsAre("one two", "three_is_too_long", "four"));
}

TEST(Text, OwnLineBreaksStay) {
  EXPECT_THAT(wrapped("one\n\ntwo", 80), ElementsAre("one", "", "two"));
  EXPECT_THAT(wrapped("", 80), IsEmpty());
}

TEST(Text, AnythingMayDecideWhatFits) {
  const auto two_words = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ' ') < 2;
  };
  EXPECT_THAT(wrapped("a b c d e", two_words), ElementsAre("a b", "c d", "e"));
}

}  // namespace
}  // namespace repose::base
