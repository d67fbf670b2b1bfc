
#include <array>

#include <gmock/gmock.h>

namespace repose::base {
namespace {

using ::testing::SizeIs;

TEST(InputError, SaysWhereWhatRuleAndFix) {
  EXPECT_EQ((Fault{.where = "sheet.csv:3",
                   .subject = "drop_mm",
                   .value = "is -1",
                   .rule = "above 0",
                   .fix = "correct it."})
                .text(),
            "sheet.csv:3: drop_mm is -1. Rule: above 0. Fix: correct it.");
  EXPECT_EQ(
      (Fault{.subject = "margin", .value = "= 50", .rule = "must be below 45", .fix = "2."}).text(),
      "margin = 50 must be below 45. Fix: 2.");
  EXPECT_EQ(
      (Fault{.where = "a.csv", .value = "has no column b. Did you mean B?", .fix = "B."}).text(),
      "a.csv: has no column b. Did you mean B? Fix: B.");
  EXPECT_EQ((Fault{.subject = "young", .value = "is 0", .rule = "above 0"}).text(),
            "young is 0. Rule: above 0.");
  EXPECT_EQ((Fault{.where = "a.toml:1: scale", .rule = "must be a number", .fix = "1."}).text(),
            "a.toml:1: scale: must be a number. Fix: 1.");
  EXPECT_EQ((Fault{.value = "a set has no heap"}).text(), "a set has no heap");
}

TEST(InputError, TellsEveryFaultAtOnceEachWithItsPlace) {
  Faults faults;
  faults.require(true, {.value = "nothing is wrong with this"});
  EXPECT_NO_THROW(faults.throw_if_any());
  faults.require(false, {.subject = "a", .value = "is 1"});
  faults.add({.where = "row 2", .value = "is empty", .fix = "delete it."});
  try {
    faults.throw_if_any();
    FAIL() << "there are two faults";
  } catch (const InputError& error) {
    EXPECT_THAT(error.faults(), SizeIs(2));
    EXPECT_EQ(error.faults()[0].subject, "a");
    EXPECT_STREQ(error.in("t.csv").what(),
                 "t.csv: a is 1\nt.csv: row 2: is empty. Fix: delete it.");
  }
}

TEST(InputError, CountsFaultsBeyondThoseThatAreListed) {
  Faults faults(2);
  for (int k = 0; k < 5; ++k) faults.add({.value = std::to_string(k)});
  const std::vector<Fault> all = faults.all();
  ASSERT_THAT(all, SizeIs(3));
  EXPECT_EQ(all[2].text(),
            "and 3 more of this kind, which are not listed. Fix: correct these first.");
}

TEST(InputError, FieldsBecomeOptionsByTheirTableAlone) {
  constexpr std::array<FieldName, 2> kNames{{{"budget", "--budget"}, {"linear model", "--model"}}};
  const InputError error({.subject = "budget",
                          .value = "= 0 is no budget",
                          .fix = "a budget, or the " + field("linear model") + '.'});
  EXPECT_STREQ(error.what(), "budget = 0 is no budget. Fix: a budget, or the linear model.");
  EXPECT_EQ(text_of(error.faults(), kNames),
            "budget (--budget) = 0 is no budget. Fix: a budget, or the linear model (--model).");
  EXPECT_EQ((Fault{.subject = "budget_s", .value = "is 0"}).text(kNames), "budget_s is 0");
  EXPECT_EQ(with_names(field("its unit") + '.', kNames), "its unit.");
}

}  // namespace
}  // namespace repose::base
