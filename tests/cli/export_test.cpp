#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "tests/calibrate/made_up_result.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"
#include "tests/support/heap_picture.h"
#include "tests/support/particle_files.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

/// A folder as repose calibrate leaves it when a study has finished.
class Export : public CommandTest {
 protected:
  Export() : CommandTest({"export"}) {
    folder_.write("study.toml", calibrate::test::kSphereStudy);
    run_repose(folder_, {"shape", "--size-mm", "20,20,20", "--spheres", "1", "--out", "ball.json"});
    const auto study = path("study");
    std::filesystem::create_directory(study);
    std::filesystem::copy(path("study.toml"), study / "study.toml");
    std::filesystem::copy(path("ball.json"), study / "clump.json");
    calibrate::StudyResult result = calibrate::test::joint_result();
    result.provenance.study.settings.clear();
    const calibrate::StudyIdentity& of = result.provenance.study;
    const json notes{{"program", of.program},
                     {"method", of.method},
                     {"study", {{"file", of.file}, {"hash", of.hash}, {"settings", json::array()}}},
                     {"budget", {{"name", of.budget}, {"description", of.budget_description}}},
                     {"pictures", json::array()}};
    folder_.write("study/study.json", notes.dump());
    folder_.write("study/result.json", to_json(result));
  }
};

TEST_F(Export, WritesDecksAndSaysWhatBecameOfEachCoefficient) {
  const Finished done = run({"study", "--to", "liggghts"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("particle_wall.restitution"), HasSubstr("exact"),
                              HasSubstr("study/export/liggghts")));
  EXPECT_THAT(done.err, HasSubstr("sliding_friction = 0.3 is undetermined"));
  EXPECT_THAT(text("study/export/liggghts/material.lig"), HasSubstr("peratomtypepair 2 0.4"));
  EXPECT_THAT(text("study/export/liggghts/README.txt"), HasSubstr("undetermined"));
  EXPECT_THAT(text("study/export/liggghts/drop.lig"), HasSubstr("jump drop.lig next_grain"));
}

