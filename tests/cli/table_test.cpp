#include "cli/common/table.h"

#include <gmock/gmock.h>

namespace repose::cli {
namespace {

TEST(Table, ColumnsAreAsWideAsTheirWidestCell) {
  Table table({{.heading = "name"}, {.heading = "angle [°]", .align = Align::right}, {}});
  table.add_row({"a", "23.4", "ok"});
  table.add_row({"a longer one", "–"});
  EXPECT_EQ(table.text(80),
            "name          angle [°]\n"
            "a                  23.4  ok\n"
            "a longer one          –\n");
}

TEST(Table, ColoursTakeNoRoom) {
  Table table({{.heading = ""}, {.heading = "", .align = Align::right}});
  table.add_row({"1", "ok"}, Colour::green);
  table.add_row({"2", "refused"});
  EXPECT_EQ(table.text(80), "1  \033[32m     ok\033[0m\n2  refused\n");
}

TEST(Table, NothingInItControlsTheTerminal) {
  Table table({{.heading = "a\033[2J"}, {.heading = "b"}});
  table.add_row({"name\033]0;x\007", "\033[31mred"});
  table.add_note("! ", "note\rover");
  const std::string text = table.text(80) + paragraph("", "said\033c", 80);
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\033")));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\r")));
  EXPECT_THAT(text, testing::HasSubstr("\\x1B[31mred"));
}

TEST(Table, NamesThatDoNotFitHaveALineOfTheirOwn) {
  Table table({{.heading = "picture"}, {.heading = "angle", .align = Align::right}});
  const std::string name(40, 'x');
  table.add_row({name, "23.4"});
  table.add_row({"heap.png", "21.9"});
  EXPECT_EQ(table.text(40),
            "picture   angle\n" + name + "\n" + std::string(11, ' ') + "23.4\nheap.png   21.9\n");
}

TEST(Table, TheLastColumnIsWrappedAndNotesStandBelowTheirRow) {
  Table table({{.heading = ""}, {.heading = ""}});
  table.add_row({"contact model", "Hertz and Mindlin without slip at first"});
  table.add_note("  ! ", "of a kind that needs more than one line");
  EXPECT_EQ(table.text(40),
            "contact model  Hertz and Mindlin without\n"
            "               slip at first\n"
            "  ! of a kind that needs more than one\n"
            "    line\n");
}

}  // namespace
}  // namespace repose::cli
