#include "calibrate/report/heap_chapter.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/scan_angle.h"
#include "calibrate/report/document.h"
#include "calibrate/report/heap_model.h"
#include "calibrate/report/picture_data.h"
#include "calibrate/report/wording.h"
#include "dem/experiment/experiment_table.h"
#include "dem/state/state_file.h"
#include "render/renderer.h"
#include "vision/compare/heap_comparison.h"
#include "vision/drawing/heap_comparison_overlay.h"
#include "vision/drawing/overlay.h"
#include "vision/files/heap_file.h"
#include "vision/hints/hint_file.h"
#include "vision/scan/scan_file.h"

namespace repose::calibrate::report {
namespace {

constexpr int kShownViews = 3;
constexpr double kNothing_deg = 360;        // farther off than any angle
constexpr std::size_t kFewPhotographs = 6;  // number that fits on half a page

/// A picture, or a film's heap at rest, and its measurement.
struct MeasuredHeap {
  std::string title;
  vision::Picture picture;
  vision::ReposeAngle angle;
};

/// Whether the reported coefficients differ from those of the last check.
bool has_moved(const StudyResult& result) {
  const auto* joint = std::get_if<JointResult>(&result.found);
  if (joint == nullptr) return false;
  const std::vector<double>& checked = joint->agreement.values;
  return !std::equal(joint->parameters.begin(), joint->parameters.end(), checked.begin(),
                     checked.end(),
                     [](const auto& parameter, double value) { return parameter.value == value; });
}

std::string angle_text(const vision::ReposeAngle& angle) {
  if (!angle.angle_rad) return "refused: " + angle.reason;
  std::string text = fmt::format("angle of repose {}°", shown(*angle.angle_rad / kDegree, 2));
  if (angle.uncertainty_rad) {
    text += fmt::format(" ± {}°", shown(*angle.uncertainty_rad / kDegree, 2));
  }
  if (angle.status == vision::MeasureStatus::flagged) text += ", flagged";
  return text;
}

ShownPicture with_overlay(const MeasuredHeap& heap, int side_px, const std::string& what) {
  const vision::Picture overlay =
      vision::draw_overlay(heap.picture, heap.angle, {.title = heap.title, .excluded = {}});
  const std::string measured = angle_text(heap.angle);
  return shown_picture(
      overlay, side_px,
      fmt::format("{} {} with its outline, ground line and fitted flanks drawn "
                  "in; {}",
                  what, heap.title, measured),
      fmt::format("{} {}: {}{}", what, heap.title, measured, measured.ends_with('.') ? "" : "."));
}

std::optional<MeasuredHeap> measured_photograph(const PictureReading& picture,
                                                const std::string& definition,
                                                std::vector<std::string>& remarks) {
  const std::string name = shortened(picture.file.filename().string());
  try {
    MeasuredHeap heap{.title = name, .picture = {}, .angle = {}};
    vision::PictureSettings given;
    given.measuring.definition = definition;
    std::optional<double> angle_rad;
    if (vision::has_scan_ending(picture.file)) {
      ScanViews seen = measure_scan_file(picture.file, given.measuring);
      heap.title += ", one of its views";
      heap.picture = std::move(seen.typical_picture);
      heap.angle = std::move(seen.views[seen.typical]);
      angle_rad = seen.angle.angle_rad;
    } else {
      vision::HeapInFile seen = vision::measure_heap_file(picture.file, given);
      heap.picture = seen.measured();
      heap.angle = std::move(seen.heap.angle);
      angle_rad = heap.angle.angle_rad;
    }
    constexpr double kSame_deg = 0.01;
    const bool is_same =
        angle_rad && std::abs(*angle_rad / kDegree - picture.angle_deg.value_or(0)) <= kSame_deg;
    if (picture.angle_deg && !is_same) {
      remarks.push_back(
          fmt::format("{} gave {}° when the study was made, but not now: the file or the program "
                      "has changed since.",
                      name, shown(picture.angle_deg, 2)));
    }
    return heap;
  } catch (const base::InputError& error) {
    remarks.push_back(
        fmt::format("The photograph {} cannot be shown: {}", name, shortened(error.what(), 400)));
    return std::nullopt;
  }
}

/// Index of the representative photograph; std::nullopt if none gave an angle.
std::optional<std::size_t> most_typical(const std::vector<MeasuredHeap>& heaps) {
  std::vector<PictureAngle> angles;
  for (const MeasuredHeap& heap : heaps) {
    angles.push_back({heap.angle.status, heap.angle.angle_rad});
  }
  const PictureMean mean = mean_of_pictures(angles);
  if (!mean.angle_deg) return std::nullopt;
  const auto rank = [&](std::size_t k) {
    const auto angle_rad = angle_by(angles[k], {});
    const double off_deg =
        angle_rad ? std::abs(*angle_rad / kDegree - mean.angle_deg->mean) : kNothing_deg;
    return std::pair(!angle_rad || angles[k].status != vision::MeasureStatus::ok, off_deg);
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < heaps.size(); ++k) {
    if (rank(k) < rank(best)) best = k;
  }
  return best;
}

/// Adds the photographs; returns the representative one.
std::optional<MeasuredHeap> show_photographs(const ReportedStudy& study, HeapPictures& shown) {
  const int side_px = longest_side_px(study.pictures.size());
  shown.is_scanned = std::ranges::any_of(study.pictures, [](const PictureReading& picture) {
    return vision::has_scan_ending(picture.file);
  });
  std::vector<MeasuredHeap> heaps;
  for (const PictureReading& picture : study.pictures) {
    std::optional<MeasuredHeap> heap =
        measured_photograph(picture, shown.definition, shown.remarks);
    if (!heap) continue;
    shown.photographs.push_back(
        with_overlay(*heap, side_px, shown.is_scanned ? "Scan" : "Photograph"));
    heaps.push_back(*std::move(heap));
  }
  shown.best_photograph = most_typical(heaps);
  if (!shown.best_photograph) return std::nullopt;
  return std::move(heaps[*shown.best_photograph]);
}

/// The camera of the study's photographs, if stated.
std::optional<dem::LevelCamera> stated_camera(const ReportedStudy& study) {
  if (!study.record) return std::nullopt;
  const auto& experiments = study.record->study.experiments;
  const dem::ExperimentEntry& pictured = dem::pictured_experiment();
  const auto described = experiments.find(&pictured);
  if (described == experiments.end()) return std::nullopt;
  return pictured.camera(described->second.protocol);
}

MeasuredHeap rendered(const HeapViewSession& session, int view, const std::string& definition) {
  render::Renderer renderer;
  vision::MeasureOptions options;
  options.definition = definition;
  TakenView taken = session.take(renderer, view, options);
  return {.title = fmt::format("from {}° (rendering)", 180 * view / session.views()),
          .picture = std::move(taken.picture),
          .angle = std::move(taken.angle)};
}

ShownPicture camera_look(const render::Scene& scene, const dem::LevelCamera& camera,
                         const std::optional<render::Colour>& grain_colour) {
  constexpr render::PictureSize kSize{.width = 1050, .height = 700};
  constexpr int kPasses = 8;
  const render::LabStand stand{.distance_m = camera.distance_m, .height_m = camera.height_m};
  render::PhotoStyle style = render::photo_of_grains(grain_colour);
  style.passes = kPasses;
  render::Renderer renderer;
  MeasuredHeap heap{.title = "as a camera sees it (rendering)", .picture = {}, .angle = {}};
  heap.picture = renderer.draw(scene, render::camera_on(stand, scene, kSize), kSize, style).picture;
  heap.angle = vision::measure_repose_angle(heap.picture);
  if (heap.angle.angle_rad) return with_overlay(heap, kSize.width, "Simulated heap,");
  return shown_picture(
      heap.picture, kSize.width, "Rendering of the simulated heap as a camera would see it",
      "Rendering, not a photograph: the heap simulated with the fitted coefficients, as a camera "
      "would see it.");
}

Table comparison_table(const vision::HeapComparison& comparison) {
  Table table{.name = "outline_comparison",
              .title = "Bench and simulation, scaled to the same silhouette area",
              .data = {.columns = {{.name = "quantity", .unit = {}},
                                   {.name = "value", .unit = {}, .decimals = 3}},
                       .rows = {}}};
  const auto add = [&](const char* name, const std::optional<double>& value) {
    table.data.add({std::string(name), cell(value)});
  };
  add("overlap of the silhouettes (IoU; 1: identical)", comparison.iou);
  add("root mean square difference in height [√area]", comparison.profile_rmse);
  add("Hausdorff distance of the outlines [√area]", comparison.hausdorff);
  if (comparison.angle) {
    add("difference of the angles, bench − simulation [°]",
        comparison.angle->difference_rad / kDegree);
    add("95 % interval from [°]", comparison.angle->interval_rad[0] / kDegree);
    add("95 % interval to [°]", comparison.angle->interval_rad[1] / kDegree);
  }
  return table;
}

Chart outline_chart(const vision::HeapComparison& comparison) {
  const std::string unit = comparison.unit == vision::LengthUnit::metre ? "m" : "√area";
  Chart chart =
      plane_chart("outlines", "Superimposed outlines", {.name = "along the ground", .unit = unit},
                  {.name = "height", .unit = unit});
  chart.caption =
      "Aligned by ground line and axis. Solid: bench; dashed: simulation. Single grains may "
      "differ; slopes should not.";
  const std::array<std::string, 2> names = {"bench", "simulation"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    // More points than the page is wide would show nothing more.
    constexpr std::size_t kMaxPoints = 600;
    const auto& outline = comparison.outlines[k];
    const std::size_t stride = outline.size() / kMaxPoints + 1;
    for (std::size_t i = 0; i < outline.size(); i += stride) {
      add_point(chart, names[k], k == 0 ? Look::fit : Look::limit, outline[i].along,
                outline[i].height);
    }
  }
  return chart;
}

void compare(const MeasuredHeap& photograph, const MeasuredHeap& simulated, HeapPictures& shown) {
  const vision::CompareOptions options;
  const vision::HeapComparison comparison =
      vision::compare_heaps(photograph.angle, simulated.angle, options);
  if (comparison.status == vision::MeasureStatus::refused) {
    shown.remarks.push_back("Bench and simulation could not be compared: " + comparison.reason);
    return;
  }
  const vision::ComparisonOverlayNotes notes{.titles = {photograph.title, "simulation"},
                                             .margin_rad = options.margin_rad};
  constexpr int kSide_px = 1200;
  shown.outlines = shown_picture(
      vision::draw_comparison(photograph.picture, photograph.angle, comparison, notes), kSide_px,
      fmt::format("Outlines of the heap in {} (solid) and of the simulated one (dashed)",
                  photograph.title),
      fmt::format("Outlines on {}: solid the photograph's, dashed the simulation's.",
                  photograph.title));
  shown.outline_chart = outline_chart(comparison);
  shown.comparison = comparison_table(comparison);
}

/// The definition by which the study reads its heaps; empty: the default.
std::string definition_of(const ReportedStudy& study) {
  if (!study.record) return {};
  const auto& experiments = study.record->study.experiments;
  const auto heap = experiments.find(&dem::pictured_experiment());
  return heap == experiments.end() ? std::string() : heap->second.definition;
}

}  // namespace

HeapPictures heap_pictures(const ReportedStudy& study) {
  HeapPictures shown;
  shown.definition = definition_of(study);
  const std::optional<MeasuredHeap> photograph = show_photographs(study, shown);
  if (!study.result) return shown;
  if (!has_heap(*study.result)) return shown;
  if (study.heap.empty()) {
    shown.remarks.emplace_back(study.has_other_heap
                                   ? "The simulated heap in the folder (heap.vtp) has different "
                                     "coefficients and is not shown. Run the same repose calibrate "
                                     "again to simulate it with these."
                                   : "There is no simulated heap (heap.vtp) to show.");
    return shown;
  }
  if (has_moved(*study.result)) {
    shown.remarks.emplace_back(
        "The simulated heap has the coefficients of the last check; the final fit, which includes "
        "that check, differs slightly.");
  }
  try {
    const render::Scene scene = render::scene_of(dem::read_state(study.heap));
    const auto colour = study.record ? study.record->study.grain_colour : std::nullopt;
    shown.heap_model = heap_model(scene);
    shown.heap_model->colour = colour;
    constexpr int kRenderSide_px = 900;
    std::optional<MeasuredHeap> compared;
    const std::optional<dem::LevelCamera> camera = stated_camera(study);
    const HeapViewSession session(scene, {.views = kShownViews, .camera = camera});
    for (int view = 0; view < session.views(); ++view) {
      MeasuredHeap heap = rendered(session, view, shown.definition);
      if (!compared && heap.angle.angle_rad) shown.best_render = shown.renders.size();
      shown.renders.push_back(with_overlay(heap, kRenderSide_px, "Simulated heap,"));
      if (!compared && heap.angle.angle_rad) compared = std::move(heap);
    }
    constexpr dem::LevelCamera kUsual{.distance_m = 1.5, .height_m = .038};
    shown.look = camera_look(scene, camera.value_or(kUsual), colour);
    if (photograph && compared) compare(*photograph, *compared, shown);
  } catch (const std::exception& error) {
    shown.remarks.push_back(
        fmt::format("The simulated heap cannot be shown: {}", shortened(error.what(), 400)));
  }
  return shown;
}

namespace {

PictureRow photographs_between(const HeapPictures& pictures, std::size_t from, std::size_t to) {
  PictureRow row;
  const std::size_t end = std::min(to, pictures.photographs.size());
  for (std::size_t k = from; k < end; ++k) row.pictures.push_back(pictures.photographs[k]);
  return row;
}

void add_comparison(const HeapPictures& pictures, Chapter& chapter) {
  chapter.blocks.push_back(Heading{"Outlines compared"});
  chapter.blocks.push_back(PictureRow{{*pictures.outlines}});
  chapter.blocks.push_back(*pictures.comparison);
  chapter.blocks.push_back(Paragraph{
      "Two heaps of the same grains differ too: this shows how similar these two are, not how well "
      "the coefficients fit."});
}

}  // namespace

Chapter heap_chapter(const HeapPictures& pictures) {
  Chapter chapter{.id = "heaps", .title = "The heaps", .blocks = {}};
  for (const std::string& remark : pictures.remarks) chapter.blocks.push_back(Remark{remark});
  if (pictures.photographs.empty() && pictures.renders.empty()) return chapter;
  const base::AngleDefinition& definition =
      *base::find_definition(base::definition_meant(pictures.definition));
  chapter.blocks.push_back(Paragraph{fmt::format(
      "{}: on each side {}; the angle of repose is the mean of both sides, relative to the ground "
      "line ({}). The measurement is drawn in; ± is the half-width of the 95 % interval.",
      pictures.photographs.empty() ? "How the pictures of the simulation are measured"
      : pictures.is_scanned      ? "Silhouettes of scans and of the simulation are measured by the "
                                   "same program in the same way"
      : pictures.renders.empty() ? "How the photographs are measured"
                                 : "Photographs and pictures of the simulation are measured by "
                                   "the same program in the same way",
      definition.description, definition.name)});
  if (!pictures.photographs.empty()) {
    const std::size_t count = pictures.photographs.size();
    chapter.blocks.push_back(Heading{pictures.is_scanned ? "Scans" : "Photographs"});
    chapter.blocks.push_back(photographs_between(pictures, 0, kFewPhotographs));
    if (count > kFewPhotographs) {
      chapter.blocks.push_back(
          Paragraph{fmt::format("The other {} are in the appendix.", count - kFewPhotographs)});
    }
  }
  if (!pictures.renders.empty()) {
    chapter.blocks.push_back(Heading{"Renderings of the simulated heap from three sides"});
    chapter.blocks.push_back(
        Paragraph{"Drawn by the program, not photographed. Of the last check's heaps, the one "
                  "whose angle is nearest to the mean of all."});
    chapter.blocks.push_back(PictureRow{pictures.renders});
  }
  if (pictures.outlines) add_comparison(pictures, chapter);
  return chapter;
}

Chapter more_heaps_chapter(const HeapPictures& pictures) {
  Chapter chapter{.id = "more_heaps", .title = "More of the heaps", .blocks = {}};
  PictureRow others = photographs_between(pictures, kFewPhotographs, pictures.photographs.size());
  if (!others.pictures.empty()) chapter.blocks.push_back(std::move(others));
  ChartRow charts;
  if (pictures.outline_chart) charts.charts.push_back(*pictures.outline_chart);
  if (pictures.heap_model) charts.charts.push_back(*pictures.heap_model);
  if (!charts.charts.empty()) chapter.blocks.push_back(std::move(charts));
  return chapter;
}

}  // namespace repose::calibrate::report
