// Accuracy of angle and volume of scanned heaps, and how often their intervals contain the truth:
// heaps of grains, scanned by depth cameras with noise and registration errors.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "base/units.h"
#include "calibrate/experiment/scan_angle.h"
#include "dem/state/state_file.h"
#include "render/scene/scene.h"
#include "tests/bench/benches.h"
#include "tests/bench/depth_scanner.h"
#include "tests/bench/grain_cone.h"
#include "tests/bench/median.h"
#include "tests/support/heap_random.h"
#include "vision/measure/outline_angle.h"
#include "vision/scan/scanned_heap.h"

namespace repose::bench {
namespace {

struct ScanSettings {
  std::vector<std::string> states;
  int heaps = 12;
  int scans = 5;
  std::uint64_t seed = 1;
  int threads = 2;
};

struct ScannedRow {
  std::string name;
  vision::ScannedHeap heap;
  double angle_deg = 0;       ///< the truth
  double silhouette_deg = 0;  ///< true angle of its silhouettes
  vision::ReposeAngle seen;   ///< in silhouettes of the scan
  double volume_ml = 0;
};

vision::ScannedHeap measured(std::vector<base::Corner> points) {
  vision::Scan scan;
  scan.points = std::move(points);
  return vision::measure_scan(scan, {.unit_mm = 1});
}

std::vector<std::pair<std::string, render::Scene>> scenes_of(const ScanSettings& settings) {
  std::vector<std::pair<std::string, render::Scene>> scenes;
  for (const std::string& file : settings.states) {
    scenes.emplace_back(std::filesystem::path(file).stem().string(),
                        render::scene_of(dem::read_state(file)));
  }
  if (!scenes.empty()) return scenes;
  for (int k = 0; k < settings.heaps; ++k) {
    const std::uint64_t seed = settings.seed + static_cast<std::uint64_t>(k);
    testing::Random random(seed);
    GrainCone cone;
    cone.angle_rad = random.uniform(20, 33) * kDegree;
    cone.hollow = random.uniform(1, 1.3);
    cone.grains_high = random.uniform(8, 20);
    cone.seed = seed;
    scenes.emplace_back(fmt::format("drawn {}", seed), scene_of(cone));
  }
  return scenes;
}

DepthScanner scanner_for(std::uint64_t seed) {
  testing::Random random(seed);
  DepthScanner scanner;
  scanner.noise_m = random.uniform(.1e-3, 1e-3);
  scanner.turn_rad = random.uniform(.2e-3, 2e-3);
  scanner.shift_m = random.uniform(.1e-3, .6e-3);
  scanner.flying = random.uniform(0, .02);
  scanner.seed = seed;
  return scanner;
}

/// The angle of the surface's silhouettes: the mean over 36 of them, from all sides.
double silhouette_deg(const std::vector<base::Corner>& points) {
  constexpr int kViews = 36, kColumns = 800;
  double half = 0, sum = 0;
  for (const base::Corner& point : points) half = std::max(half, std::abs(point[0]));
  int seen = 0;
  for (int view = 0; view < kViews; ++view) {
    const double turn_rad = 2 * std::numbers::pi * view / kViews;
    std::vector<double> highest(kColumns, 0.0);
    for (const base::Corner& point : points) {
      const double along = point[0] * std::cos(turn_rad) + point[1] * std::sin(turn_rad);
      const auto column = static_cast<int>((along / half + 1) / 2 * kColumns);
      if (column < 0 || column >= kColumns) continue;
      double& height = highest[static_cast<std::size_t>(column)];
      height = std::max(height, point[2]);
    }
    // The heap alone: the ground beside it, and strays beyond a gap, are not part of its outline.
    const auto crest = std::max_element(highest.begin(), highest.end());
    const auto last = std::find(crest, highest.end(), 0.0);
    const auto first = std::find(std::make_reverse_iterator(crest), highest.rend(), 0.0).base();
    vision::Outline outline;
    for (auto at = first; at != last; ++at) {
      outline.along.push_back((static_cast<double>(at - highest.begin()) + .5) * 2 * half /
                              kColumns);
      outline.height.push_back(*at);
    }
    const auto angle_rad = vision::measure_outline(outline).angle_rad();
    if (!angle_rad) continue;
    sum += to_degrees(*angle_rad);
    ++seen;
  }
  return seen > 0 ? sum / seen : 0;
}

struct ScanTally {
  std::vector<double> errors, half_widths;
  void add(double error, double half_width) {
    errors.push_back(error);
    half_widths.push_back(half_width);
  }
  void print(const char* what) const {
    if (errors.empty()) return;
    std::vector<double> sizes;
    int held = 0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      sizes.push_back(std::abs(errors[k]));
      held += sizes.back() <= half_widths[k] ? 1 : 0;
    }
    fmt::print(
        "{:12} bias {:7.3f}  median |error| {:6.3f}  worst {:6.3f}  ± x {:6.3f}  {} of {} hold\n",
        what, median(errors), median(sizes), *std::max_element(sizes.begin(), sizes.end()),
        median(half_widths), held, errors.size());
  }
};

void print_rows(const std::vector<ScannedRow>& rows) {
  ScanTally angle, volume, seen;
  int refused = 0, flagged = 0;
  for (const ScannedRow& row : rows) {
    const vision::ReposeAngle& found = row.heap.angle;
    if (!found.angle_rad || !row.heap.volume_ml) {
      ++refused;
      fmt::print("{:24} {} {}\n", row.name, found.reason, row.heap.size_reason);
      continue;
    }
    flagged += found.status == vision::MeasureStatus::flagged ? 1 : 0;
    const double off_deg = to_degrees(*found.angle_rad) - row.angle_deg;
    const double half_deg = to_degrees(*found.uncertainty_rad);
    const auto& [ml, half_ml] = *row.heap.volume_ml;
    fmt::print("{:24} {:7.2f}° {:+6.3f} ± {:5.3f}   {:9.1f} ml {:+6.2f} ± {:4.2f} %\n", row.name,
               row.angle_deg, off_deg, half_deg, row.volume_ml, 100 * (ml / row.volume_ml - 1),
               100 * half_ml / row.volume_ml);
    angle.add(off_deg, half_deg);
    volume.add(100 * (ml / row.volume_ml - 1), 100 * half_ml / row.volume_ml);
  }
  for (const ScannedRow& row : rows) {
    if (!row.seen.angle_rad) continue;
    seen.add(to_degrees(*row.seen.angle_rad) - row.silhouette_deg,
             to_degrees(*row.seen.uncertainty_rad));
  }
  fmt::print("\n{} scans, {} refused, {} flagged\n", rows.size(), refused, flagged);
  angle.print("angle [°]");
  volume.print("volume [%]");
  seen.print("silhouette [°]");
  std::vector<double> more;
  for (const ScannedRow& row : rows) {
    if (row.angle_deg > 0) more.push_back(row.silhouette_deg - row.angle_deg);
  }
  if (more.empty()) return;
  fmt::print("silhouettes are steeper than slices by {:.2f}° (median; {:.2f} to {:.2f}°)\n",
             median(more), *std::min_element(more.begin(), more.end()),
             *std::max_element(more.begin(), more.end()));
}

void measure_scans(const ScanSettings& settings) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(settings.threads));
  const auto scenes = scenes_of(settings);
  const auto scans = static_cast<std::size_t>(settings.scans);
  std::vector<ScannedRow> rows(scenes.size() * scans);
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t k) {
    const auto& [name, scene] = scenes[k];
    const ExactSurface exact = surface_from_above(scene);
    const vision::ScannedHeap truth = measured(exact.points);
    const double seen_deg = silhouette_deg(exact.points);
    for (std::size_t scan = 0; scan < scans; ++scan) {
      ScannedRow& row = rows[k * scans + scan];
      row.name = fmt::format("{} scan {}", name, scan);
      row.angle_deg = to_degrees(truth.angle.angle_rad.value_or(0));
      row.silhouette_deg = seen_deg;
      row.volume_ml = exact.volume_ml;
      row.heap = measured(scanned(scene, scanner_for(settings.seed + 1000 * k + scan)));
      row.seen = calibrate::measure_scan_views(row.heap).angle;
      row.heap.map = {};
    }
  });
  print_rows(rows);
}

}  // namespace

void add_scan_accuracy(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand("scan_accuracy", "How near scanned heaps come");
  const auto settings = std::make_shared<ScanSettings>();
  app.add_option("states", settings->states,
                 "Simulated heaps (.vtp of repose simulate heap --out); none: drawn ones");
  app.add_option("--heaps", settings->heaps, "Drawn heaps");
  app.add_option("--scans", settings->scans, "Scans of each");
  app.add_option("--seed", settings->seed, "The first");
  app.add_option("--threads", settings->threads, "Heaps at a time");
  app.callback([settings] { measure_scans(*settings); });
}

}  // namespace repose::bench
