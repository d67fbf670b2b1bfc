// Gives every file of the corpus to its reader: those the fuzzers begin with, and those that once
// broke one. A reader that breaks breaks this program; one that takes too long, or says nothing
// where it refuses, is named.
//
//   fuzz_replay CORPUS       the folder with one folder for each reader

#include <algorithm>
#include <chrono>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "tests/fuzz/readers.h"

namespace {

namespace fs = std::filesystem;
using repose::fuzz::Reader;

constexpr double kMax_s = 20;  // under a sanitizer too

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// What is wrong; empty: nothing.
std::string fault_of(const Reader& reader, const fs::path& file) {
  const std::string bytes = repose::base::read_whole_file(file);
  const auto start = std::chrono::steady_clock::now();
  try {
    reader.read({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } catch (const repose::base::InputError& error) {
    if (std::string(error.what()).empty()) return "refused without a word";
  } catch (const std::exception& error) {
    return fmt::format("threw what is no refusal: {}", error.what());
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count() > kMax_s ? fmt::format("took {:.0f} s", elapsed.count()) : "";
}

int reconstruct_rounds(const fs::path& corpus) {
  int faults = 0;
  std::size_t files = 0;
  for (const Reader& reader : repose::fuzz::kReaders) {
    for (const fs::path& file : files_in(corpus / reader.name)) {
      fmt::print("{}\n", file.string());  // the last one printed is the one that broke it
      std::fflush(stdout);
      ++files;
      const std::string fault = fault_of(reader, file);
      if (fault.empty()) continue;
      ++faults;
      fmt::print(stderr, "{}: {}\n", file.string(), fault);
    }
  }
  fmt::print("{} files, {} faults\n", files, faults);
  return faults == 0 && files >= repose::fuzz::kReaders.size() ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  try {
    if (count == 2) return reconstruct_rounds(words[1]);
    fmt::print(stderr, "usage: fuzz_replay CORPUS\n");
  } catch (const std::exception& error) {
    fmt::print(stderr, "fuzz_replay: {}\n", error.what());
  }
  return 2;
}
