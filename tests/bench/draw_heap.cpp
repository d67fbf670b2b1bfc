#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "tests/bench/benches.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace repose::bench {
namespace {

using nlohmann::ordered_json;
using testing::DrawnHeap;

ordered_json json_degrees(std::optional<double> angle_rad) {
  if (!angle_rad) return nullptr;
  return *angle_rad * 180 / std::numbers::pi;
}

ordered_json json_ends(const std::optional<vision::Segment>& line) {
  if (!line) return nullptr;
  return {line->from.x, line->from.y, line->to.x, line->to.y};
}

ordered_json truth_of(const DrawnHeap& heap, const std::string& condition, std::uint64_t seed) {
  return {{"condition", condition},
          {"seed", seed},
          {"angle_deg", json_degrees(heap.mean_rad())},
          {"left_deg", json_degrees(heap.left_rad)},
          {"right_deg", json_degrees(heap.right_rad)},
          {"ground_tilt_deg", json_degrees(heap.ground_tilt_rad)},
          {"ground_px", json_ends(heap.ground)},
          {"left_line_px", json_ends(heap.left_line)},
          {"right_line_px", json_ends(heap.right_line)},
          {"height_px", heap.height_px},
          {"grain_px", heap.grain_px}};
}

struct DrawSettings {
  std::string condition;
  std::uint64_t seed = 0;
  std::filesystem::path file;
  int width = 0;
};

void draw(const DrawSettings& settings) {
  auto scene = testing::condition_named(settings.condition).scene(settings.seed);
  if (settings.width > 0) {
    scene.height = scene.height * settings.width / scene.width;
    scene.width = settings.width;
  }
  const DrawnHeap heap = testing::draw_heap(scene);
  vision::write_picture(settings.file, heap.picture);
  auto truth_file = settings.file;
  base::write_whole_file(truth_file.replace_extension(".truth.json"),
                         truth_of(heap, settings.condition, settings.seed).dump(2) + '\n');
}

}  // namespace

void add_draw_heap(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand(
      "draw_heap", "Draws a heap with known angles, and OUT.truth.json beside it");
  const auto settings = std::make_shared<DrawSettings>();
  std::vector<std::string> names;
  for (const auto& condition : testing::conditions()) names.emplace_back(condition.name);
  app.add_option("CONDITION", settings->condition, "kind of picture")
      ->required()
      ->check(CLI::IsMember(names));
  app.add_option("SEED", settings->seed, "of everything random")->required();
  app.add_option("OUT", settings->file, "picture to write (.png or .jpg)")->required();
  app.add_option("--width", settings->width, "in place of the condition's own, px")
      ->check(CLI::Range(100, 20000));
  app.callback([settings] { draw(*settings); });
}

}  // namespace repose::bench
