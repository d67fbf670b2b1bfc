#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "tests/bench/accuracy_row.h"
#include "tests/bench/accuracy_table.h"

namespace {

using repose::bench::Row;
using repose::testing::Condition;
using repose::testing::Group;

constexpr std::size_t kDumped = 30;

struct Task {
  const Condition* condition = nullptr;
  std::uint64_t seed = 0;
};

std::vector<Task> tasks_for(const std::string& condition, int seeds, std::uint64_t first_seed) {
  if (!condition.empty()) repose::testing::condition_named(condition);
  std::vector<Task> tasks;
  for (const Condition& entry : repose::testing::conditions()) {
    if (!condition.empty() && condition != entry.name) continue;
    for (int i = 0; i < seeds; ++i)
      tasks.push_back({&entry, first_seed + static_cast<unsigned>(i)});
  }
  return tasks;
}

/// In the order of the tasks, whatever the number of threads.
std::vector<Row> measured(const std::vector<Task>& tasks,
                          std::span<const std::string_view> with_methods) {
  std::vector<std::vector<Row>> parts(tasks.size());
  tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t i) {
    parts[i] = repose::bench::measure_rows(*tasks[i].condition, tasks[i].seed, with_methods);
  });
  std::vector<Row> rows;
  for (const auto& part : parts) rows.insert(rows.end(), part.begin(), part.end());
  return rows;
}

/// Larger is worse: an angle where there is none, the error, a refusal.
double badness(const Row& row) {
  constexpr double kInvented = 100;
  constexpr double kRefused = 50;
  if (row.condition->group == Group::not_measurable) return row.mean.measured_deg ? kInvented : 0;
  const auto error = row.mean.error_deg();
  return error ? std::abs(*error) : kRefused;
}

void dump_worst(std::vector<Row> rows, const std::string& folder) {
  std::filesystem::create_directories(folder);
  std::erase_if(rows, [](const Row& row) { return row.method == "script"; });
  std::stable_sort(rows.begin(), rows.end(),
                   [](const Row& a, const Row& b) { return badness(a) > badness(b); });
  rows.resize(std::min(rows.size(), kDumped));
  tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t i) {
    repose::bench::measure_rows(*rows[i].condition, rows[i].seed, {&rows[i].method, 1}, folder);
  });
}

void print_tables(const std::vector<Row>& rows) {
  for (const std::string_view method : repose::bench::methods()) {
    std::string text;
    for (const Group group : {Group::clean, Group::degraded, Group::sample}) {
      text += repose::bench::group_table(rows, group, method);
    }
    text += repose::bench::refusal_table(rows, method);
    if (!text.empty()) fmt::print("== method {} ==\n\n{}\n", method, text);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures drawn heaps and compares with their true angles.");
  int seeds = 20;
  std::uint64_t first_seed = 1;
  std::string condition;
  std::string method;
  std::string folder;
  std::string csv;
  int threads = 0;
  app.add_option("--seeds", seeds, "Pictures of each condition")->check(CLI::Range(1, 100000));
  app.add_option("--first-seed", first_seed, "Seed of the first picture");
  app.add_option("--condition", condition, "This condition alone");
  app.add_option("--method", method, "This method alone")
      ->check(CLI::IsMember({"auto", "paper", "script"}));
  app.add_option("--dump", folder, "Folder for overlays of the worst pictures");
  app.add_option("--csv", csv, "File with one row for each picture and method");
  app.add_option("--threads", threads, "0: all cores")->check(CLI::Range(0, 1024));
  CLI11_PARSE(app, argc, argv);
  try {
    std::optional<tbb::global_control> limit;
    if (threads > 0) {
      limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<unsigned>(threads));
    }
    const auto all_methods = repose::bench::methods();
    const std::string_view one_method = method;
    const auto rows = measured(tasks_for(condition, seeds, first_seed),
                               method.empty() ? all_methods : std::span(&one_method, 1));
    print_tables(rows);
    if (!csv.empty()) repose::bench::write_csv(csv, rows);
    if (!folder.empty()) dump_worst(rows, folder);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "photo_accuracy: {}\n", error.what());
    return 2;
  }
}
