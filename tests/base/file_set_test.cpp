#include "base/file_set.h"

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"

namespace repose::base {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

class FileSet : public ::testing::Test {
 protected:
  void write(const std::vector<NamedText>& files, Unlisted unlisted = Unlisted::users) const {
    write_file_set(folder_.path(), files, unlisted);
  }
  std::string text(const char* name) const { return testing::text_of(folder_.path() / name); }

  testing::TemporaryFolder folder_;
};

TEST_F(FileSet, WhatIsNotWrittenAnyMoreGoesAway) {
  write({{"a.py", "first"}, {"b.py", "first"}});
  folder_.write("users.py", std::string("mine"));
  write({{"a.py", "second"}, {"c.py", "second"}});
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("a.py", "c.py", "users.py", ".repose-files"));
  EXPECT_EQ(text("a.py"), "second");
}

TEST_F(FileSet, FilesOfTheUsersAreNotReplaced) {
  folder_.write("a.py", std::string("mine"));
  folder_.write("b.py", std::string("mine too"));
  EXPECT_THAT(
      [&] {
        write({{"a.py", "ours"}, {"b.py", "ours"}, {"c.py", "ours"}});
      },
      ThrowsMessage<base::InputError>(AllOf(HasSubstr("a.py, b.py"), HasSubstr("Fix: "))));
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("a.py", "b.py"));
  EXPECT_EQ(text("a.py"), "mine");
  write({{"a.py", "ours"}, {"b.py", "ours"}}, Unlisted::ours);
  EXPECT_EQ(text("b.py"), "ours");
}

TEST_F(FileSet, WhatAUserHasChangedStays) {
  write({{"a.py", "first"}, {"b.py", "first"}});
  folder_.write("b.py", std::string("first, changed"));
  EXPECT_THAT(
      [&] {
        write({{"a.py", "second"}, {"b.py", "second"}}, Unlisted::ours);
      },
      ThrowsMessage<base::InputError>(AllOf(HasSubstr("b.py"), Not(HasSubstr("a.py")))));
  EXPECT_EQ(text("a.py"), "first");
  write({{"a.py", "second"}});
  EXPECT_EQ(text("b.py"), "first, changed");
}

TEST_F(FileSet, AnInterruptedWritingCanBeRepeated) {
  write({{"a.py", "first"}});
  const std::string first = text(".repose-files");
  write({{"a.py", "second"}});
  // Killed before the file was replaced: the list already contains both.
  folder_.write(".repose-files", first + text(".repose-files"));
  folder_.write("a.py", std::string("first"));
  write({{"a.py", "third"}});
  EXPECT_EQ(text("a.py"), "third");
}

}  // namespace
}  // namespace repose::base
