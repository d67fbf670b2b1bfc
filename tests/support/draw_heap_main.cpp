#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include "tests/support/heap_conditions.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace {

using nlohmann::ordered_json;
using repose::testing::DrawnHeap;

ordered_json degrees(std::optional<double> angle_rad) {
  if (!angle_rad) return nullptr;
  return *angle_rad * 180 / std::numbers::pi;
}

ordered_json ends(const std::optional<repose::vision::Segment>& line) {
  if (!line) return nullptr;
  return {line->from.x, line->from.y, line->to.x, line->to.y};
}

ordered_json truth_of(const DrawnHeap& heap, const std::string& condition, std::uint64_t seed) {
  return {{"condition", condition},
          {"seed", seed},
          {"angle_deg", degrees(heap.mean_rad())},
          {"left_deg", degrees(heap.left_rad)},
          {"right_deg", degrees(heap.right_rad)},
          {"ground_tilt_deg", degrees(heap.ground_tilt_rad)},
          {"ground_px", ends(heap.ground)},
          {"left_line_px", ends(heap.left_line)},
          {"right_line_px", ends(heap.right_line)},
          {"height_px", heap.height_px},
          {"grain_px", heap.grain_px}};
}

void run(const std::string& condition, std::uint64_t seed, const std::filesystem::path& file,
         int width) {
  auto scene = repose::testing::condition_named(condition).scene(seed);
  if (width > 0) {
    scene.height = scene.height * width / scene.width;
    scene.width = width;
  }
  const DrawnHeap heap = repose::testing::draw_heap(scene);
  repose::vision::write_picture(file, heap.picture);
  auto truth_file = file;
  std::ofstream(truth_file.replace_extension(".truth.json"))
      << truth_of(heap, condition, seed).dump(2) << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Draws a heap with known angles, and OUT.truth.json beside it.");
  std::string condition;
  std::uint64_t seed = 1;
  std::string file;
  int width = 0;
  bool list = false;
  app.add_option("CONDITION", condition, "Kind of picture, see --list");
  app.add_option("SEED", seed, "Seed of everything random");
  app.add_option("OUT", file, "Picture to write (.png or .jpg)");
  app.add_option("--width", width, "Width instead of the condition's own [px]")
      ->check(CLI::Range(100, 20000));
  app.add_flag("--list", list, "List the conditions");
  CLI11_PARSE(app, argc, argv);
  try {
    if (list) {
      for (const auto& entry : repose::testing::conditions()) fmt::print("{}\n", entry.name);
      return 0;
    }
    if (file.empty())
      throw std::invalid_argument("OUT is missing. Fix: draw_heap CONDITION SEED OUT.");
    run(condition, seed, file, width);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "draw_heap: {}\n", error.what());
    return 2;
  }
}
