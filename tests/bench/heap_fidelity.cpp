// Errors of cheaper heaps: the angle of repose of the same grain in the same tube with larger
// grains, other numbers of spheres and other stiffnesses, at several frictions between grains.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/statistics/summary.h"
#include "dem/experiment/heap.h"
#include "dem/study/grain_source.h"
#include "tests/bench/benches.h"
#include "tests/bench/line_panels.h"

namespace repose::bench {
namespace {

struct Wanted {
  std::string study;
  std::vector<std::string> settings;
  std::vector<std::pair<double, double>> frictions = {{.2, .02}, {.45, .08}, {.75, .22}};
  std::vector<std::pair<double, int>> sizes = {{1, 4}, {1.5, 4}, {2, 8}, {2.64, 8}, {3, 8}};
  double of_size = 2.64;
  std::vector<int> spheres = {5, 44};
  std::vector<double> stiffnesses = {.01, 1};
  int heaps = 6;
  int jobs = 2;
  std::string folder;
  std::string figure;
};

/// Settings of the grain and its contacts other than the friction between grains.
struct Variant {
  double size = 1;
  std::optional<int> spheres;
  std::optional<double> stiffness_factor;
  int heaps = 1;
};

struct Found {
  std::vector<double> angles_deg;
  int failed = 0;
  double grains = 0;
  double run_s = 0;
};

/// As a user would type them, so that `repose simulate --set` makes the same runs.
std::vector<std::string> settings_of(const Wanted& wanted, const dem::CalliperSizes& sizes,
                                     const Variant& variant,
                                     const std::pair<double, double>& friction) {
  constexpr double kMm = 1e3;
  std::vector<std::string> settings = wanted.settings;
  const double scale = kMm * variant.size;
  settings.push_back(fmt::format("particle.size_mm=[{:.4g},{:.4g},{:.4g}]", scale * sizes.length_m,
                                 scale * sizes.width_m, scale * sizes.thickness_m));
  if (variant.spheres) settings.push_back(fmt::format("particle.spheres={}", *variant.spheres));
  if (variant.stiffness_factor) {
    settings.push_back(
        fmt::format("experiment.heap.stiffness_factor={:g}", *variant.stiffness_factor));
  }
  settings.push_back(
      fmt::format("contact.particle_particle.sliding_friction={:g}", friction.first));
  settings.push_back(
      fmt::format("contact.particle_particle.rolling_friction={:g}", friction.second));
  return settings;
}

Found heaps_of(const Wanted& wanted, const calibrate::RunStore& store,
               const std::vector<std::string>& settings, int heaps) {
  const dem::Study study = dem::read_study(wanted.study, settings);
  calibrate::RunSpec spec = calibrate::spec_of(study, dem::experiment_of<dem::HeapProtocol>(),
                                               calibrate::NamedGrain(dem::build_grain(study.grain)),
                                               calibrate::kHeapViews);
  spec.model.threads = 1;
  std::vector<calibrate::RunResult> runs(static_cast<std::size_t>(heaps));
  tbb::task_arena arena(wanted.jobs);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t k) {
      runs[k] = calibrate::simulate_experiment(spec, k + 1,
                                               {.folder = &store, .trajectory = {}, .report = {}});
    });
  });
  Found found;
  for (const calibrate::RunResult& run : runs) {
    if (!run.value || !run.failure.empty()) {
      ++found.failed;
      continue;
    }
    found.angles_deg.push_back(*run.value);
    found.grains = std::max(found.grains, calibrate::readings_of(run).at("grains"));
    found.run_s += run.wall_s;
  }
  if (!found.angles_deg.empty()) found.run_s /= static_cast<double>(found.angles_deg.size());
  return found;
}

/// One line of the table: a variant at all frictions.
struct Row {
  double x = 1;  ///< its size, spheres or stiffness factor
  std::vector<Found> found;
};

Row row_of(const Wanted& wanted, const calibrate::RunStore& store, const dem::CalliperSizes& sizes,
           double x, const Variant& variant) {
  Row row{.x = x, .found = {}};
  for (const auto& friction : wanted.frictions) {
    row.found.push_back(
        heaps_of(wanted, store, settings_of(wanted, sizes, variant, friction), variant.heaps));
  }
  return row;
}

std::string cell_of(const Found& found) {
  std::string text = "none";
  if (!found.angles_deg.empty()) {
    const calibrate::Summary summary = calibrate::summarise(found.angles_deg);
    text = fmt::format("{:.1f}", summary.mean);
    if (summary.sd) {
      text += fmt::format(" ± {:.1f} ({:.1f})", *summary.mean_uncertainty, *summary.sd);
    }
  }
  return found.failed > 0 ? text + fmt::format(", {} without", found.failed) : text;
}

void print_row(const std::string& name, const Row& row) {
  double grains = 0, run_s = 0;
  std::string cells;
  for (const Found& found : row.found) {
    grains = std::max(grains, found.grains);
    run_s = std::max(run_s, found.run_s);
    cells += fmt::format(" {} |", cell_of(found));
  }
  fmt::print("| {} | {:.0f} | {:.2g} s |{}\n", name, grains, run_s, cells);
  std::fflush(stdout);
}

