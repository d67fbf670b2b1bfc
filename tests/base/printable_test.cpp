#include <gmock/gmock.h>

#include "base/text.h"

namespace repose::base {
namespace {

TEST(Printable, LettersOfAllScriptsLinesAndTabsStay) {
  const std::string text = "Häufchen, 堆, 🌰\n\t23.4° ± 0.5";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, WhatControlsATerminalIsSpeltOut) {
  EXPECT_EQ(printable("a\033[31mb\r\x7F"), "a\\x1B[31mb\\x0D\\x7F");
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m"),
            "\\xC2\\x9B"
            "31m")
      << "the same as ESC [, in one letter";
  EXPECT_EQ(printable("\xE2\x80\xAEgnp"), "\\xE2\\x80\\xAEgnp") << "turns what follows around";
}

TEST(Printable, BytesThatAreNoTextAreSpeltOut) {
  EXPECT_EQ(printable("a\xFF\x80z\xC3"), "a\\xFF\\x80z\\xC3");
  EXPECT_EQ(printable("\xC3"
                      "b"),
            "\\xC3"
            "b");
}

}  // namespace
}  // namespace repose::base
