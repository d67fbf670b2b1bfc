#include "cli/measure/measure_batch.h"

#include <cstddef>
#include <exception>
#include <stdexcept>

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cli/common/memory.h"
#include "cli/common/picture_list.h"
#include "cli/common/picture_options.h"
#include "cli/common/progress.h"
#include "vision/drawing/overlay.h"
#include "vision/hints/hint_file.h"
#include "vision/picture/picture.h"

namespace repose::cli {
namespace {

vision::OverlayNotes notes_for(const MeasurePlan& plan, std::size_t index,
                               const vision::MeasureOptions& used) {
  return {.title = plan.pictures[index].filename().string(),
          .excluded = used.excluded,
          .hints = used.hints};
}

void draw(const vision::Picture& picture, const MeasurePlan& plan, std::size_t index,
          MeasuredPicture& measured) {
  try {
    const vision::OverlayNotes notes = notes_for(plan, index, measured.used);
    vision::write_picture(plan.overlays[index],
                          vision::draw_overlay(picture, measured.angle, notes));
  } catch (const std::invalid_argument& error) {
    measured.overlay_error = error.what();
  }
}

const std::vector<OptionName> kNames = [] {
  const auto common = measuring_names("--exclude X,Y,W,H");
  std::vector<OptionName> names(common.begin(), common.end());
  names.push_back({.value = "heap box", .option = "--heap"});
  names.push_back({.value = "ground points", .option = "--ground"});
  names.push_back({.value = "place to keep", .option = "--keep"});
  names.push_back({.value = "place to drop", .option = "--drop"});
  return names;
}();

MeasuredPicture measure_one(const MeasurePlan& plan, std::size_t index) {
  MeasuredPicture measured;
  measured.file = plan.pictures[index].string();
  try {
    const vision::Picture picture = vision::read_picture(plan.pictures[index]);
    measured.used = vision::with_saved_hints(plan.options, plan.pictures[index]);
    measured.angle = vision::measure_repose_angle(picture, measured.used);
    if (measured.angle.status == vision::MeasureStatus::refused) {
      measured.proposal = vision::propose_hint(picture, measured.used);
    }
    name_options(measured.angle, kNames);
    if (plan.saves_hints) vision::save_hints(measured.used, plan.pictures[index]);
    if (!plan.overlays.empty()) draw(picture, plan, index, measured);
    if (plan.keeps_overlays) {
      measured.overlay = calibrate::report::overlay_for_page(
          picture, measured.angle, notes_for(plan, index, measured.used), plan.pictures.size());
    }
    measured.used.hints.mask.bgr = {};
    measured.angle.outline = {};
    measured.angle.upper_edge = {};
    measured.angle.left.edge = {};
    measured.angle.right.edge = {};
  } catch (const std::invalid_argument& error) {
    measured.outcome = Outcome::bad_input;
    measured.error = naming_options(naming_file(measured.file, error.what()), kNames);
  } catch (const std::exception& error) {
    const bool is_too_large = is_out_of_memory(error);
    measured.outcome = is_too_large ? Outcome::bad_input : Outcome::internal_error;
    measured.error = is_too_large ? no_memory(measured.file,
                                              "a smaller picture (800 pixels a side are as good), "
                                              "or fewer --threads")
                                  : naming_file(measured.file, error.what());
  }
  return measured;
}

}  // namespace

std::vector<MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                           const std::atomic<bool>& is_interrupted) {
  std::vector<MeasuredPicture> results(plan.pictures.size());
  Progress progress(results.size());
  // The control holds for the parallel loops inside OpenCV too.
  const tbb::global_control at_most(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(plan.threads));
  tbb::task_arena arena(plan.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, results.size(), [&](std::size_t index) {
      if (is_interrupted) return;
      results[index] = measure_one(plan, index);
      progress.advance();
    });
  });
  return results;
}

}  // namespace repose::cli
