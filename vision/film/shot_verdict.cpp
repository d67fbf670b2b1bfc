#include "vision/film/shot_verdict.h"

#include <algorithm>

#include <fmt/format.h>

namespace repose::vision {

FilmFacts facts_of(const FilmSurvey& survey) {
  return {.width = survey.size.width,
          .height = survey.size.height,
          .frames = static_cast<int>(survey.times_s.size()),
          .frames_per_s = survey.interval_s > 0 ? 1 / survey.interval_s : 0,
          .length_s = survey.times_s.empty() ? 0 : survey.times_s.back(),
          .dropped_frames = survey.dropped_frames};
}

std::string fault_of_shot(const FilmSurvey& survey, double moved_px) {
  if (survey.times_s.size() < kFewestFrames) {
    return fmt::format(
        "the film has {} frames. Rule: {} or more. Fix: begin the film "
        "earlier, and end it when all lies still.",
        survey.times_s.size(), kFewestFrames);
  }
  if (survey.cut) {
    return fmt::format(
        "another scene begins with frame {}. Rule: one shot. Fix: cut the film to one "
        "experiment, from a camera that stands still.",
        *survey.cut + 1);
  }
  const double most_px = std::max(4.0, .004 * survey.size.width);
  if (moved_px > most_px) {
    return fmt::format(
        "the camera moves: the scene shifts by {:.1f} pixels. Rule: at most {:.1f}. Fix: put the "
        "camera on a stand, start it with a remote, and keep its zoom.",
        moved_px, most_px);
  }
  return {};
}

std::string fault_of_fields(const FilmSurvey& survey) {
  if (!survey.is_interlaced) return {};
  return "the film is interlaced: every other row of a frame was taken half a frame later, and "
         "what moves is combed. Rule: whole frames. Fix: film in a progressive mode (p, not i), "
         "or make frames of its fields: ffmpeg -i FILM -vf bwdif=mode=send_field -crf 12 NEW.mp4.";
}

bool warn_of_film(const FilmSurvey& survey, double moved_px, std::vector<Warning>& warnings) {
  const auto frames = static_cast<int>(survey.times_s.size());
  const bool is_cut_short = survey.claimed_frames > frames + 2 + frames / 50;
  if (is_cut_short) {
    warnings.push_back({.code = "cut_short",
                        .message = fmt::format(
                            "the film ends after {} of the {} frames that it says it has: it is "
                            "damaged, and what follows is not seen",
                            frames, survey.claimed_frames)});
  }
  if (survey.has_variable_rate) {
    warnings.push_back({.code = "variable_rate",
                        .message = "its frames do not follow evenly: their time stamps were used"});
  }
  if (survey.dropped_frames > 0) {
    warnings.push_back(
        {.code = "dropped_frames",
         .message = fmt::format("{} frames are missing by the time stamps, which were used",
                                survey.dropped_frames)});
  }
  constexpr double kMoved_px = .8;
  if (moved_px > kMoved_px) {
    warnings.push_back(
        {.code = "camera_moves",
         .message = fmt::format("the camera moves by up to {:.1f} pixels, which was taken out",
                                moved_px)});
  }
  return is_cut_short;
}

}  // namespace repose::vision
