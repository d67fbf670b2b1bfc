#include "tests/bench/board_subjects.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include <Eigen/Geometry>

#include "render/truth.h"
#include "tests/bench/grain_cone.h"
#include "tests/bench/photograph.h"
#include "tests/support/heap_draft.h"
#include "tests/support/heap_random.h"
#include "tests/support/nut_heap.h"

namespace repose::bench {
namespace {

using Eigen::Vector3d;
using testing::BoardCamera;
using testing::radians;
using testing::Random;

/// Nuts make heaps of a metre; the scene is scaled down to suit an A4 board.
constexpr double kMm_per_m = 250;

render::PhotoStyle photo_style(Random& random) {
  testing::HeapScene scene;
  constexpr double kMinContrast = 32;
  testing::choose_colors(scene, kMinContrast, 200, random);
  render::PhotoStyle style;
  style.grain = colour_of(scene.grain.color);
  style.gloss = scene.grain.gloss;
  style.brightness_spread = random.uniform(.08, .2);
  style.backdrop = colour_of(scene.around.backdrop);
  style.plate = colour_of(scene.around.plate);
  style.table = colour_of(scene.around.table);
  style.noise = random.uniform(.004, .012);
  style.blur_px = random.uniform(.45, .9);
  style.passes = 2;
  style.seed = random.seed();
  return style;
}

vision::Picture drawn(const render::Scene& scene, const render::Camera& camera,
                      const render::Style& style) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  static render::Renderer renderer;
  return renderer.draw(scene, camera, kPhotograph, style).picture;
}

/// Height and width of the lightly smoothed outline, as the measurement defines them.
void set_sizes(const render::Scene& scene, HeapWithBoard& heap) {
  const render::Truth truth =
      truth_of(scene, render::OrthographicCamera{}, kPhotograph, render::Shown::mesh);
  const double scale = truth.mm_per_px * kMm_per_m / 1e3;
  const auto& outline = truth.outline;
  const std::size_t half = std::max<std::size_t>(3, outline.size() / 40) / 2;
  double highest = outline.front().y;
  for (std::size_t i = half; i + half < outline.size(); ++i) {
    double mean = 0;
    for (std::size_t k = i - half; k <= i + half; ++k) mean += outline[k].y;
    highest = std::min(highest, mean / static_cast<double>(2 * half + 1));
  }
  heap.height_mm = scale * (truth.ground->from.y - highest);
  heap.base_mm = scale * (outline.back().x - outline.front().x);
  heap.angle_rad = std::atan2(heap.height_mm, heap.base_mm / 2);
}

/// Puts a camera with a lens in front of the heap, which stands beside the picture's middle.
render::PerspectiveCamera camera_before(const render::Scene& scene, double radius_m, double side,
                                        HeapWithBoard& heap, Random& random) {
  const double distance_m = radius_m * random.uniform(6, 11);
  heap.pitch_rad = radians(random.uniform(0, 8));
  heap.roll_rad = radians(random.uniform(-2, 2));
  // The heap takes a third to a half of the picture.
  const double width_m = 2 * radius_m / random.uniform(.38, .5);
  render::PerspectiveCamera camera =
      render::camera_on({.distance_m = distance_m,
                         .pitch_rad = heap.pitch_rad,
                         .focal_mm = kFilm_mm * distance_m / width_m},
                        scene, kPhotograph);
  camera.roll_rad = heap.roll_rad;
  camera.position_m.x() += side * .2 * width_m;
  const double picture_side = .5 * kFilm_mm / camera.focal_mm;
  camera.k1 = random.uniform(-.05, .03) / (picture_side * picture_side);
  // A sheet that is a quarter of the picture wide.
  heap.square_mm = std::round(.25 * width_m * kMm_per_m / 12.3);
  heap.camera = {.width = kPhotograph.width,
                 .height = kPhotograph.height,
                 .focal_px = camera.focal_mm / kFilm_mm * kPhotograph.width,
                 .centre_x_px = kPhotograph.width / 2.0,
                 .centre_y_px = kPhotograph.height / 2.0,
                 .k1 = camera.k1};
  return camera;
}

/// Sets the exact values of what the camera sees of the heap.
void set_views(const Eigen::Matrix3d& view, const Vector3d& eye_mm, HeapWithBoard& heap) {
  heap.mm_per_px = (view * -eye_mm).z() / heap.camera.focal_px;
  const auto seen = [&](double aside_mm) {
    return heap.camera.seen(view * (Vector3d(aside_mm, 0, heap.height_mm) - eye_mm));
  };
  const double half_mm = heap.base_mm / 3;
  heap.bar = {.line = {seen(-half_mm), seen(half_mm)}, .length_mm = 2 * half_mm};
}

/// The board as people place it: upright, in the plane of the heap's middle, with its foot on the
/// ground, all within what they can see.
testing::BoardPlace board_beside(const Eigen::Matrix3d& view, const Vector3d& eye_mm,
                                 double beside_mm, const HeapWithBoard& heap, Random& random) {
  const double printed_mm = heap.square_mm * random.normal(1, .0025);
  const double really_behind_mm = heap.board_offset_mm + random.normal(0, 5);
  // The plane of board and heap does not quite face the camera, and the board is not quite in it.
  const double plane_rad = heap.board_offset_mm > 0 ? 0 : radians(random.uniform(-8, 8));
  const auto upright = testing::placed_board(
      Vector3d::Zero(), plane_rad + radians(random.normal(0, 1.5)), radians(random.normal(0, .5)),
      radians(random.normal(0, .3)), printed_mm);
  // From the directions of a level camera to the world's, and from there to the camera's.
  Eigen::Matrix3d world_from_level;
  world_from_level << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const Vector3d middle_mm(beside_mm * std::cos(plane_rad),
                           really_behind_mm - beside_mm * std::sin(plane_rad), 4.8 * printed_mm);
  testing::BoardPlace place = upright;
  place.rotation = view * world_from_level * upright.rotation;
  place.origin_mm = view * (middle_mm - eye_mm + world_from_level * upright.origin_mm);
  return place;
}

}  // namespace