TEST_F(Export, WritesTheSetThatIsAskedFor) {
  const Finished best = run({"study", "--to", "edem"});
  EXPECT_THAT(best.out, HasSubstr("of set 1 of 3 that fit equally well; use one together"));
  const Finished other =
      run({"study", "--to", "edem", "--set-number", "3", "--json", "other.json"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  const json made = json::parse(text("other.json"));
  EXPECT_EQ(made["set_number"], 3);
  EXPECT_EQ(made["sets"], json::parse("[[0.4, 0.3], [0.41, 0.5], [0.39, 0.7]]"));
  EXPECT_EQ(made["conversions"][0]["value"], .39);
  const Finished none = run({"study", "--to", "edem", "--set-number", "4"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err,
              HasSubstr("--set-number 4: this study has 3 equally good sets, from 1 to 3"));
  EXPECT_THAT(run({"study", "--to", "edem", "--set-number", "0"}).err, HasSubstr("Fix: "));
}

TEST_F(Export, JsonListsFilesAndConversions) {
  const Finished done = run({"study", "--to", "edem", "--out", "tables", "--json", "-"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json made = json::parse(done.out);
  EXPECT_EQ(made["target"], "edem");
  EXPECT_EQ(made["folder"], "tables");
  EXPECT_THAT(made["files"].get<Words>(), AllOf(Contains("values.csv"), Contains("README.txt")));
  EXPECT_EQ(made["conversions"][0]["coefficient"], "contact.particle_wall.restitution");
  EXPECT_EQ(made["conversions"][0]["exported"], .4);
  EXPECT_EQ(made["conversions"][2]["standing"], "exact");
  EXPECT_FALSE(made["warnings"].empty());
  EXPECT_THAT(text("tables/spheres.txt"), HasSubstr("Physical Radius\n"));
}

/// A study whose heap does not determine the friction between grains.
class ExportOfAHeap : public Export {
 protected:
  ExportOfAHeap() {
    std::string study = calibrate::test::kSphereStudy + "[experiment.heap]\ngrains = 20\n";
    const std::string known = "sliding_friction = 0.2";
    study.replace(study.find(known), known.size(), "sliding_friction = { min = 0.1, max = 0.8 }");
    folder_.write("study/study.toml", study);
    calibrate::StudyResult result = calibrate::test::joint_result();
    result.provenance.study.settings.clear();
    auto& joint = std::get<calibrate::JointResult>(result.found);
    joint.parameters[1].name = "contact.particle_particle.sliding_friction";
    calibrate::ResultParameter friction = joint.parameters[1];
    friction.name = "contact.particle_wall.sliding_friction";
    friction.verdict = calibrate::Verdict::bounded;
    joint.parameters.push_back(friction);
    joint.observables.push_back(joint.observables.front());
    calibrate::ResultObservable& heap = joint.observables.back();
    heap.name = heap.verification->observable = heap.surrogate->observable = "heap";
    heap.unit = "deg";
    heap.measured = heap.verification->measured = 24;
    heap.measured_uncertainty = heap.verification->measured_uncertainty = .4;
    heap.systematic.clear();
    for (calibrate::EquivalentSet& set : joint.equivalence_family) set.values.push_back(.3);
    for (auto& set : joint.equivalence_family) {
      if (!set.simulated.empty()) set.simulated.push_back(24);
    }
    for (calibrate::Run& one : joint.runs) one.job.values.push_back(.3);
    joint.agreement.values.push_back(.3);
    joint.rounds.clear();
    joint.correlation = {{1, .25, 0}, {.25, 1, 0}, {0, 0, 1}};
    joint.reading_correlation = {{1, 0}, {0, 1}};
    folder_.write("study/result.json", to_json(result));
  }

  /// The command lines in the README of an export, split into words.
  std::vector<Words> commands_in(const std::string& readme) const {
    std::vector<Words> commands;
    std::istringstream lines(text(readme));
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word != "repose" || !line.starts_with("    ")) continue;
      commands.emplace_back();
      while (words >> word) commands.back().push_back(word);
    }
    return commands;
  }
};

/// Fills in results: a file of the heap's particles in the first row, numbers in the others.
std::string filled_in(const std::string& table, const std::string& heap_file) {
  std::istringstream lines(table);
  std::string line, headings;
  std::getline(lines, headings);
  std::string filled = headings + '\n';
  Words columns;
  std::istringstream names(headings);
  for (std::string name; std::getline(names, name, ',');) columns.push_back(name);
  for (int row = 0; std::getline(lines, line); ++row) {
    std::istringstream cells(line);
    double sum = 0;
    for (const std::string& column : columns) {
      std::string cell;
      std::getline(cells, cell, ',');
      if (column == "drop") cell = fmt::format("{:.2f}", 24 + 2 * sum + .3 * (row % 3));
      if (column == "heap") cell = fmt::format("{:.2f}", 14 + 12 * sum - .3 * (row % 3));
      if (column == "heap" && row == 0) cell = heap_file;
      if (column == "reason") cell.clear();
      if (column.starts_with("grain with")) sum += std::stod(cell);
      filled += cell + (column == "reason" ? '\n' : ',');
    }
  }
  return filled;
}

// Commands pasted from the README work unchanged, with a heap in that program's format.
TEST_F(ExportOfAHeap, CommandsOfItsReadmeBringTheHeapBack) {
  const Spheres heap = packed_cone(24, .018, .002);
  HeapScene scene;
  scene.width = 600;
  scene.height = 400;
  scene.form.left_rad = scene.form.right_rad = 24 * kDegree;
  const vision::Picture photo = draw_heap(scene).picture;
  for (const auto& [target, file, content] :
       {std::tuple("edem", "heap.csv",
                   particle_table(heap, {.header = "Position X [m],Position Y [m],Position Z [m],"
                                                   "Radius [m]\n"})),
        {"liggghts", "heap.dump", dump_step(1, heap)},
        {"yade", "heap.txt", particle_table(heap, {.header = "x [m],y [m],z [m],radius [m]\n"})},
        {"lammps", "heap.dump", dump_step(1, heap)}}) {
    const TemporaryFolder work;
    const Finished done =
        run({"study", "--to", target, "--approximate", "--out", work.path().string()});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    const std::vector<Words> commands = commands_in(work.path() / "README.txt");
    EXPECT_THAT(commands, SizeIs(6)) << target;
    work.write(file, content);
    vision::write_picture(work.path() / "photo.jpg", photo);
    for (const Words& command : commands) {
      const bool is_fit = std::ranges::find(command, "--runs") != command.end();
      if (is_fit && std::string(target) != "edem") continue;  // the same again, taking seconds
      const Finished ran = run_repose(work, command);
      EXPECT_EQ(ran.exit_code, 0) << target << ": repose " << command.front() << ' ' << ran.err;
      if (command.front() == "measure") {
        EXPECT_THAT(ran.out, AllOf(HasSubstr(" particles"), HasSubstr("z is up")));
      }
      if (command.front() == "compare") {
        EXPECT_THAT(ran.out, HasSubstr("overlap (IoU)"));
      }
      const std::filesystem::path next = work.path() / "next.csv";
      if (command.front() == "ask" && command.back() == "next.csv") {
        work.write("next.csv", filled_in(text_of(next), file));
      }
    }
  }
}

TEST_F(Export, AnUnfinishedStudyIsRefused) {
  std::filesystem::remove(path("study/result.json"));
  const Finished refused = run({"study", "--to", "yade"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.out, IsEmpty());
  EXPECT_THAT(refused.err, AllOf(HasSubstr("is unfinished"), HasSubstr("Fix: ")));
  EXPECT_FALSE(exists("study/export"));
}

TEST_F(Export, EveryErrorIsTold) {
  const Finished wrong = run({"nowhere", "--to", "excel"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("--to excel: must be one of liggghts"),
                               HasSubstr("nowhere"), HasSubstr("Fix: ")));
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_EQ(run({"study"}).exit_code, 2);
  folder_.write("study/result.json", std::string("{"));
  const Finished damaged = run({"study", "--to", "edem"});
  EXPECT_EQ(damaged.exit_code, 2);
  EXPECT_THAT(damaged.err, HasSubstr("result.json: is not a result"));
}

TEST_F(Export, AnotherLawIsRefusedUntilApproximateIsGiven) {
  std::string study = text("study/study.toml");
  study += "[experiment.heap]\ngrains = 20\n";
  folder_.write("study/study.toml", study);
  const Finished refused = run({"study", "--to", "lammps"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err,
              AllOf(HasSubstr("particle_particle.rolling_friction"), HasSubstr("--approximate"),
                    Not(HasSubstr("particle_wall.rolling_friction = "))));
  EXPECT_EQ(run({"study", "--to", "lammps", "--approximate"}).exit_code, 0);
}

}  // namespace
}  // namespace repose::testing
