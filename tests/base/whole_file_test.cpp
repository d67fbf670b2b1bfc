#include "base/whole_file.h"

#include <filesystem>
#include <stdexcept>

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace repose::base {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

TEST(WholeFile, ReplacesTheOldContentAndLeavesNothingElse) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("table.csv", std::string("a much longer old content"));
  write_whole_file(file, "new");
  EXPECT_EQ(testing::text_of(file), "new");
  EXPECT_THAT(folder.names(), ElementsAre("table.csv"));
}

TEST(WholeFile, IsReadToItsLastByte) {
  const testing::TemporaryFolder folder;
  const std::string content("a\0b\r\n", 5);
  EXPECT_EQ(read_whole_file(folder.write("data", content)), content);
}

TEST(WholeFile, MissingFilesAndFoldersAreRefused) {
  const testing::TemporaryFolder folder;
  const auto missing = folder.path() / "missing";
  EXPECT_EQ(read_file_if_there(missing), std::nullopt);
  EXPECT_THAT([&] { read_whole_file(missing); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("missing: there is no such file"), HasSubstr("Fix: "))));
  EXPECT_THAT([&] { read_file_if_there(folder.path()); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("is a folder")));
}

TEST(WholeFile, PipesAndDevicesAreRefusedWithoutWaiting) {
  const testing::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT([&] { read_whole_file(pipe); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("pipe: is a pipe, not a file"), HasSubstr("Fix: "))));
  EXPECT_THAT([] { read_whole_file("/dev/zero"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("/dev/zero: is a device")));
}

TEST(WholeFile, WhatIsTooLargeIsRefusedBeforeItIsRead) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("hole", std::string());
  std::filesystem::resize_file(file, std::uintmax_t{100} << 30);
  EXPECT_THAT([&] { read_whole_file(file); },
              ThrowsMessage<std::invalid_argument>(AllOf(
                  HasSubstr("has 102400.0 MiB. Rule: at most 1024 MiB"), HasSubstr("Fix: "))));
  EXPECT_THROW(read_whole_file(folder.write("four", std::string("four")), 3),
               std::invalid_argument);
  EXPECT_EQ(read_whole_file(folder.path() / "four", 4), "four");
}

TEST(WholeFile, AFullDiskIsSaidAndTheDeviceStays) {
  EXPECT_THAT([] { write_whole_file("/dev/full", "text"); },
              ThrowsMessage<std::invalid_argument>(
                  AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"), HasSubstr("Fix: "))));
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/full"));
}

TEST(WholeFile, CheckingLeavesNothingBehind) {
  const testing::TemporaryFolder folder;
  check_can_write(folder.path() / "table.csv");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WholeFile, CheckingFindsAMissingFolder) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(check_can_write(folder.path() / "no" / "table.csv"), std::invalid_argument);
}

TEST(WholeFile, CheckingFindsALockedFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const testing::TemporaryFolder folder;
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THROW(check_can_write(folder.path() / "table.csv"), std::invalid_argument);
}

}  // namespace
}  // namespace repose::base