BoardCamera any_camera(std::uint64_t seed) {
  Random random(seed * 0x9E3779B97F4A7C15 ^ testing::hash_of("camera"));
  BoardCamera camera;
  camera.width = kPhotograph.width;
  camera.height = kPhotograph.height;
  camera.focal_px = camera.width * random.uniform(.75, 1.6);
  camera.centre_x_px = camera.width * (.5 + random.uniform(-.015, .015));
  camera.centre_y_px = camera.height * (.5 + random.uniform(-.015, .015));
  const double side = .5 * camera.width / camera.focal_px;  // of the picture, in focal lengths
  camera.k1 = random.uniform(-.06, .04) / (side * side);
  if (random.chance(.5)) camera.k2 = random.uniform(-.02, .02) / std::pow(side, 4);
  if (random.chance(.3)) {
    camera.p1 = random.uniform(-.002, .002);
    camera.p2 = random.uniform(-.002, .002);
  }
  return camera;
}

std::vector<vision::BoardPicture> board_pictures(const BoardCamera& camera, int count,
                                                 std::uint64_t seed) {
  Random random(seed * 0x9E3779B97F4A7C15 ^ testing::hash_of("boards"));
  std::vector<vision::BoardPicture> pictures;
  for (int i = 0; i < count; ++i) {
    // About half as wide as the picture, its middle anywhere that mostly keeps it inside.
    const double distance_mm = camera.focal_px / camera.width * random.uniform(420, 600);
    const vision::Point middle{camera.width * random.uniform(.28, .72),
                               camera.height * random.uniform(.3, .7)};
    const auto place = testing::placed_board(
        distance_mm * camera.direction(middle), radians(random.uniform(-38, 38)),
        radians(random.uniform(-38, 38)), radians(random.uniform(-12, 12)));
    const testing::BoardLook look{
        .blur_px = random.uniform(.5, 1.1), .noise = random.uniform(1, 5), .seed = random.seed()};
    pictures.push_back({.file = "picture",
                        .width = camera.width,
                        .height = camera.height,
                        .corners = vision::find_board(board_photo(camera, place, look))});
  }
  return pictures;
}

HeapWithBoard heap_with_board(std::uint64_t seed, bool stands_behind) {
  Random random(seed * 0x9E3779B97F4A7C15 ^ testing::hash_of("heap and board"));
  const GrainCone cone{.angle_rad = radians(random.uniform(20, 33)),
                       .grains_high = random.uniform(14, 22),
                       .crest = random.uniform(.05, .2),
                       .lopsided = random.uniform(0, .02),
                       .seed = random.seed()};
  const double radius_m = base_radius_m(cone);
  render::Scene scene = scene_of(cone);
  scene.walls.front() = testing::plate(8 * radius_m);
  const double side = random.chance(.5) ? 1 : -1;
  HeapWithBoard heap;
  const render::PerspectiveCamera camera = camera_before(scene, radius_m, side, heap, random);
  heap.picture = drawn(scene, camera, photo_style(random));
  set_sizes(scene, heap);
  const Eigen::Matrix3d view = testing::camera_from_world(heap.pitch_rad, heap.roll_rad);
  const Vector3d eye_mm = camera.position_m * kMm_per_m;
  set_views(view, eye_mm, heap);
  if (stands_behind)
    heap.board_offset_mm = std::round(random.uniform(.3, 1) * radius_m * kMm_per_m);
  const double beside_mm = side * (radius_m * kMm_per_m + 6.6 * heap.square_mm);
  const testing::BoardPlace place = board_beside(view, eye_mm, beside_mm, heap, random);
  heap.board_box = testing::sheet_box(heap.camera, place);
  draw_board(
      heap.camera, place,
      {.blur_px = random.uniform(.5, 1), .noise = random.uniform(1, 4), .seed = random.seed()},
      heap.picture);
  return heap;
}

}  // namespace repose::bench
