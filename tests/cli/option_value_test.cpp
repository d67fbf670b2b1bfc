#include "cli/common/option_value.h"

#include <array>
#include <numbers>

#include <gmock/gmock.h>

namespace repose::cli {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class OptionValue : public ::testing::Test {
 protected:
  OptionText typed(const std::string& text) { return {"--option", text_ = text, errors_}; }

  std::string text_;
  std::vector<std::string> errors_;
};

TEST_F(OptionValue, NothingTypedIsNoError) {
  EXPECT_EQ(read_number(typed(""), "a number", "1"), std::nullopt);
  EXPECT_EQ(read_box(typed("")), std::nullopt);
  EXPECT_EQ(read_word(typed(""), {"a"}), std::nullopt);
  EXPECT_THAT(errors_, IsEmpty());
}

TEST_F(OptionValue, RightValuesAreRead) {
  EXPECT_EQ(read_whole_number(typed("7"), 1, 7, ""), 7);
  EXPECT_DOUBLE_EQ(read_angle(typed("-90"), "").value(), -std::numbers::pi / 2);
  EXPECT_EQ(read_box(typed("1,2,3,4")), (std::array{1, 2, 3, 4}));
  EXPECT_THAT(numbers_in("1,2.5,-3").value(), ElementsAre(1, 2.5, -3));
  EXPECT_EQ(read_word(typed("b"), {"a", "b"}), 1U);
  EXPECT_EQ(read_ending(typed("picture.JPG"), {".png", ".jpg"}), 1U);
  EXPECT_THAT(errors_, IsEmpty());
}

TEST_F(OptionValue, WrongValuesAreErrorsThatNameTheOptionAndTheFix) {
  read_whole_number(typed("8"), 1, 7, "use 7");
  read_positive(typed("0"), "a number of mm", "use 7");
  read_number(typed("1e999"), "a number", "use 7");
  read_range(typed("1,2,3"), "use 7");
  read_size(typed("1.5,2"));
  read_seed(typed("-1"));
  read_word(typed("silhuette"), {"silhouette", "photo"});
  read_ending(typed("picture.txt"), {".png", ".jpg"});
  EXPECT_THAT(errors_, SizeIs(8));
  EXPECT_THAT(errors_, Each(HasSubstr("--option ")));
  EXPECT_THAT(errors_, Each(HasSubstr(" Fix: ")));
  EXPECT_EQ(errors_.front(), "--option 8: must be a whole number from 1 to 7. Fix: use 7.");
  EXPECT_EQ(errors_[6],
            "--option silhuette: unknown. Did you mean silhouette? Fix: silhouette or photo.");
}

}  // namespace
}  // namespace repose::cli
