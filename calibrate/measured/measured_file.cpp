#include "calibrate/measured/measured_file.h"

#include <algorithm>
#include <exception>
#include <iterator>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_pipeline.h>

#include "base/memory.h"
#include "calibrate/particles/particles.h"
#include "vision/drawing/overlay.h"
#include "vision/drawing/scan_overlay.h"
#include "vision/files/file_list.h"
#include "vision/files/heap_file.h"
#include "vision/picture/made_here.h"
#include "vision/picture/picture.h"
#include "vision/scan/scan_file.h"

namespace repose::calibrate {

namespace {

namespace fs = std::filesystem;

/// "heap.mp4 at 1.20 s".
std::string title_of(const fs::path& file, const MeasuredPicture& measured) {
  const std::string name = file.filename().string();
  if (measured.positions) return name + ", the first of its views";
  if (!measured.filmed) return name;
  if (measured.filmed->time_s) return fmt::format("{} at {:.2f} s", name, *measured.filmed->time_s);
  const auto& stretch = measured.filmed->stretch;
  if (!stretch) return name;
  return fmt::format("{} at rest from {:.2f} to {:.2f} s", name, stretch->from_s, stretch->to_s);
}

/// What was measured: a picture, corrected if its lens is known, and its settings there.
struct Seen {
  const vision::Picture& picture;
  const vision::MeasureOptions& options;
};

vision::OverlayNotes notes_for(const fs::path& file, const MeasuredPicture& measured,
                               const Seen& seen) {
  return {.title = title_of(file, measured),
          .excluded = seen.options.excluded,
          .hints = seen.options.hints};
}

void draw(const Seen& seen, const fs::path& file, const fs::path& overlay,
          MeasuredPicture& measured) {
  try {
    vision::write_picture(overlay, vision::draw_overlay(seen.picture, measured.angle,
                                                        notes_for(file, measured, seen)));
  } catch (const base::InputError& error) {
    measured.overlay_error = error.what();
  }
}

/// Runs `work`; an exception becomes the picture's error.
template <typename Work>
void attempt(base::FieldNames fields, MeasuredPicture& measured, const Work& work) {
  try {
    work();
  } catch (const base::InputError& error) {
    measured.outcome = Outcome::bad_input;
    measured.error = base::naming_file(measured.file, base::text_of(error.faults(), fields));
  } catch (const std::exception& error) {
    const bool is_too_large = base::is_out_of_memory(error);
    measured.outcome = is_too_large ? Outcome::bad_input : Outcome::internal_error;
    measured.error = is_too_large
                         ? base::no_memory(measured.file,
                                           "a smaller picture (800 pixels a side are as good), "
                                           "or fewer --threads")
                         : base::naming_file(measured.file, error.what());
  }
}

/// Drops parts that are too large to keep for many pictures.
void drop_large_parts(MeasuredPicture& measured) {
  measured.told.measuring.hints.mask.bgr = {};
  measured.angle.outline = {};
  measured.angle.upper_edge = {};
  measured.angle.left.edge = {};
  measured.angle.right.edge = {};
}

/// Converts a proposal for the corrected picture to pixels of the original.
void move_back(const vision::Lens& lens, vision::Proposal& proposal) {
  for (auto* box : {&proposal.excluded, &proposal.heap}) {
    if (*box) *box = vision::seen_box(**box, lens);
  }
  if (!proposal.ground) return;
  proposal.ground =
      vision::Segment{lens.seen(proposal.ground->from), lens.seen(proposal.ground->to)};
}

/// Moves what was measured out of the heap.
void take(vision::SizedHeap& heap, MeasuredPicture& measured) {
  measured.angle = std::move(heap.angle);
  measured.lens = heap.lens;
  measured.board = std::move(heap.board);
  measured.has_scale = heap.has_scale;
  measured.sizes = std::move(heap.sizes);
}

/// The picture that was measured.
const vision::Picture& seen_in(const vision::Picture& picture, const vision::SizedHeap& heap) {
  return heap.corrected.empty() ? picture : heap.corrected;
}

/// Adds what would help if there is no number.
void add_proposal(const Seen& seen, MeasuredPicture& measured) {
  const bool shows_heap = !measured.filmed || measured.filmed->stretch;
  if (measured.angle.status != vision::MeasureStatus::refused || !shows_heap) return;
  measured.proposal = vision::propose_hint(seen.picture, seen.options);
  if (measured.proposal && measured.lens) move_back(*measured.lens, *measured.proposal);
}

/// Everything that follows the angle of a picture, or of a film's heap at rest.
void finish(const FileMeasuring& plan, std::size_t index, const Seen& seen,
            MeasuredPicture& measured) {
  const vision::Picture& picture = seen.picture;
  const fs::path& file = plan.pictures[index];
  add_proposal(seen, measured);
  if (plan.saves_hints) vision::save_hints(measured.told, file);
  if (!plan.overlays.empty() && !picture.empty()) {
    draw(seen, file, plan.overlays[index], measured);
  }
  if (plan.keeps_overlays && !picture.empty()) {
    measured.overlay = report::overlay_for_page(
        picture, measured.angle, notes_for(file, measured, seen), plan.pictures.size());
  }
}

/// OVERLAYS/heap_at_01.200s.png for the overlay OVERLAYS/heap.png, or another name if the user has
/// such a picture.
fs::path overlay_of_frame(const FileMeasuring& plan, std::size_t index, double time_s,
                          double length_s) {
  const fs::path& whole = plan.overlays[index];
  const int digits = static_cast<int>(fmt::format("{:.3f}", length_s).size());
  const std::string name = fmt::format("{}_at_{:0{}.3f}s", whole.stem().string(), time_s, digits);
  fs::path file = whole.parent_path() / (name + ".png");
  const auto is_taken = [&] {
    return !vision::is_made_here(file) ||
           std::find(plan.overlays.begin(), plan.overlays.end(), file) != plan.overlays.end();
  };
  for (int number = 2; is_taken(); ++number) {
    file = whole.parent_path() / fmt::format("{}-{}.png", name, number);
  }
  return file;
}

/// A frame on its way through the pipeline.
struct Frame {
  std::size_t place = 0;
  vision::TimedPicture timed;
};

MeasuredPicture measure_frame(const FileMeasuring& plan, std::size_t index,
                              const MeasuredPicture& rest, const vision::TimedPicture& timed) {
  const vision::FilmStretch stretch{.from_s = timed.time_s, .to_s = timed.time_s, .frames = 1};
  MeasuredPicture measured;
  measured.file = rest.file;
  measured.filmed =
      FilmedPicture{.film = rest.filmed->film, .stretch = stretch, .time_s = timed.time_s};
  attempt(plan.fields, measured, [&] {
    measured.told = rest.told;
    vision::SizedHeap heap =
        vision::measure_sized_heap(timed.picture, measured.told.measuring, measured.told.scale);
    take(heap, measured);
    if (!plan.overlays.empty()) {
      const double length_s = rest.filmed->film.length_s;
      draw({seen_in(timed.picture, heap), heap.options}, plan.pictures[index],
           overlay_of_frame(plan, index, timed.time_s, length_s), measured);
    }
  });
  drop_large_parts(measured);
  return measured;
}

/// Decodes frames sequentially and measures several at a time.
void measure_series(const FileMeasuring& plan, std::size_t index, vision::FrameSeries& series,
                    const std::function<void(double)>& progress,
                    std::vector<MeasuredPicture>& measured) {
  const std::size_t count = series.times_s().size();
  std::vector<MeasuredPicture> frames(count);
  std::size_t read = 0;
  const auto next = [&](tbb::flow_control& flow) -> std::shared_ptr<Frame> {
    auto timed = read < count ? series.next() : std::nullopt;
    if (!timed) {
      flow.stop();
      return nullptr;
    }
    progress(static_cast<double>(read) / static_cast<double>(count));
    return std::make_shared<Frame>(Frame{.place = read++, .timed = std::move(*timed)});
  };
  const auto measure = [&](const std::shared_ptr<Frame>& frame) {
    frames[frame->place] = measure_frame(plan, index, measured.front(), frame->timed);
  };
  using Filter = tbb::filter_mode;
  tbb::parallel_pipeline(
      static_cast<std::size_t>(plan.threads),
      tbb::make_filter<void, std::shared_ptr<Frame>>(Filter::serial_in_order, next) &
          tbb::make_filter<std::shared_ptr<Frame>, void>(Filter::parallel, measure));
  frames.resize(read);
  std::move(frames.begin(), frames.end(), std::back_inserter(measured));
}

void check_step(double step_s, const vision::FilmAngle& film) {
  if (step_s <= film.film.length_s || film.film.frames < 2) return;
  throw base::InputError(
      {.value = fmt::format("--every {:g} is longer than the film, which lasts {:.3g} s", step_s,
                            film.film.length_s),
       .fix = "take a smaller step."});
}

std::vector<MeasuredPicture> measure_one_film(const FileMeasuring& plan, std::size_t index,
                                              const std::function<void(double)>& progress) {
  const fs::path& file = plan.pictures[index];
  const double rest_part = plan.every_s ? .3 : 1;
  std::vector<MeasuredPicture> measured(1);
  measured.front().file = file.string();
  attempt(plan.fields, measured.front(), [&] {
    MeasuredPicture& rest = measured.front();
    rest.told = vision::with_saved_hints({plan.options, plan.scale}, file);
    const vision::FilmFile frames{file, plan.frames_per_s, {}, rest.told.measuring.hints.turn_deg};
    vision::FilmAngle film = vision::measure_film(frames, rest.told.measuring, rest.told.scale,
                                                  [&](double done) { progress(rest_part * done); });
    if (plan.every_s) check_step(*plan.every_s, film);
    take(film.heap, rest);
    rest.filmed = FilmedPicture{.film = film.film, .stretch = film.stretch, .time_s = {}};
    finish(plan, index, {seen_in(film.picture, film.heap), film.heap.options}, rest);
    if (!plan.every_s) return;
    vision::FrameSeries series(frames, film.times_s, *plan.every_s);
    measure_series(
        plan, index, series, [&](double done) { progress(rest_part + (1 - rest_part) * done); },
        measured);
  });
  drop_large_parts(measured.front());
  return measured;
}

std::vector<MeasuredPicture> measure_one_picture(const FileMeasuring& plan, std::size_t index) {
  const fs::path& file = plan.pictures[index];
  std::vector<MeasuredPicture> measured(1);
  measured.front().file = file.string();
  attempt(plan.fields, measured.front(), [&] {
    MeasuredPicture& one = measured.front();
    vision::HeapInFile seen = vision::measure_heap_file(file, {plan.options, plan.scale});
    one.pixels = vision::pixels_of(seen.picture);
    one.told = seen.told;
    take(seen.heap, one);
    finish(plan, index, {seen.measured(), seen.heap.options}, one);
  });
  drop_large_parts(measured.front());
  return measured;
}

std::vector<MeasuredPicture> measure_one_scan(const FileMeasuring& plan, std::size_t index) {
  const fs::path& file = plan.pictures[index];
  std::vector<MeasuredPicture> measured(1);
  measured.front().file = file.string();
  attempt(plan.fields, measured.front(), [&] {
    MeasuredPicture& one = measured.front();
    one.scan = vision::measure_scan(vision::read_scan(file), plan.scan);
    one.angle = one.scan->angle;
    one.has_scale = one.scan->height_mm.has_value();
    one.sizes.reason = one.scan->size_reason;
    one.sizes.height_mm = one.scan->height_mm;
    one.sizes.base_mm = one.scan->base_mm;
    one.silhouettes = measure_scan_views(*one.scan, plan.options);
    one.silhouettes->views.clear();
    one.silhouettes->typical_picture = {};
    if (plan.overlays.empty() && !plan.keeps_overlays) return;
    const vision::Picture overlay = vision::draw_scan_overlay(*one.scan, file.filename().string());
    if (plan.keeps_overlays) {
      one.overlay = report::page_overlay(overlay, plan.pictures.size());
    }
    if (plan.overlays.empty()) return;
    try {
      vision::write_picture(plan.overlays[index], overlay);
    } catch (const base::InputError& error) {
      one.overlay_error = error.what();
    }
  });
  if (measured.front().scan) measured.front().scan->map = {};
  return measured;
}

/// Views are drawn from all around. The overlay is of the first view.
std::vector<MeasuredPicture> measure_one_of_particles(const FileMeasuring& plan, std::size_t index,
                                                      const std::function<void(double)>& progress) {
  const fs::path& file = plan.pictures[index];
  std::vector<MeasuredPicture> measured(1);
  MeasuredPicture& one = measured.front();
  one.file = file.string();
  attempt(plan.fields, one, [&] {
    one.told.measuring = plan.options;
    one.positions = measure_positions(file, plan.positions, plan.options, progress);
    MeasuredPositions& positions = *one.positions;
    one.angle = positions.angle;
    one.sizes = positions.sizes;
    one.has_scale = positions.mm_per_px > 0;
    MeasuredPicture shown;
    shown.file = one.file;
    shown.positions.emplace();
    shown.angle = positions.views.front();
    const Seen seen{positions.first_picture, plan.options};
    if (!plan.overlays.empty()) draw(seen, file, plan.overlays[index], shown);
    one.overlay_error = shown.overlay_error;
    if (plan.keeps_overlays) {
      one.overlay = report::overlay_for_page(seen.picture, shown.angle,
                                             notes_for(file, shown, seen), plan.pictures.size());
    }
    positions.first_picture = {};
    drop_large_parts(shown);
    positions.views.front() = std::move(shown.angle);
  });
  return measured;
}

}  // namespace

bool is_positions_file(const fs::path& file) {
  std::error_code ignored;
  return !vision::has_scan_ending(file) && !vision::has_picture_ending(file) &&
         !vision::has_film_ending(file) && !fs::is_directory(file, ignored) &&
         is_particle_file(file);
}

std::vector<MeasuredPicture> measure_file(const FileMeasuring& plan, std::size_t index,
                                          const std::function<void(double)>& progress) {
  const fs::path& file = plan.pictures[index];
  std::error_code ignored;
  const bool is_film = vision::has_film_ending(file) || fs::is_directory(file, ignored);
  std::vector<MeasuredPicture> measured;
  if (is_film) {
    measured = measure_one_film(plan, index, progress);
  } else if (vision::has_scan_ending(file)) {
    measured = measure_one_scan(plan, index);
  } else if (is_positions_file(file)) {
    measured = measure_one_of_particles(plan, index, progress);
  } else {
    measured = measure_one_picture(plan, index);
  }
  progress(1);
  return measured;
}

OpenedPicture open_picture(const fs::path& file, const vision::PictureSettings& told) {
  OpenedPicture opened;
  opened.file = file.string();
  if (!vision::has_film_ending(file)) {
    opened.picture = vision::read_picture(file);
    return opened;
  }
  const int turn_deg = told.measuring.hints.turn_deg;
  vision::FilmAngle film =
      vision::measure_film({file, {}, {}, turn_deg}, told.measuring, told.scale);
  opened.picture = vision::turned(std::move(film.picture), (360 - turn_deg) % 360);
  opened.filmed = FilmedPicture{.film = film.film, .stretch = film.stretch, .time_s = {}};
  return opened;
}

MeasuredAgain measure_opened(const OpenedPicture& opened, const vision::PictureSettings& told,
                             bool proposes, base::FieldNames fields) {
  MeasuredAgain again;
  MeasuredPicture& measured = again.measured;
  measured.file = opened.file;
  measured.filmed = opened.filmed;
  measured.told = told;
  attempt(fields, measured, [&] {
    again.picture = vision::turned(opened.picture, told.measuring.hints.turn_deg);
    vision::SizedHeap heap = vision::measure_sized_heap(again.picture, told.measuring, told.scale);
    take(heap, measured);
    if (!heap.corrected.empty()) again.picture = std::move(heap.corrected);
    const Seen seen{again.picture, heap.options};
    again.notes = notes_for(opened.file, measured, seen);
    if (proposes) add_proposal(seen, measured);
  });
  measured.told.measuring.hints.mask.bgr = {};
  return again;
}

}  // namespace repose::calibrate
