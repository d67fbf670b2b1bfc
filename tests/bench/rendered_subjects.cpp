#include "tests/bench/rendered_subjects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numbers>
#include <variant>

#include "render/truth.h"
#include "tests/bench/grain_cone.h"
#include "tests/bench/outline_angles.h"
#include "tests/bench/photograph.h"
#include "tests/support/flank_law.h"
#include "tests/support/heap_camera.h"
#include "tests/support/heap_draft.h"
#include "tests/support/nut_heap.h"
#include "vision/measure/camera_pitch.h"

namespace repose::bench {
namespace {

using testing::Group;
using testing::hash_of;
using testing::radians;
using testing::Random;

/// Everything that defines a picture.
struct Staging {
  GrainCone cone;
  render::Camera camera = {};
  render::Style style = {};
  int jpeg_quality = 0;                       ///< 0: not compressed
  std::optional<double> told_pitch_rad = {};  ///< given to the measurement
};

/// A staging under construction, and the random numbers it is made from.
struct Draft {
  Staging staging;
  render::Scene scene;
  Random random;
};

/// A seed's heap is the same under all conditions.
GrainCone cone_of(std::uint64_t seed) {
  Random random(seed * 0x9E3779B97F4A7C15 ^ hash_of("cone"));
  constexpr double kFewest = 10, kMax = 24, kWidestRadius = 42;
  GrainCone cone{.angle_rad = radians(random.uniform(15, 35))};
  const double most = std::clamp(kWidestRadius * std::tan(cone.angle_rad), kFewest, kMax);
  cone.grains_high = random.uniform(kFewest, most);
  cone.crest = random.uniform(.05, .2);
  cone.lopsided = random.uniform(0, .06);
  cone.seed = random.seed();
  return cone;
}

render::PhotoStyle photo_style(double least_contrast, Random& random) {
  testing::HeapScene scene;
  testing::choose_colors(scene, least_contrast, 200, random);
  render::PhotoStyle style;
  style.grain = colour_of(scene.grain.color);
  style.gloss = scene.grain.gloss;
  style.pattern = random.uniform(0, 1);
  style.brightness_spread = random.uniform(.08, .2);
  style.backdrop = colour_of(scene.around.backdrop);
  style.plate = colour_of(scene.around.plate);
  style.table = colour_of(scene.around.table);
  for (std::size_t c = 0; c < 3; ++c) style.spot[c] = .5 * (1 + style.grain[c]);
  style.key_softness_rad = random.uniform(.15, .3);
  style.vignette = random.uniform(.03, .15);
  style.noise = random.uniform(.004, .012);
  style.blur_px = random.uniform(.45, .7);
  style.passes = 6;
  style.seed = random.seed();
  return style;
}

/// A well-lit photograph in parallel projection: the start of every condition.
Draft draft_of(const GrainCone& cone, std::string_view condition, std::uint64_t seed) {
  constexpr double kMinContrast = 32;
  Draft draft{.staging = {.cone = cone},
              .scene = {},
              .random = Random(seed * 0x9E3779B97F4A7C15 ^ hash_of(condition))};
  auto& [staging, scene, random] = draft;
  scene = scene_of(staging.cone);
  const double azimuth_rad = random.uniform(0, 2 * std::numbers::pi);
  // The plate is aligned with the picture, as people do.
  scene.walls.front().pose.orientation = Eigen::AngleAxisd(azimuth_rad, dem::Vector::UnitZ());
  const double radius_m = base_radius_m(staging.cone);
  const double fraction = random.uniform(.5, .75);
  const double m_per_px = 2 * radius_m / (fraction * kPhotograph.width);
  staging.camera = render::OrthographicCamera{
      .azimuth_rad = azimuth_rad,
      .mm_per_px = 1e3 * m_per_px,
      .middle_m = dem::Vector(0, 0, random.uniform(.15, .3) * kPhotograph.height * m_per_px)};
  staging.style = photo_style(kMinContrast, random);
  staging.jpeg_quality = random.integer(85, 96);
  return draft;
}

Draft draft(std::string_view condition, std::uint64_t seed) {
  return draft_of(cone_of(seed), condition, seed);
}

render::PhotoStyle& photo(Draft& draft) {
  return std::get<render::PhotoStyle>(draft.staging.style);
}

/// Puts a camera with a lens in front of the heap. Distance in base radii, from the heap's middle.
render::PerspectiveCamera& set_lens(Draft& draft, double distance, double pitch_rad = 0) {
  const auto& level = std::get<render::OrthographicCamera>(draft.staging.camera);
  const double radius_m = base_radius_m(draft.staging.cone);
  const double width_m = 1e-3 * level.mm_per_px.value() * kPhotograph.width;
  const double distance_m = distance * radius_m;
  draft.staging.camera = render::camera_on({.azimuth_rad = level.azimuth_rad,
                                            .distance_m = distance_m,
                                            .pitch_rad = pitch_rad,
                                            .focal_mm = kFilm_mm * distance_m / width_m},
                                           draft.scene, kPhotograph);
  return std::get<render::PerspectiveCamera>(draft.staging.camera);
}

/// At least three heap widths away, as the instructions require.
double good_distance(Random& random) { return random.uniform(6, 10); }

void make_silhouette(Draft& draft) {
  draft.staging.style = render::SilhouetteStyle{.shows_ground = draft.random.chance(.5)};
  draft.staging.jpeg_quality = 0;
}

Draft silhouette(std::uint64_t seed) {
  Draft made = draft("silhouette", seed);
  make_silhouette(made);
  return made;
}

Draft parallel_rays(std::uint64_t seed) { return draft("parallel_rays", seed); }

Draft lens(std::uint64_t seed) {
  Draft made = draft("lens", seed);
  set_lens(made, good_distance(made.random));
  return made;
}

Draft distortion(std::uint64_t seed) {
  Draft made = draft("distortion", seed);
  auto& camera = set_lens(made, good_distance(made.random));
  const double side_r = .5 * kFilm_mm / camera.focal_mm;
  camera.k1 = made.random.uniform(-.03, .03) / (side_r * side_r);
  return made;
}

Draft roll(std::uint64_t seed) {
  Draft made = draft("roll", seed);
  auto& camera = set_lens(made, good_distance(made.random));
  const double roll_rad = radians(made.random.uniform(1, 2.5));
  camera.roll_rad = made.random.chance(.5) ? roll_rad : -roll_rad;
  return made;
}

Draft hard_light(std::uint64_t seed) {
  Draft made = draft("hard_light", seed);
  set_lens(made, good_distance(made.random));
  photo(made).key_softness_rad = made.random.uniform(.02, .05);
  photo(made).key_fraction = made.random.uniform(.75, .85);
  photo(made).vignette = made.random.uniform(.3, .5);
  return made;
}

Draft blur_noise_jpeg(std::uint64_t seed) {
  Draft made = draft("blur_noise_jpeg", seed);
  set_lens(made, good_distance(made.random));
  photo(made).blur_px = made.random.uniform(1.5, 3);
  photo(made).noise = made.random.uniform(.025, .05);
  made.staging.jpeg_quality = made.random.integer(40, 70);
  return made;
}

/// The heap's surface of revolution is a power of the cone's height. The true angle is by the
/// definition on the exact outline of its grains, as for the other conditions; the outline follows
/// that of the smooth surface except for their bumps.
Draft hollowed(std::string_view condition, std::uint64_t seed) {
  Random random(seed * 0x9E3779B97F4A7C15 ^ hash_of("hollow"));
  GrainCone cone = cone_of(seed);
  cone.angle_rad *= .85;  // hollow ones are steeper in the window
  const double height_m = cone.grains_high * testing::kNutWidth_m;
  cone.hollow = testing::hollow_of_bend(testing::Flanks::power, height_m / base_radius_m(cone),
                                        radians(random.uniform(3.5, 7.5)));
  return draft_of(cone, condition, seed);
}

Draft hollow_silhouette(std::uint64_t seed) {
  Draft made = hollowed("hollow_silhouette", seed);
  make_silhouette(made);
  return made;
}

Draft hollow_lens(std::uint64_t seed) {
  Draft made = hollowed("hollow_lens", seed);
  set_lens(made, good_distance(made.random));
  return made;
}

Draft pitched(std::uint64_t seed) {
  Draft made = draft("pitched", seed);
  const double distance = good_distance(made.random);
  set_lens(made, distance, radians(made.random.uniform(2, 10)));
  return made;
}

Draft pitch_told(std::uint64_t seed) {
  Draft made = pitched(seed);
  made.staging.told_pitch_rad = std::get<render::PerspectiveCamera>(made.staging.camera).pitch_rad;
  return made;
}

Draft near_lens(std::uint64_t seed) {
  Draft made = draft("near_lens", seed);
  set_lens(made, made.random.uniform(2.5, 4));
  return made;
}

struct RenderedCondition {
  std::string_view name;
  Group group;
  Draft (*draft)(std::uint64_t seed);
};

constexpr std::array kConditions = {
    RenderedCondition{"silhouette", Group::clean, silhouette},
    RenderedCondition{"parallel_rays", Group::clean, parallel_rays},
    RenderedCondition{"lens", Group::clean, lens},
    RenderedCondition{"distortion", Group::degraded, distortion},
    RenderedCondition{"roll", Group::degraded, roll},
    RenderedCondition{"hard_light", Group::degraded, hard_light},
    RenderedCondition{"blur_noise_jpeg", Group::degraded, blur_noise_jpeg},
    RenderedCondition{"pitch_told", Group::degraded, pitch_told},
    RenderedCondition{"hollow_silhouette", Group::hollow, hollow_silhouette},
    RenderedCondition{"hollow_lens", Group::hollow, hollow_lens},
    RenderedCondition{"pitch_not_told", Group::misplaced, pitched},
    RenderedCondition{"near_lens", Group::misplaced, near_lens},
};

/// One picture at a time: the driver uses all cores for each.
vision::Picture drawn(const render::Scene& scene, const Staging& staging) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  static render::Renderer renderer;
  return renderer.draw(scene, staging.camera, kPhotograph, staging.style).picture;
}

FlankAngles angles_seen_by(const render::Camera& camera, const Draft& draft) {
  const render::Truth truth = truth_of(draft.scene, camera, kPhotograph, render::Shown::mesh);
  const double grain_px = 1e3 * testing::kNutWidth_m / truth.mm_per_px;
  return draft.staging.cone.hollow == 1 ? outline_angles(truth, grain_px)
                                        : defined_angles(truth, grain_px);
}

KnownPicture taken(const Draft& draft) {
  const auto& [staging, scene, random] = draft;
  KnownPicture known{.picture = drawn(scene, staging),
                     .heap = angles_seen_by(staging.camera, draft),
                     .told_pitch_rad = staging.told_pitch_rad};
  if (staging.jpeg_quality > 0) {
    known.picture = testing::jpeg_compressed(known.picture, staging.jpeg_quality);
  }
  const auto* lens = std::get_if<render::PerspectiveCamera>(&staging.camera);
  if (lens == nullptr) return known;
  known.seen = known.heap;
  for (auto* angle_rad : {&known.seen.left_rad, &known.seen.right_rad}) {
    const double pitch_rad = staging.told_pitch_rad.value_or(0);
    *angle_rad = vision::angle_without_pitch(angle_rad->value(), pitch_rad);
  }
  known.heap = angles_seen_by(render::OrthographicCamera{.azimuth_rad = lens->azimuth_rad}, draft);
  return known;
}

}  // namespace

std::vector<Subject> rendered_subjects(int seeds, std::uint64_t first_seed) {
  std::vector<Subject> subjects;
  for (const RenderedCondition& condition : kConditions) {
    for (int i = 0; i < seeds; ++i) {
      const std::uint64_t seed = first_seed + static_cast<unsigned>(i);
      subjects.push_back({.section = "rendered",
                          .condition = condition.name,
                          .group = condition.group,
                          .seed = seed,
                          .take = [&condition, seed] { return taken(condition.draft(seed)); }});
    }
  }
  return subjects;
}

}  // namespace repose::bench
