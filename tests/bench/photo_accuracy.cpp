#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "tests/bench/accuracy_row.h"
#include "tests/bench/accuracy_table.h"
#include "tests/bench/benches.h"
#include "tests/bench/drawn_subjects.h"
#include "tests/bench/other_subjects.h"
#include "tests/bench/reliability_table.h"
#include "tests/bench/rendered_subjects.h"

namespace repose::bench {
namespace {

using testing::Group;

constexpr std::size_t kDumped = 30;

std::vector<Subject> subjects_for(const std::string& section, const std::string& condition,
                                  int seeds, std::uint64_t first_seed) {
  std::vector<Subject> subjects;
  for (auto&& part : {drawn_subjects(seeds, first_seed), rendered_subjects(seeds, first_seed),
                      other_subjects(seeds, first_seed)}) {
    subjects.insert(subjects.end(), part.begin(), part.end());
  }
  std::erase_if(subjects, [&](const Subject& subject) {
    return (!section.empty() && section != subject.section) ||
           (!condition.empty() && condition != subject.condition);
  });
  if (subjects.empty()) {
    throw std::invalid_argument("condition = " + condition +
                                ", unknown. Fix: take one of the tables'.");
  }
  return subjects;
}

/// In the order of the subjects, whatever the number of threads.
std::vector<Row> measured(const std::vector<Subject>& subjects,
                          std::span<const std::string_view> with_methods) {
  std::vector<std::vector<Row>> parts(subjects.size());
  tbb::parallel_for(std::size_t{0}, subjects.size(),
                    [&](std::size_t i) { parts[i] = measure_rows(subjects[i], with_methods); });
  std::vector<Row> rows;
  for (const auto& part : parts) rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

/// Larger is worse: an angle where there is none, the error, a refusal.
double badness(const Row& row) {
  constexpr double kInvented = 100;
  constexpr double kRefused = 50;
  if (row.subject->group == Group::not_measurable) return row.mean.measured_deg ? kInvented : 0;
  const auto error = row.mean.error_deg();
  return error ? std::abs(*error) : kRefused;
}

void dump_worst(const std::vector<Row>& rows, const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::vector<const Row*> worst;
  for (const Row& row : rows) {
    if (row.method != "script") worst.push_back(&row);
  }
  std::sort(worst.begin(), worst.end(), [](const Row* a, const Row* b) {
    return std::pair(-badness(*a), a) < std::pair(-badness(*b), b);  // ties keep their order
  });
  worst.resize(std::min(worst.size(), kDumped));
  tbb::parallel_for(std::size_t{0}, worst.size(), [&](std::size_t i) {
    measure_rows(*worst[i]->subject, {&worst[i]->method, 1}, folder);
  });
}

void print_tables(const std::vector<Row>& rows, std::string_view section) {
  for (const std::string_view method : methods()) {
    std::vector<Row> part;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(part), [&](const Row& row) {
      return row.subject->section == section && row.method == method;
    });
    std::string text;
    for (const Group group :
         {Group::clean, Group::degraded, Group::hollow, Group::sample, Group::misplaced}) {
      text += group_table(part, group);
    }
    text += bias_table(part) + refusal_table(part);
    if (!text.empty()) fmt::print("== {} pictures, method {} ==\n\n{}\n", section, method, text);
  }
}

/// Over all sections together: confidence means the same in each.
void print_reliability(const std::vector<Row>& rows) {
  std::vector<Row> part;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(part),
               [](const Row& row) { return row.method == "auto"; });
  if (part.empty()) return;
  fmt::print("== reliability, method auto ==\n\n{}\n{}", reliability_table(part),
             coverage_table(part));
}

struct PhotoSettings {
  int seeds = 20;
  std::uint64_t first_seed = 1;
  std::string section;
  std::string condition;
  std::string method;
  std::string folder;
  std::string csv;
  int threads = 0;
};

void measure_photos(const PhotoSettings& settings) {
  std::optional<tbb::global_control> limit;
  if (settings.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  static_cast<unsigned>(settings.threads));
  }
  const auto all_methods = methods();
  const std::string_view one_method = settings.method;
  const auto subjects =
      subjects_for(settings.section, settings.condition, settings.seeds, settings.first_seed);
  const auto rows =
      measured(subjects, one_method.empty() ? all_methods : std::span(&one_method, 1));
  for (const std::string_view name : {"drawn", "rendered", "other"}) print_tables(rows, name);
  print_reliability(rows);
  if (!settings.csv.empty()) write_csv(settings.csv, rows);
  if (!settings.folder.empty()) dump_worst(rows, settings.folder);
}

}  // namespace

void add_photo_accuracy(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand(
      "photo_accuracy",
      "Measures drawn and rendered heaps, whose angles are known, and pictures without a heap");
  const auto settings = std::make_shared<PhotoSettings>();
  app.add_option("--seeds", settings->seeds, "Pictures of each condition")
      ->check(CLI::Range(1, 100000));
  app.add_option("--first-seed", settings->first_seed, "Seed of the first picture");
  app.add_option("--section", settings->section, "These pictures alone")
      ->check(CLI::IsMember({"drawn", "rendered", "other"}));
  app.add_option("--condition", settings->condition, "This condition alone");
  app.add_option("--method", settings->method, "This method alone")
      ->check(CLI::IsMember({"auto", "paper", "script"}));
  app.add_option("--dump", settings->folder, "Folder for overlays of the worst pictures");
  app.add_option("--csv", settings->csv, "File with one row for each picture and method");
  app.add_option("--threads", settings->threads, "0: all cores")->check(CLI::Range(0, 1024));
  app.callback([settings] { measure_photos(*settings); });
}

}  // namespace repose::bench
