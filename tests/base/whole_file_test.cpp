#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "tests/support/temporary_folder.h"

namespace {

/// The file that is read whenever something is flushed to disk.
std::filesystem::path watched;                  // NOLINT(cert-err58-cpp)
std::vector<std::string> content_when_flushed;  // NOLINT(cert-err58-cpp)

}  // namespace

/// Overrides that of the C library.
// NOLINTNEXTLINE(readability-inconsistent-declaration-parameter-name): theirs is reserved
extern "C" int fsync(int descriptor) {
  if (!watched.empty()) content_when_flushed.push_back(repose::testing::text_of(watched));
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

namespace repose::base {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
using ::testing::UnorderedElementsAre;

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
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("missing: there is no such file"), HasSubstr("Fix: "))));
  EXPECT_THAT([&] { read_file_if_there(folder.path()); },
              ThrowsMessage<base::InputError>(HasSubstr("is a folder")));
}

TEST(WholeFile, PipesAndDevicesAreRefusedWithoutWaiting) {
  const testing::TemporaryFolder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT([&] { read_whole_file(pipe); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("pipe: is a pipe, not a file"), HasSubstr("Fix: "))));
  EXPECT_THAT([] { read_whole_file("/dev/zero"); },
              ThrowsMessage<base::InputError>(HasSubstr("/dev/zero: is a device")));
}

TEST(WholeFile, WhatIsTooLargeIsRefusedBeforeItIsRead) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("hole", std::string());
  std::filesystem::resize_file(file, std::uintmax_t{100} << 30);
  EXPECT_THAT([&] { read_whole_file(file); },
              ThrowsMessage<base::InputError>(AllOf(
                  HasSubstr("has 102400.0 MiB. Rule: at most 1024 MiB"), HasSubstr("Fix: "))));
  EXPECT_THROW(read_whole_file(folder.write("four", std::string("four")), 3), base::InputError);
  EXPECT_EQ(read_whole_file(folder.path() / "four", 4), "four");
}

TEST(WholeFile, AFullDiskIsSaidAndTheDeviceStays) {
  EXPECT_THAT([] { write_whole_file("/dev/full", "text"); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("/dev/full"), HasSubstr("No space left"), HasSubstr("Fix: "))));
  EXPECT_FALSE(std::filesystem::is_regular_file("/dev/full"));
}

TEST(WholeFile, IsOnTheDiskBeforeItIsInItsPlaceAndThenItsNameIs) {
  const testing::TemporaryFolder folder;
  watched = folder.write("table.csv", std::string("old"));
  write_whole_file(watched, "new");
  watched.clear();
  EXPECT_THAT(content_when_flushed, ElementsAre("old", "new"));
}

TEST(WholeFile, LinksStayAndLeadToTheNewContent) {
  const testing::TemporaryFolder folder;
  const auto real = folder.write("real.csv", std::string("old"));
  std::filesystem::create_symlink("real.csv", folder.path() / "link.csv");
  std::filesystem::create_symlink("later.csv", folder.path() / "open.csv");
  write_whole_file(folder.path() / "link.csv", "new");
  write_whole_file(folder.path() / "open.csv", "first");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.csv"));
  EXPECT_EQ(testing::text_of(real), "new");
  EXPECT_EQ(testing::text_of(folder.path() / "later.csv"), "first");
}

TEST(WholeFile, TheRightsOfTheEarlierFileStay) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("table.csv", std::string("old"));
  constexpr auto kPrivate =
      std::filesystem::perms::owner_read | std::filesystem::perms::owner_write;
  std::filesystem::permissions(file, kPrivate);
  write_whole_file(file, "new");
  EXPECT_EQ(std::filesystem::status(file).permissions(), kPrivate);
}

TEST(WholeFile, AProtectedFileIsNotReplaced) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const testing::TemporaryFolder folder;
  const auto file = folder.write("table.csv", std::string("old"));
  std::filesystem::permissions(file, std::filesystem::perms::owner_read);
  EXPECT_THAT([&] { write_whole_file(file, "new"); },
              ThrowsMessage<base::InputError>(HasSubstr("is write-protected")));
  EXPECT_EQ(testing::text_of(file), "old");
}

TEST(WholeFile, WhatAKilledProcessLeftGoesAwayAndWhatIsBeingWrittenStays) {
  const testing::TemporaryFolder folder;
  folder.write(".table.csv.1234-0.part.csv", std::string("half a ta"));
  folder.write(".table.csv.mine", std::string("not ours"));
  const TemporaryFile busy(folder.path() / "table.csv");
  check_can_write(folder.path() / "table.csv");
  EXPECT_THAT(folder.names(), UnorderedElementsAre(".table.csv.mine", busy.path().filename()));
}

TEST(WholeFile, NamesMayBeAsLongAsTheSystemAllows) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / std::string(255, 'x');
  write_whole_file(file, "new");
  EXPECT_EQ(testing::text_of(file), "new");
}

TEST(WholeFile, CheckingLeavesNothingBehind) {
  const testing::TemporaryFolder folder;
  check_can_write(folder.path() / "table.csv");
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(WholeFile, CheckingFindsAMissingFolder) {
  const testing::TemporaryFolder folder;
  EXPECT_THROW(check_can_write(folder.path() / "no" / "table.csv"), base::InputError);
}

TEST(WholeFile, CheckingFindsALockedFolder) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const testing::TemporaryFolder folder;
  std::filesystem::permissions(
      folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THROW(check_can_write(folder.path() / "table.csv"), base::InputError);
}

}  // namespace
}  // namespace repose::base
