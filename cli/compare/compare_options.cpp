#include "cli/compare/compare_options.h"

#include <algorithm>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/picture_options.h"
#include "cli/common/position_options.h"
#include "cli/compare/compare.h"
#include "dem/experiment/experiment_table.h"
#include "vision/hints/hint_file.h"
#include "vision/measure/scale_bar.h"

namespace repose::cli {

namespace {

using vision::PictureScale;

/// "A,B", or "A" for both.
std::array<std::string, 2> for_each_picture(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return {text, text};
  return {text.substr(0, comma), text.substr(comma + 1)};
}

/// Plausible range, mm: for a pixel, see vision/measure/scale_bar.h; for a heap's base, up to the
/// width of a stockpile.
std::array<double, 2> possible_lengths(PictureScale::From from) {
  constexpr double kNarrowestBase_mm = .1, kWidestBase_mm = 1e6;
  if (from == PictureScale::From::base) return {kNarrowestBase_mm, kWidestBase_mm};
  return {vision::kFinestScale_mm_per_px, vision::kCoarsestScale_mm_per_px};
}

void read_scale(const char* option, const std::string& text, PictureScale::From from,
                ComparePlan& plan) {
  if (text.empty()) return;
  const std::array<std::string, 2> texts = for_each_picture(text);
  for (const std::size_t i : {0, 1}) {
    const auto mm = parse_number<double>(texts[i]);
    const auto [least, most] = possible_lengths(from);
    if (!mm || !(*mm >= least && *mm <= most)) {
      const OptionText typed{option, text, plan.errors};
      typed.refuse(
          fmt::format("one number of mm from {:g} to {:g}, or one for each picture with a comma "
                      "between them",
                      least, most),
          fmt::format("{0} 0.25 or {0} 0.25,0.4", option));
      return;
    }
    plan.comparing.scale[i] = PictureScale{.from = from, .length_m = *mm / 1000};
  }
}

void read_scales(const CompareArguments& arguments, ComparePlan& plan) {
  if (!arguments.mm_per_px.empty() && !arguments.base_mm.empty()) {
    plan.errors.emplace_back(
        "--mm-per-px and --base-mm both give the scale. Fix: give the one you know better.");
  }
  read_scale("--mm-per-px", arguments.mm_per_px, PictureScale::From::pixel, plan);
  read_scale("--base-mm", arguments.base_mm, PictureScale::From::base, plan);
}

/// Whether files beside the pictures may give a scale: they are read with the pictures.
bool may_have_saved_scales(const ComparePlan& plan) {
  const auto has_file = [](const std::filesystem::path& picture) {
    std::error_code ignored;
    return std::filesystem::exists(vision::hint_file_of(picture), ignored);
  };
  return std::any_of(plan.sources.begin(), plan.sources.end(), [&](const HeapSource& source) {
    return !source.is_drawn() && std::ranges::any_of(source.files, has_file);
  });
}

void read_grain(const CompareArguments& arguments, ComparePlan& plan) {
  if (arguments.grain_mm.empty()) return;
  constexpr double kSmallest_mm = 1e-3, kLargest_mm = 1e3;
  const auto mm = read_number_within({"--grain-mm", arguments.grain_mm, plan.errors}, kSmallest_mm,
                                     kLargest_mm, "give the grains' mean diameter in mm");
  if (!mm) return;
  if (arguments.mm_per_px.empty() && arguments.base_mm.empty() && !may_have_saved_scales(plan)) {
    plan.errors.push_back(
        fmt::format("--grain-mm {}: lengths in grains need a scale. Fix: add --mm-per-px or "
                    "--base-mm, or save a scale with repose measure --save-hints.",
                    arguments.grain_mm));
  }
  plan.grain_m = *mm / 1000;
}

void read_margin(const std::string& text, ComparePlan& plan) {
  const auto margin_rad = read_angle({"--margin-deg", text, plan.errors}, "--margin-deg 2");
  plan.comparing.margin_rad = margin_rad.value_or(plan.comparing.margin_rad);
}

void read_camera(const std::string& text, ComparePlan& plan) {
  if (text.empty()) return;
  const OptionText typed{"--camera-mm", text, plan.errors};
  const std::optional<std::vector<double>> mm = numbers_in(text);
  constexpr double kMaxMm = 1e6;
  const auto is_length = [](double length) { return length > 0 && length <= kMaxMm; };
  if (!mm || mm->size() != 2 || !std::all_of(mm->begin(), mm->end(), is_length)) {
    typed.refuse("DISTANCE,HEIGHT in mm, both above 0", "--camera-mm 1500,40");
    return;
  }
  if (mm->back() > mm->front()) {
    typed.refuse("no higher than far away, as a level camera is", "--camera-mm 1500,40");
    return;
  }
  using Kind = HeapSource::Kind;
  const auto has = [&](Kind kind) {
    return std::ranges::any_of(plan.sources,
                               [&](const HeapSource& source) { return source.kind == kind; });
  };
  if (has(Kind::scans)) {
    typed.refuse("left out where there are scans, which are seen as from far away", "leave it out");
    return;
  }
  if (!has(Kind::simulated)) {
    typed.refuse("for simulated heaps, and there are only pictures", "leave it out");
    return;
  }
  plan.camera = {.distance_m = mm->front() / 1000, .height_m = mm->back() / 1000};
}

void read_measuring_of_both(const CompareArguments& arguments, ComparePlan& plan) {
  const std::array<std::string, 2> pitches = for_each_picture(arguments.pitch_deg);
  const auto read = [&](std::size_t i, const std::vector<std::string>& exclude) {
    std::vector<std::string> errors;
    plan.measuring[i] = read_measuring({.method = arguments.method,
                                        .window = arguments.window,
                                        .definition = arguments.definition,
                                        .pitch_deg = pitches[i],
                                        .exclude = exclude,
                                        .fields = kCompareFields[i],
                                        .exclude_option = kExcludeOptions[i]},
                                       errors);
    for (std::string& error : errors) {  // errors that apply to both are reported once
      const auto end = plan.errors.end();
      if (std::find(plan.errors.begin(), end, error) == end) plan.errors.push_back(error);
    }
  };
  read(0, arguments.exclude_first);
  read(1, arguments.exclude_second);
}

/// Refuses options that only apply to two pictures.
void check_options_of_sets(const CompareArguments& arguments, ComparePlan& plan) {
  if (arguments.base_mm.empty()) return;
  plan.errors.emplace_back(
      "--base-mm is the base of one heap, and a set has several. Fix: give --mm-per-px.");
}

/// Refuses options for photographs where they would have no effect.
void check_options_of_drawn(const CompareArguments& arguments, ComparePlan& plan) {
  const std::array<const std::vector<std::string>*, 2> boxes = {&arguments.exclude_first,
                                                                &arguments.exclude_second};
  for (const std::size_t i : {0, 1}) {
    if (!plan.sources[i].is_drawn()) continue;
    const auto refuse = [&](const char* option) {
      plan.errors.push_back(
          fmt::format("{}: {} is {}, its pictures are drawn level, to a known scale and "
                      "without anything else. Fix: leave the option out.",
                      option, plan.sources[i].name,
                      plan.sources[i].kind == HeapSource::Kind::scans ? "scanned" : "simulated"));
    };
    if (!boxes[i]->empty()) refuse(kExcludeOptions[i]);
    const bool is_other_drawn = plan.sources[1 - i].is_drawn();
    for (const auto& [option, text] : {std::pair{"--mm-per-px", &arguments.mm_per_px},
                                       std::pair{"--base-mm", &arguments.base_mm},
                                       std::pair{"--pitch-deg", &arguments.pitch_deg}}) {
      const bool is_for_both = text->find(',') != std::string::npos;
      if (!text->empty() && (is_for_both || is_other_drawn)) refuse(option);
    }
    plan.measuring[i].camera_pitch_rad.reset();
  }
}

/// Not for pairs, as two pictures are two heaps, nor for simulated heaps, whose views belong
/// together anyway.
void read_grouping(const CompareArguments& arguments, ComparePlan& plan) {
  plan.groups_by_name = arguments.groups_by_name;
  if (!plan.groups_by_name) return;
  const bool has_folder = std::ranges::any_of(plan.sources, [](const HeapSource& source) {
    return !source.is_file && !source.is_drawn() && !source.files.empty();
  });
  if (has_folder || !plan.errors.empty()) return;
  plan.errors.emplace_back(
      "--group-by-name: there is no folder of photographs whose names could tell which are of one "
      "heap. Fix: leave it out, or name a folder of photographs.");
}

}  // namespace

ComparePlan plan_compare(const CompareArguments& arguments) {
  ComparePlan plan;
  plan.fields = {kCompareFields[0], kCompareFields[1]};
  plan.sources = calibrate::heap_sources(arguments.pictures, plan.errors);
  read_scales(arguments, plan);
  read_grain(arguments, plan);
  read_margin(arguments.margin_deg, plan);
  read_camera(arguments.camera_mm, plan);
  constexpr std::array kFields{base::FieldName{"margin", "--margin-deg"}};
  for (const base::Fault& problem : plan.comparing.problems()) {
    plan.errors.push_back(problem.text(kFields));
  }
  read_measuring_of_both(arguments, plan);
  plan.overlay_file = arguments.overlay_file;
  read_ending({"--overlay", plan.overlay_file, plan.errors}, {".png", ".jpg", ".jpeg"});
  plan.json_file = arguments.json_file;
  if (!plan.is_pair()) check_options_of_sets(arguments, plan);
  check_options_of_drawn(arguments, plan);
  read_grouping(arguments, plan);
  std::vector<std::filesystem::path> inputs;
  for (const HeapSource& source : plan.sources) {
    inputs.insert(inputs.end(), source.files.begin(), source.files.end());
  }
  check_output_places(
      {{"--overlay", plan.overlay_file}, json_place(plan.json_file, "\"margin_deg\"")}, inputs,
      plan.errors);
  return plan;
}

namespace {

constexpr const char* kCompareNotes = R"(
Each picture is a level side view of one heap: a photograph or a rendered
silhouette. Both are measured as by repose measure, rotated until their ground
is level, and aligned by axis and ground line. The axis is the middle of the
silhouette between 20 and 80 % of its height; where a side is missing, the
crests are aligned instead. All differences are the first minus the second.

Verdict on the angles, from the 95 % interval of their difference:
  equivalent   the interval lies within the margin
  different    it does not, and it excludes 0
  cannot tell  otherwise
The verdict on two pictures is about these two heaps. Heaps of the same grains
differ too: give folders instead of pictures to compare sets of heaps by their
means, which is a verdict on the grains. A folder contains photographs, one per
heap (with --group-by-name, those whose names differ only in a last number after
_ or - show one heap, which has their mean), or simulated heaps, as written
by repose simulate heap --out and repose calibrate --out; a .vtp file is one
such heap, as is a file of particles of another program (see repose measure
--help). Simulated heaps are drawn as seen from far away. A level camera three
widths from the heap reads some .8 degrees less, for the nuts of the sample:
--camera-mm says where the photographs were taken from, as the lens's distance
from the heap's middle and its height above the ground, so that both sets are
seen alike. A three-dimensional scan, or a folder of them, is
drawn likewise: its angle here is that of its silhouettes, not of its slices.
A photograph compared with one scan shows one side only: the scatter of the
scan's views is in the interval.

Scale: mm per pixel, or the known width of the base. One value applies to both
pictures, A,B to one each. A scale that repose measure --save-hints has saved
beside both pictures is used if none is given. Without a scale only shapes are
compared, and lengths are relative to the square root of a silhouette's area.
)";

}  // namespace

