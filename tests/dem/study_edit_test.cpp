// Numbers of a study changed in its text, and nothing else of it.
#include "dem/study/study_edit.h"

#include <gmock/gmock.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr const char* kText =
    "# Peas é on wood\n"
    "[experiment.drop]\n"
    "height_mm = 500  # 500 mm above the plate\n"
    "grains = 3\n"
    "\n"
    "[experiment.heap] # poured\n"
    "tube_height_mm = 1.5e2\n"
    "measured = { readings = \"500.csv\" }\n";

std::string edited(const NumberEdit& edit) { return with_numbers(kText, {edit}); }

TEST(StudyEdit, ANumberIsReplacedAndItsCommentStays) {
  EXPECT_THAT(edited({"experiment.drop", "height_mm", "250.5"}),
              HasSubstr("\nheight_mm = 250.5  # 500 mm above the plate\ngrains = 3\n"));
  EXPECT_THAT(edited({"experiment.heap", "tube_height_mm", "140"}),
              HasSubstr("tube_height_mm = 140\nmeasured"));
}

TEST(StudyEdit, ANewKeyComesBelowTheHeadingOfItsTable) {
  EXPECT_THAT(edited({"experiment.heap", "grains", "400"}),
              HasSubstr("[experiment.heap] # poured\ngrains = 400\ntube_height_mm = 1.5e2\n"));
  EXPECT_EQ(with_numbers("[a]", {{"a", "b", "1"}}), "[a]\nb = 1\n");
}

TEST(StudyEdit, ANumberOfAnInlineTableIsReplacedWhereItStands) {
  const std::string text =
      "[contact.wall]\n# min = 1\nrest = { value = 0.2,min=0.2, max = 0.2 }  # min = 0.2\n";
  const auto with = [&](const char* key, const char* number) {
    return with_numbers(text, {{"contact.wall.rest", key, number}});
  };
  EXPECT_THAT(with("min", "0.1"), HasSubstr("{ value = 0.2,min=0.1, max = 0.2 }  # min = 0.2\n"));
  EXPECT_THAT(with("max", "0.75"), HasSubstr("{ value = 0.2,min=0.2, max = 0.75 }"));
  EXPECT_THAT(with("value", "0.5"), HasSubstr("{ value = 0.5,min=0.2"));
  EXPECT_THROW(with("min", ""), base::InputError);
  EXPECT_THROW(with("step", "1"), base::InputError);
}

TEST(StudyEdit, AnEmptyNumberTakesTheLineOut) {
  EXPECT_THAT(edited({"experiment.drop", "grains", ""}),
              HasSubstr("the plate\n\n[experiment.heap]"));
  EXPECT_EQ(edited({"experiment.drop", "radius_mm", ""}), kText);
}

TEST(StudyEdit, SeveralAreMadeOneAfterTheOther) {
  const std::string text = with_numbers(
      kText, {{"experiment.drop", "grains", ""}, {"experiment.heap", "tube_height_mm", "1"}});
  EXPECT_THAT(text, HasSubstr("the plate\n\n[experiment.heap] # poured\ntube_height_mm = 1\n"));
}

TEST(StudyEdit, WhatIsNoNumberInALineOfItsOwnIsRefused) {
  EXPECT_THAT(
      [] {
        edited({"experiment.roll", "x_mm", "1"});
      },
      ThrowsMessage<base::InputError>(HasSubstr("there is no [experiment.roll]")));
  EXPECT_THAT(
      [] {
        edited({"experiment.heap", "measured", "1"});
      },
      ThrowsMessage<base::InputError>(HasSubstr("with a text editor")));
  EXPECT_THROW(with_numbers("[a\nb = 1", {{"a", "b", "2"}}), base::InputError);
  EXPECT_THROW(with_numbers("a.b = 1\n", {{"a", "c", "2"}}), base::InputError);
}

}  // namespace
}  // namespace repose::dem
