#include "cli/track/track_batch.h"

#include <exception>

#include "base/input_error.h"
#include "cli/common/batch.h"
#include "cli/common/memory.h"
#include "cli/common/picture_list.h"
#include "vision/drawing/drop_overlay.h"
#include "vision/drawing/roll_overlay.h"
#include "vision/drawing/tilt_overlay.h"

namespace repose::cli {
namespace {

/// What is read of the track of the experiment that was filmed.
template <typename Read>
decltype(auto) of_track(const TrackedFilm& film, const Read& read) {
  switch (film.filmed) {
    case Filmed::drop:
      return read(film.drop);
    case Filmed::roll:
      return read(film.roll);
    case Filmed::tilt:
      break;
  }
  return read(film.tilt);
}

vision::Picture overlay_of(const TrackedFilm& film, const std::string& title) {
  switch (film.filmed) {
    case Filmed::drop:
      return vision::draw_drop_overlay(film.drop, title);
    case Filmed::roll:
      return vision::draw_roll_overlay(film.roll, title);
    case Filmed::tilt:
      break;
  }
  return vision::draw_tilt_overlay(film.tilt, title);
}

void track(const vision::FilmFile& film, const vision::TrackOptions& options,
           TrackedFilm& tracked) {
  switch (tracked.filmed) {
    case Filmed::drop:
      tracked.drop = vision::track_drop(film, options);
      break;
    case Filmed::roll:
      tracked.roll = vision::track_roll(film, options);
      break;
    case Filmed::tilt:
      tracked.tilt = vision::track_tilt(film, options);
      break;
  }
}

void draw(const TrackPlan& plan, std::size_t index, TrackedFilm& tracked) {
  try {
    const std::string title = plan.videos[index].filename().string();
    vision::write_picture(plan.overlays[index], overlay_of(tracked, title));
  } catch (const base::InputError& error) {
    tracked.overlay_error = error.what();
  }
}

TrackedFilm track_one(const TrackPlan& plan, std::size_t index,
                      const std::function<void(double)>& progress) {
  TrackedFilm tracked{.file = plan.videos[index].string(), .filmed = plan.filmed};
  try {
    vision::TrackOptions options{.scale = plan.scale.scale,
                                 .released_mm = plan.released_mm,
                                 .draws_strobe = !plan.overlays.empty(),
                                 .progress = progress};
    if (plan.scale.finds_board) {
      options.board = vision::BoardPlacing{plan.scale.square_mm, plan.scale.behind_mm};
    }
    track({plan.videos[index], plan.frames_per_s, plan.scale.lens}, options, tracked);
    if (!plan.overlays.empty()) draw(plan, index, tracked);
    tracked.drop.strobe = {};
    tracked.roll.strobe = {};
    tracked.tilt.strobe = {};
  } catch (const base::InputError& error) {
    tracked.error = naming_file(tracked.file, error.what());
  } catch (const std::exception& error) {
    tracked.is_internal_error = !is_out_of_memory(error);
    tracked.error = tracked.is_internal_error
                        ? naming_file(tracked.file, error.what())
                        : no_memory(tracked.file, "a smaller film, or fewer --threads");
  }
  return tracked;
}

}  // namespace

vision::MeasureStatus status_of(const TrackedFilm& film) {
  return of_track(film, [](const auto& track) { return track.status; });
}

const std::string& reason_of(const TrackedFilm& film) {
  return of_track(film, [](const auto& track) -> const std::string& { return track.reason; });
}

const std::vector<vision::Warning>& warnings_of(const TrackedFilm& film) {
  return of_track(film, [](const auto& track) -> const std::vector<vision::Warning>& {
    return track.warnings;
  });
}

const vision::FilmFacts& facts_of(const TrackedFilm& film) {
  return of_track(film, [](const auto& track) -> const vision::FilmFacts& { return track.film; });
}

bool has_reading(const TrackedFilm& film) {
  switch (film.filmed) {
    case Filmed::drop:
      return !film.drop.bounces.empty();
    case Filmed::roll:
      return film.roll.has_reading;
    case Filmed::tilt:
      break;
  }
  return film.tilt.has_reading;
}

std::vector<TrackedFilm> track_batch(const TrackPlan& plan,
                                     const std::atomic<bool>& is_interrupted) {
  return batch_of<TrackedFilm>(
      plan.videos.size(), plan.threads, "tracked", is_interrupted,
      [&](std::size_t number, const auto& report) { return track_one(plan, number, report); });
}

}  // namespace repose::cli
