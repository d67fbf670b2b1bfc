#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "calibrate/engine/engine.h"
#include "calibrate/engine/engine_study.h"
#include "calibrate/result/result.h"
#include "tests/support/temporary_folder.h"

// A study whose runs are made by a short script.
namespace repose::calibrate::test {

inline constexpr const char* kStudy =
    "[parameter]\n"
    "friction = { min = 0.1, max = 0.7 }\n"
    "[measured]\n"
    "aor = { mean = 22, sd = 1, n = 4, unit = \"deg\" }\n"
    "[engine]\n"
    "command = \"sh run.sh\"\n"
    "settings = { grains = 500, walls = [\"steel\"], is_wet = false }\n";

/// Sets $folder, $friction and $seed of a run.
inline constexpr const char* kRead =
    "folder=$1\n"
    "number() { sed -n \"s/^ *\\\"$1\\\": \\([-0-9.e]*\\),*$/\\1/p\" \"$folder/run.json\"; }\n"
    "friction=$(number friction); seed=$(number seed)\n";

/// The angle follows a formula, with something that looks like random scatter.
inline constexpr const char* kAngle =
    "angle=$(awk -v f=$friction -v s=$seed 'BEGIN { print 8 + 40 * f + .5 * sin(37 * s) }')\n";
inline constexpr const char* kWrite = "echo \"{\\\"aor\\\": $angle}\" > \"$folder/reading.json\"\n";

/// A folder whose name a shell would split or expand if unquoted.
class EngineCommandTest : public ::testing::Test {
 protected:
  EngineCommandTest() {
    std::filesystem::create_directories(place_);
    write("study.toml", kStudy);
    script(std::string(kAngle) + kWrite);
  }

  void write(const std::string& name, const std::string& text) const {
    folder_.write(fmt::format("it's a \"folder\" $1/{}", name), text);
  }
  void script(const std::string& text) const { write("run.sh", kRead + text); }
  std::string text(const std::string& name) const {
    return repose::testing::text_of(place_ / name);
  }

  EngineRequest request(const std::string& out = "out") const {
    return {.study = place_ / "study.toml", .folder = place_ / out};
  }
  StudyResult calibrated(const EngineRequest& of) {
    auto result = calibrate_with_engine(
        of, {.note = [this](const std::string& note) { notes_.push_back(note); }});
    return std::move(result).value();
  }
  static EngineFacts facts(const StudyResult& of) { return of.provenance.table->engine.value(); }

  /// The row of a run in the table; empty if there is none.
  std::string row(const std::string& run, const std::string& out = "out") const {
    const std::string table = text(out + "/runs/runs.csv");
    const std::size_t start = table.find(run + ',');
    return start == std::string::npos ? "" : table.substr(start, table.find('\n', start) - start);
  }

  repose::testing::TemporaryFolder folder_;
  std::filesystem::path place_ = folder_.path() / "it's a \"folder\" $1";
  std::vector<std::string> notes_;
};

}  // namespace repose::calibrate::test
