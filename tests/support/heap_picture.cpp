#include "tests/support/heap_picture.h"

#include <opencv2/core.hpp>

#include "tests/support/heap_camera.h"
#include "tests/support/heap_grains.h"
#include "tests/support/heap_paint.h"
#include "tests/support/heap_profile.h"
#include "tests/support/heap_surroundings.h"

namespace repose::testing {
namespace {

using vision::Point;
using vision::Segment;

std::uint64_t grain_seed(const HeapScene& scene) { return scene.seed ^ hash_of("grains"); }

void paint_photo(Stage& stage, const HeapScene& scene, const HeapProfile& profile,
                 const std::vector<Grain>& grains, Random& random) {
  paint_backdrop(stage, scene, profile, random);
  const bool from_above = scene.form.shape == Shape::oblique;
  if (from_above) paint_table_top(stage, scene, random);
  paint_tube(stage, scene, profile);
  paint_ruler(stage, scene, profile, random);
  paint_core(stage, profile, scene.grain.color);
  paint_grains(stage, grains, scene.grain);
  paint_grains(stage, stray_grains(scene, profile, stage.light.cols, random), scene.grain);
  paint_walls(stage, scene, profile);
  if (!from_above) paint_ground(stage, scene, profile, random);
}

void paint_silhouette(Stage& stage, const HeapProfile& profile, const std::vector<Grain>& grains) {
  stage.light.setTo(cv::Scalar::all(1));
  paint_core(stage, profile, Color{});
  paint_black(stage, grains);
}

/// The numbers that are known before anything is painted.
DrawnHeap truth_of(const HeapScene& scene, const HeapProfile& profile, const Stage& stage,
                   const std::vector<Grain>& grains) {
  const auto place = [&](Point p) {
    return in_picture(scene, stage.margin_px, {p.x, stage.ground_y - p.y});
  };
  const auto placed = [&](std::optional<Segment> line) {
    if (line) line = Segment{place(line->from), place(line->to)};
    return line;
  };
  DrawnHeap heap;
  heap.left_line = placed(profile.flank(Side::left));
  heap.right_line = placed(profile.flank(Side::right));
  if (const auto left = profile.angle(Side::left)) heap.left_rad = left->angle_rad;
  if (const auto right = profile.angle(Side::right)) heap.right_rad = right->angle_rad;
  heap.ground_tilt_rad = scene.camera.tilt_rad;
  heap.ground = {place({profile.left_toe_x(), 0}), place({profile.right_toe_x(), 0})};
  heap.grain_px = profile.grain_px();
  heap.height_px = profile.height_px();
  for (const Point& p : envelope(grains)) heap.outline.push_back(place(p));
  return heap;
}

}  // namespace

std::optional<double> DrawnHeap::mean_rad() const {
  if (left_rad && right_rad) return (*left_rad + *right_rad) / 2;
  return left_rad ? left_rad : right_rad;
}

DrawnHeap heap_truth(const HeapScene& scene) {
  Random random(grain_seed(scene));
  const Stage stage = empty_stage(scene);
  const HeapProfile profile(scene.form, scene.width, stage.margin_px);
  return truth_of(scene, profile, stage, heap_grains(scene, profile, stage.size.width, random));
}

DrawnHeap draw_heap(const HeapScene& scene) {
  Random random(grain_seed(scene));
  Stage stage = empty_stage(scene);
  stage.light.create(stage.size, CV_32FC3);
  const HeapProfile profile(scene.form, scene.width, stage.margin_px);
  const auto grains = heap_grains(scene, profile, stage.size.width, random);
  DrawnHeap heap = truth_of(scene, profile, stage, grains);
  if (scene.style == Style::silhouette) {
    paint_silhouette(stage, profile, grains);
  } else {
    paint_photo(stage, scene, profile, grains, random);
  }
  heap.picture = take_picture(stage, scene, random);
  return heap;
}

}  // namespace repose::testing