Panel panel_of(const Wanted& wanted, const std::string& title, const std::vector<Row>& rows) {
  Panel panel{.title = title, .ticks = {}, .lines = {}};
  for (const Row& row : rows) panel.ticks.push_back(row.x);
  for (std::size_t k = 0; k < wanted.frictions.size(); ++k) {
    const auto& [sliding, rolling] = wanted.frictions[k];
    PanelLine& line = panel.lines.emplace_back(
        PanelLine{fmt::format("friction {:g}, rolling {:g}", sliding, rolling), {}});
    for (const Row& row : rows) {
      if (row.found[k].angles_deg.empty()) continue;
      const calibrate::Summary summary = calibrate::summarise(row.found[k].angles_deg);
      line.points.push_back({row.x, summary.mean, summary.mean_uncertainty.value_or(0)});
    }
  }
  return panel;
}

void measure(const Wanted& wanted) {
  const dem::Study study = dem::read_study(wanted.study, wanted.settings);
  if (!study.grain.sizes) throw std::runtime_error("the study's grain has no size_mm to scale");
  const calibrate::RunStore store(wanted.folder);
  const auto row = [&](double x, const Variant& variant) {
    return row_of(wanted, store, *study.grain.sizes, x, variant);
  };
  std::string heading = "| grains | in the tube | a run |", rule = "|---|---|---|";
  for (const auto& [sliding, rolling] : wanted.frictions) {
    heading += fmt::format(" {:g}, {:g} |", sliding, rolling);
    rule += "---|";
  }
  fmt::print("{}\n{}\n", heading, rule);
  std::vector<Row> by_size, by_spheres, by_stiffness;
  for (auto [size, heaps] : wanted.sizes) {
    by_size.push_back(
        row(size, {.size = size, .spheres = {}, .stiffness_factor = {}, .heaps = heaps}));
    print_row(fmt::format("{:g} times", size), by_size.back());
  }
  const auto own = [&](double x) {
    return row(
        x, {.size = wanted.of_size, .spheres = {}, .stiffness_factor = {}, .heaps = wanted.heaps});
  };
  by_spheres.push_back(own(study.grain.fill.spheres));
  for (const int spheres : wanted.spheres) {
    by_spheres.push_back(row(spheres, {.size = wanted.of_size,
                                       .spheres = spheres,
                                       .stiffness_factor = {},
                                       .heaps = wanted.heaps}));
    print_row(fmt::format("{:g} times, {} spheres", wanted.of_size, spheres), by_spheres.back());
  }
  const double factor =
      study.experiments.at(dem::experiment_of<dem::HeapProtocol>()).stiffness_factor;
  by_stiffness.push_back(own(factor));
  for (const double stiffness : wanted.stiffnesses) {
    by_stiffness.push_back(row(stiffness, {.size = wanted.of_size,
                                           .spheres = {},
                                           .stiffness_factor = stiffness,
                                           .heaps = wanted.heaps}));
    print_row(fmt::format("{:g} times, stiffness factor {:g}", wanted.of_size, stiffness),
              by_stiffness.back());
  }
  if (wanted.figure.empty()) return;
  for (auto* rows : {&by_size, &by_spheres, &by_stiffness}) std::ranges::sort(*rows, {}, &Row::x);
  std::ofstream(wanted.figure) << panels_svg(
      {panel_of(wanted, "grains so many times as large", by_size),
       panel_of(wanted, fmt::format("spheres, grains {:g} times as large", wanted.of_size),
                by_spheres),
       panel_of(wanted, fmt::format("stiffness factor, grains {:g} times", wanted.of_size),
                by_stiffness)},
      "angle of repose, degrees, and 95 % intervals of the means");
}

}  // namespace

void add_heap_fidelity(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand(
      "heap_fidelity", "Angles of heaps of larger grains, fewer spheres, other stiffness");
  const auto wanted = std::make_shared<Wanted>();
  app.add_option("study", wanted->study, "a study with a heap and a grain of three sizes")
      ->required();
  app.add_option("--out", wanted->folder, "keeps the runs, so that another call goes on from there")
      ->required();
  app.add_option("--set", wanted->settings, "of the study");
  app.add_option("--friction", wanted->frictions, "between grains: sliding and rolling");
  app.add_option("--size", wanted->sizes, "of the grains as a multiple, and how many heaps");
  app.add_option("--of-size", wanted->of_size, "of the grains whose spheres and stiffness vary");
  app.add_option("--spheres", wanted->spheres);
  app.add_option("--stiffness", wanted->stiffnesses, "stiffness factors of the heap");
  app.add_option("--heaps", wanted->heaps, "of each of those")->check(CLI::PositiveNumber);
  app.add_option("--jobs", wanted->jobs)->check(CLI::PositiveNumber);
  app.add_option("--figure", wanted->figure, "an SVG file");
  app.callback([wanted] { measure(*wanted); });
}

}  // namespace repose::bench
