#include "studio/film_tracks.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/measured/tracked_film.h"
#include "studio/told_json.h"
#include "vision/film/film_angle.h"
#include "vision/film/film_frames.h"

namespace repose::studio {

namespace fs = std::filesystem;

struct FilmTracks::Frames {
  std::string file;
  std::string version;
  vision::FilmFrames frames;
};

struct FilmTracks::Tracked {
  int number = 0;
  calibrate::TrackedFilm film;
  Bytes overlay;
};

namespace {

fs::path film_named(const PictureFolder& pictures, const std::string& file) {
  const fs::path path = pictures.path_of(file);
  if (vision::has_film_ending(path)) return path;
  throw base::InputError({.where = file, .value = "is no film"});
}

vision::Filmed filmed_in(const Json& asked) {
  using vision::Filmed;
  const std::string said = asked.value("experiment", "");
  for (const Filmed filmed : {Filmed::drop, Filmed::roll, Filmed::tilt}) {
    if (said == calibrate::name_of(filmed)) return filmed;
  }
  throw base::InputError({.where = "experiment",
                          .value = "is " + base::printable(said),
                          .rule = "drop, roll or tilt"});
}

/// How far up the incline a grain was released, if given.
std::optional<double> released_in(const Json& asked) {
  constexpr double kShortest_mm = 1, kLongest_mm = 10000;  // as in `repose track`
  const auto said = asked.find("released_mm");
  if (said == asked.end() || said->is_null()) return std::nullopt;
  if (said->is_number() && *said >= kShortest_mm && *said <= kLongest_mm)
    return said->get<double>();
  throw base::InputError({.where = "released",
                          .value = "is " + said->dump(),
                          .rule = fmt::format("{} to {} mm", kShortest_mm, kLongest_mm)});
}

calibrate::FilmTracking tracking_of(const fs::path& film, const Json& asked) {
  if (!asked.is_object())
    throw base::InputError({.value = "what was said of the film is no object"});
  calibrate::FilmTracking tracking{.film = {film}, .filmed = filmed_in(asked)};
  // Angles need neither scale nor release.
  if (tracking.filmed == vision::Filmed::tilt) return tracking;
  tracking.scale = with_told({}, {{"scale", asked.value("scale", Json())},
                                  {"board", asked.value("board", Json())}})
                       .scale;
  if (tracking.filmed != vision::Filmed::roll) return tracking;
  tracking.released_mm = released_in(asked);
  const bool has_scale = tracking.scale.scale || tracking.scale.finds_board;
  if (has_scale == tracking.released_mm.has_value()) {
    throw base::InputError(
        {.where = "roll",
         .value = has_scale ? "there are two scales" : "there is no scale yet",
         .rule =
             "millimetres come from a length in the picture, a board, or the way up the incline",
         .fix = "say one of them below."});
  }
  return tracking;
}

}  // namespace

std::shared_ptr<const FilmTracks::Frames> FilmTracks::frames_of(const std::string& file) {
  constexpr std::size_t kMost = 2;
  const fs::path path = film_named(pictures_, file);
  const std::string version = pictures_.version_of(file);
  // Requests for a second frame wait until all frames are decoded.
  const std::lock_guard lock(decoding_);
  const auto known = std::ranges::find_if(
      frames_, [&](const auto& one) { return one->file == file && one->version == version; });
  if (known != frames_.end()) {
    frames_.splice(frames_.begin(), frames_, known);
  } else {
    frames_.push_front(
        std::make_shared<const Frames>(Frames{file, version, vision::film_frames(path)}));
    if (frames_.size() > kMost) frames_.pop_back();
  }
  return frames_.front();
}

Json FilmTracks::film(const std::string& file) {
  const auto known = frames_of(file);
  return {{"width", known->frames.width},
          {"height", known->frames.height},
          {"times_s", known->frames.times_s}};
}

FilmTracks::Bytes FilmTracks::frame(const std::string& file, int number) {
  const auto known = frames_of(file);
  const auto place = static_cast<std::size_t>(number);
  if (place < known->frames.jpegs.size()) return known->frames.jpegs[place];
  throw base::InputError({.where = file, .value = fmt::format("has no frame {}", number)});
}

Json FilmTracks::track(const std::string& file, const Json& asked) {
  constexpr std::size_t kMost = 100;
  constexpr int kQuality = 92;
  auto found = std::make_shared<Tracked>();
  calibrate::FilmTracking tracking = tracking_of(film_named(pictures_, file), asked);
  tracking.take_overlay = [&](const vision::Picture& overlay) {
    found->overlay = vision::jpeg_of(overlay, kQuality);
  };
  found->film = calibrate::tracked_film(tracking);
  const std::lock_guard lock(mutex_);
  found->number = ++last_number_;
  tracked_.push_front(found);
  if (tracked_.size() > kMost) tracked_.pop_back();
  return {{"number", found->number},
          {"tracked", calibrate::tracked_json(found->film)},
          {"command", track_command(tracking)}};
}

std::shared_ptr<const FilmTracks::Tracked> FilmTracks::tracked(int number) {
  const std::lock_guard lock(mutex_);
  for (const auto& one : tracked_) {
    if (one->number == number) return one;
  }
  throw base::InputError({.value = "that is not remembered any more", .fix = "track it again."});
}

FilmTracks::Bytes FilmTracks::overlay(int number) {
  const auto found = tracked(number);
  if (found->overlay.empty()) {
    throw base::InputError({.where = fs::path(found->film.file).filename().string(),
                            .value = "there is no picture of it"});
  }
  return found->overlay;
}

FilmTracks::Readings FilmTracks::readings(int number, const Json& asked) {
  calibrate::TrackedFilm film = tracked(number)->film;
  if (film.filmed == vision::Filmed::drop) {
    const Json chosen = asked.is_object() ? asked.value("bounces", Json::array()) : Json::array();
    std::erase_if(film.drop.bounces, [&](const vision::Bounce& bounce) {
      return std::ranges::find(chosen, Json(bounce.number)) == chosen.end();
    });
  }
  Readings readings{
      .experiment = calibrate::name_of(film.filmed),
      .csv = calibrate::track_csv({film}, film.filmed, calibrate::BouncesToTell::all)};
  if (std::ranges::count(readings.csv, '\n') > 1) return readings;
  throw base::InputError({.where = fs::path(film.file).filename().string(),
                          .value = "gives no reading",
                          .fix = "see why above, or choose a bounce."});
}

}  // namespace repose::studio