Command compare_command() {
  const auto given = std::make_shared<CompareArguments>();
  constexpr int kPictures = 2;
  return {
      .name = "compare",
      .summary = "Compare two heaps, or two sets of heaps",
      .options =
          {{"heaps", "HEAPS HEAPS", "Two pictures, or folders of heaps", &given->pictures, true,
            kPictures},
           {"--mm-per-px", "A[,B]", "Scale: millimetres per pixel", &given->mm_per_px},
           {"--base-mm", "A[,B]", "Scale: known width of the base", &given->base_mm},
           {"--grain-mm", "D", "Grain size, for lengths in grains", &given->grain_mm},
           {"--margin-deg", "DEGREES", "Negligible difference (2)", &given->margin_deg},
           {"--camera-mm", "DISTANCE,HEIGHT", "Camera before simulated heaps (far away)",
            &given->camera_mm},
           {"--method", "auto|paper", "Method of measuring (auto)", &given->method},
           {"--window", "FROM,TO", "Fitted part of the height (0.2,0.8)", &given->window},
           {"--definition", "NAME", "Which angle it is (flank_20_80)", &given->definition},
           {"--pitch-deg", "A[,B]", "Cameras' downward pitch (unknown)", &given->pitch_deg},
           {"--exclude-first", "X,Y,W,H", "Box to ignore; repeatable", &given->exclude_first},
           {"--exclude-second", "X,Y,W,H", "Box to ignore; repeatable", &given->exclude_second},
           {"--group-by-name", "", "a_1.jpg and a_2.jpg are of one heap", &given->groups_by_name},
           {"--overlay", "FILE.png", "Draw both outlines", &given->overlay_file},
           {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kCompareNotes,
      .missing =
          "two pictures or folders are needed. Fix: repose compare photo.jpg render.png, or repose "
          "compare photos heaps.",
      .run = [given] { return run_compare(*given); }};
}

}  // namespace repose::cli
