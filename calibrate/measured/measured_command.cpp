#include "calibrate/measured/measured_command.h"

#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/text.h"
#include "base/units.h"

namespace repose::calibrate {

namespace {

std::string value_of(const vision::Box& box) {
  return fmt::format("{},{},{},{}", box.x, box.y, box.width, box.height);
}

std::string value_of(const vision::Segment& line) {
  return fmt::format("{:.0f},{:.0f},{:.0f},{:.0f}", line.from.x, line.from.y, line.to.x, line.to.y);
}

std::string value_of(const vision::Point& place) {
  return fmt::format("{:g},{:g}", place.x, place.y);
}

/// Builds a command's options one by one.
class Options {
 public:
  void add(const char* name, const std::string& value) {
    text_ += fmt::format(" {} {}", name, value);
  }
  void add(const char* name) { text_ += fmt::format(" {}", name); }
  template <class Item>
  void add_each(const char* name, const std::vector<Item>& items) {
    for (const Item& item : items) add(name, value_of(item));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void add_scale(const vision::ScaleOptions& scale, Options& options) {
  if (!scale.lens_file.empty())
    options.add("--camera-file", base::shell_word(scale.lens_file.string()));
  if (scale.scale) {
    options.add("--scale",
                fmt::format("{},{:g}", value_of(scale.scale->line), scale.scale->length_mm));
  }
  if (!scale.finds_board) return;
  options.add("--board");
  if (scale.square_mm != vision::kBoardSquare_mm) {
    options.add("--square-mm", fmt::format("{:g}", scale.square_mm));
  }
  if (scale.board_offset_mm > 0)
    options.add("--board-behind", fmt::format("{:g}", scale.board_offset_mm));
}

void add_measuring(const vision::MeasureOptions& told, Options& options) {
  const vision::MeasureOptions usual;
  if (told.method != usual.method) options.add("--method", name_of(told.method));
  if (told.window_from != usual.window_from || told.window_to != usual.window_to) {
    options.add("--window", fmt::format("{:g},{:g}", told.window_from, told.window_to));
  }
  if (!base::is_usual_definition(told.definition)) options.add("--definition", told.definition);
  if (told.hints.turn_deg != 0) {
    options.add("--rotate", fmt::format("{}", told.hints.turn_deg));
  }
  options.add_each("--exclude", told.excluded);
  if (told.hints.heap) options.add("--heap", value_of(*told.hints.heap));
  if (told.hints.ground) options.add("--ground", value_of(*told.hints.ground));
  if (told.hints.half) options.add("--half", name_of(*told.hints.half));
  options.add_each("--keep", told.hints.keep);
  options.add_each("--drop", told.hints.drop);
  if (!told.hints.mask_file.empty()) {
    options.add("--mask", base::shell_word(told.hints.mask_file.string()));
  }
  if (told.camera_pitch_rad) {
    options.add("--pitch-deg", fmt::format("{:g}", to_degrees(*told.camera_pitch_rad)));
  }
}

/// The frame rate, which makes a folder of frames a film.
void add_frame_rate(const calibrate::MeasuredPicture& picture, Options& options) {
  std::error_code ignored;
  if (!picture.filmed || !std::filesystem::is_directory(picture.file, ignored)) return;
  options.add("--fps", fmt::format("{:g}", picture.filmed->film.frames_per_s));
}

}  // namespace

std::string scale_options(const vision::ScaleOptions& scale) {
  Options options;
  add_scale(scale, options);
  return options.text();
}

std::string measure_command(const MeasuredPicture& picture) {
  Options options;
  add_measuring(picture.told.measuring, options);
  add_scale(picture.told.scale, options);
  add_frame_rate(picture, options);
  return fmt::format("repose measure {}{}", base::shell_word(picture.file), options.text());
}

report::MeasuredPhotograph photograph_of(const MeasuredPicture& picture) {
  const bool is_read = picture.outcome == Outcome::measured;
  return {.file = picture.file,
          .error = is_read ? "" : picture.error,
          .angle = picture.angle,
          .overlay = picture.overlay,
          .heap = picture.heap,
          .command = is_read ? measure_command(picture) : ""};
}

vision::PictureSettings with_proposal(vision::PictureSettings told,
                                      const vision::Proposal& proposal) {
  vision::MeasureOptions& measuring = told.measuring;
  if (proposal.turn_deg != 0) measuring.hints.turn_deg = proposal.turn_deg;
  if (proposal.excluded) measuring.excluded.push_back(*proposal.excluded);
  if (proposal.heap) measuring.hints.heap = proposal.heap;
  if (proposal.ground) measuring.hints.ground = proposal.ground;
  return told;
}

}  // namespace repose::calibrate
