#include "studio/picture_folder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

#include "base/angle_definition.h"
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/measured/measured_command.h"
#include "calibrate/measured/measured_json.h"
#include "calibrate/measured/measured_set.h"
#include "calibrate/measured/measured_workbook.h"
#include "calibrate/report/measure_report.h"
#include "studio/told_json.h"
#include "vision/drawing/overlay.h"
#include "vision/files/file_list.h"
#include "vision/film/film_angle.h"
#include "vision/picture/picture.h"
#include "vision/scan/scan_file.h"

namespace repose::studio {

namespace fs = std::filesystem;

namespace {

/// Names of hints in errors and advice: the page's tools.
constexpr std::array<base::FieldName, 9> kTools{
    {{"excluded box", "Leave out"},
     {"camera pitch", "Camera pitch"},
     {"heap box", "Box"},
     {"ground points", "Ground"},
     {"point to keep", "Keep"},
     {"point to drop", "Drop"},
     {"camera file", "--camera-file on the command line"},
     {"unit", "--unit mm on the command line"},
     {"ground plane", "--ground-plane on the command line"}}};

const char* kind_of(const fs::path& file) {
  if (vision::has_film_ending(file)) return "film";
  if (vision::has_scan_ending(file)) return "scan";
  return vision::has_picture_ending(file) ? "picture" : "particles";
}

bool is_photograph(const fs::path& file) {
  return vision::has_film_ending(file) || vision::has_picture_ending(file);
}

/// Changes with the file: its size and modification time; "" if there is none.
std::string state_of(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  if (error) return {};
  const auto time = fs::last_write_time(file, error);
  return fmt::format("{}-{}", size, time.time_since_epoch().count());
}

std::string file_version(const fs::path& file) {
  return state_of(file) + '+' + state_of(vision::hint_file_of(file));
}

std::vector<fs::path> files_of(const fs::path& folder) {
  // Only the files: an empty folder is not an error here.
  return vision::list_heap_files({folder.string()}).files;
}

}  // namespace

/// Cached results for one version of a file.
struct PictureFolder::Kept {
  std::mutex mutex;
  std::string version;
  calibrate::MeasuredPicture measured;
  std::string answer;
};

PictureFolder::PictureFolder(fs::path folder) : folder_(std::move(folder)) {
  constexpr const char* kLockFile = ".repose-studio.lock";
  std::error_code ignored;
  if (!fs::is_directory(folder_, ignored)) {
    base::refuse(folder_, "there is no such folder", "name the folder with your pictures.");
  }
  // A read-only folder needs no lock: nothing can be overwritten.
  if (::access(folder_.c_str(), W_OK) != 0) return;
  lock_.emplace(folder_, folder_ / kLockFile,
                "open the address that the other repose studio has printed, or end that with "
                "Ctrl-C in its terminal.");
  base::remove_leftovers_in(folder_);
}

Json PictureFolder::list() const {
  Json files = Json::array();
  for (const fs::path& file : files_of(folder_)) {
    std::error_code ignored;
    files.push_back({{"file", file.filename().string()},
                     {"kind", kind_of(file)},
                     {"version", file_version(file)},
                     {"has_hints", fs::exists(vision::hint_file_of(file), ignored)}});
  }
  Json definitions = Json::array();
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    definitions.push_back({{"name", definition.name}, {"description", definition.description}});
  }
  std::error_code ignored;
  const fs::path folder = fs::absolute(folder_ / "", ignored).lexically_normal().parent_path();
  return {{"folder", folder.string()},
          {"name", folder.filename().string()},
          {"command", fmt::format("repose measure {} --csv angles.csv --report photos.html",
                                  base::shell_word(folder_.string()))},
          {"definitions", definitions},
          {"files", files}};
}

fs::path PictureFolder::path_of(const std::string& file) const {
  for (const fs::path& known : files_of(folder_)) {
    if (known.filename().string() == file) return known;
  }
  throw base::InputError({.where = base::printable(file),
                          .value = "there is no such picture in the folder",
                          .fix = "load the page again."});
}

std::string PictureFolder::version_of(const std::string& file) const {
  return file_version(path_of(file));
}

void PictureFolder::require_unchanged(const fs::path& path, const std::string& version) const {
  if (version == file_version(path)) return;
  throw ChangedMeanwhile({.where = base::printable(path.filename().string()),
                          .value =
                              "it was changed in another window, or by a command, since you began: "
                              "nothing was saved",
                          .fix = "choose below which of both is to hold."});
}

PictureFolder::Opened PictureFolder::opened(const fs::path& path, const std::string& version,
                                            const vision::PictureSettings& told) {
  constexpr std::size_t kMost = 4;
  // The version belongs to the key: a film's hints determine which of its frames show the heap at
  // rest.
  const std::string key = path.string() + '\n' + version;
  {
    const std::lock_guard lock(mutex_);
    for (auto found = opened_.begin(); found != opened_.end(); ++found) {
      if (found->first != key) continue;
      opened_.splice(opened_.begin(), opened_, found);
      return found->second;
    }
  }
  auto read = std::make_shared<const calibrate::OpenedPicture>(calibrate::open_picture(path, told));
  const std::lock_guard lock(mutex_);
  opened_.emplace_front(key, read);
  if (opened_.size() > kMost) opened_.pop_back();
  return read;
}

namespace {

/// The page's data about a photograph.
Json answer_of(const calibrate::MeasuredAgain& again, const std::string& version) {
  const calibrate::MeasuredPicture& measured = again.measured;
  Json answer{{"version", version},
              {"measured", calibrate::measured_json(measured)},
              {"told", told_json(measured.told)},
              {"marks", marks_json(again)},
              {"command", calibrate::measure_command(measured)},
              {"proposed", nullptr}};
  if (measured.proposal) {
    answer["proposed"] = told_json(calibrate::with_proposal(measured.told, *measured.proposal));
  }
  return answer;
}

/// The same for a scan or a particle file, which take no hints here.
Json answer_of(const calibrate::MeasuredPicture& measured, const std::string& version) {
  return {{"version", version},
          {"measured", calibrate::measured_json(measured)},
          {"told", nullptr},
          {"marks", nullptr},
          {"command", calibrate::measure_command(measured)},
          {"proposed", nullptr}};
}

calibrate::MeasuredPicture unread(const fs::path& file, const base::InputError& error) {
  calibrate::MeasuredPicture measured;
  measured.file = file.string();
  measured.outcome = calibrate::Outcome::bad_input;
  measured.error = base::naming_file(file.string(), base::text_of(error.faults(), kTools));
  return measured;
}

void drop_outline(calibrate::MeasuredPicture& measured) {
  measured.angle.outline = {};
  measured.angle.upper_edge = {};
  measured.angle.left.edge = {};
  measured.angle.right.edge = {};
}

}  // namespace

std::shared_ptr<PictureFolder::Kept> PictureFolder::kept(const fs::path& path) {
  const std::string version = file_version(path);
  std::shared_ptr<Kept> kept;
  {
    const std::lock_guard lock(mutex_);
    auto& place = kept_[path.filename().string()];
    if (!place) place = std::make_shared<Kept>();
    kept = place;
  }
  const std::lock_guard lock(kept->mutex);
  if (kept->version == version) return kept;
  if (!is_photograph(path)) {
    const calibrate::FileMeasuring plan{
        .pictures = {path}, .keeps_overlays = true, .fields = kTools};
    kept->measured = calibrate::measure_file(plan, 0, [](double) {}).front();
    kept->answer = text_of(answer_of(kept->measured, version));
  } else {
    try {
      const vision::PictureSettings told = vision::with_saved_hints({}, path);
      const Opened picture = opened(path, version, told);
      calibrate::MeasuredAgain again = calibrate::measure_opened(*picture, told, true, kTools);
      again.measured.pixels = vision::pixels_of(picture->picture);
      kept->answer = text_of(answer_of(again, version));
      kept->measured = std::move(again.measured);
    } catch (const base::InputError& error) {
      kept->measured = unread(path, error);
      kept->answer = text_of(answer_of(kept->measured, version));
    }
  }
  drop_outline(kept->measured);
  kept->version = version;
  return kept;
}

std::string PictureFolder::measured(const std::string& file) {
  const auto kept = this->kept(path_of(file));
  const std::lock_guard lock(kept->mutex);
  return kept->answer;
}

Json PictureFolder::measured_as(const std::string& file, const Json& told) {
  const fs::path path = path_of(file);
  if (!is_photograph(path)) {
    throw base::InputError({.where = file, .value = "nothing can be told of it here"});
  }
  const std::string version = file_version(path);
  const vision::PictureSettings saved = vision::with_saved_hints({}, path);
  const vision::PictureSettings settings = settings_of(path, version, told);
  return answer_of(
      calibrate::measure_opened(*opened(path, version, saved), settings, false, kTools), version);
}

std::string PictureFolder::save(const std::string& file, const Json& told,
                                const std::string& version) {
  const fs::path path = path_of(file);
  if (!is_photograph(path)) {
    throw base::InputError({.where = file, .value = "nothing can be told of it here"});
  }
  {
    const std::lock_guard lock(saving_);
    require_unchanged(path, version);
    vision::PictureSettings settings = settings_of(path, version, told);
    vision::Hints& hints = settings.measuring.hints;
    if (hints.mask_file == vision::mask_file_of(path)) vision::save_mask(hints, path);
    vision::save_hints(settings, path);
  }
  return measured(file);
}

std::string PictureFolder::forget(const std::string& file, const std::string& version) {
  const fs::path path = path_of(file), hints = vision::hint_file_of(path);
  {
    const std::lock_guard lock(saving_);
    require_unchanged(path, version);
    std::error_code error;
    fs::remove(hints, error);
    if (!error) fs::remove(vision::mask_file_of(path), error);
    if (error) {
      base::refuse(hints, "it cannot be removed: " + error.message(), "see who may write there.");
    }
  }
  return measured(file);
}

vision::PictureSettings PictureFolder::settings_of(const fs::path& path, const std::string& version,
                                                   const Json& told) {
  const vision::PictureSettings saved = vision::with_saved_hints({}, path);
  vision::PictureSettings settings = with_told(saved, told);
  vision::Hints& hints = settings.measuring.hints;
  // A saved mask matches the picture as it was turned then.
  constexpr int kFull_deg = 360;
  const int turn_deg = hints.turn_deg - saved.measuring.hints.turn_deg + kFull_deg;
  hints.mask = vision::turned(std::move(hints.mask), turn_deg % kFull_deg);
  const std::vector<vision::BrushStroke> strokes = painted_in(told);
  if (strokes.empty()) return settings;
  const vision::Picture& picture = opened(path, version, saved)->picture;
  const bool is_on_its_side = hints.turn_deg % 180 != 0;
  hints.mask =
      vision::painted(std::move(hints.mask), is_on_its_side ? picture.height : picture.width,
                      is_on_its_side ? picture.width : picture.height, strokes);
  hints.mask_file = vision::mask_file_of(path);
  return settings;
}

PictureFolder::Bytes PictureFolder::mask(const std::string& file) {
  const fs::path path = path_of(file);
  const vision::Picture mask = vision::with_saved_hints({}, path).measuring.hints.mask;
  if (mask.empty()) throw base::InputError({.where = file, .value = "nothing is painted over it"});
  return vision::png_of(mask);
}

calibrate::MeasuredAgain PictureFolder::again(const std::string& file) {
  const fs::path path = path_of(file);
  const vision::PictureSettings told = vision::with_saved_hints({}, path);
  return calibrate::measure_opened(*opened(path, file_version(path), told), told, false, kTools);
}

PictureFolder::Bytes PictureFolder::picture(const std::string& file, int side_px, int turn_deg) {
  constexpr int kQuality = 88;
  const fs::path path = path_of(file);
  if (!is_photograph(path)) {
    const auto kept = this->kept(path);
    const std::lock_guard lock(kept->mutex);
    return kept->measured.overlay.bytes;
  }
  const vision::PictureSettings told = vision::with_saved_hints({}, path);
  // Marks refer to the picture without the lens's distortion.
  if (told.scale.lens)
    return vision::jpeg_of(vision::reduced(again(file).picture, side_px), kQuality);
  const Opened picture = opened(path, file_version(path), told);
  return vision::jpeg_of(vision::turned(vision::reduced(picture->picture, side_px), turn_deg),
                         kQuality);
}

PictureFolder::Bytes PictureFolder::overlay(const std::string& file) {
  if (!is_photograph(path_of(file))) return picture(file, 0, 0);
  const calibrate::MeasuredAgain shown = again(file);
  constexpr int kQuality = 92;
  return vision::jpeg_of(vision::draw_overlay(shown.picture, shown.measured.angle, shown.notes),
                         kQuality);
}

std::string PictureFolder::add(const std::string& name, std::string_view content) {
  const fs::path asked = name;
  const bool is_plain = !name.empty() && name.front() != '.' && base::is_utf8(name) &&
                        base::printable(name) == name &&
                        name.find_first_of("/\\:") == std::string::npos;
  const bool is_known = vision::has_picture_ending(asked) || vision::has_film_ending(asked) ||
                        vision::has_scan_ending(asked);
  if (!is_plain || !is_known) {
    throw base::InputError(
        {.where = base::printable(name),
         .value = "it is not taken",
         .rule = "a picture (JPEG, HEIC, AVIF, PNG, TIFF, BMP, WebP), a film (MP4, MOV, AVI, MKV, "
                 "WebM, GIF) or a scan (PLY, OBJ, STL, GLB), by its name",
         .fix = "look for the file that the camera has written."});
  }
  const std::lock_guard lock(mutex_);
  fs::path free = folder_ / asked;
  std::error_code ignored;
  for (int number = 2; fs::exists(free, ignored); ++number) {
    free =
        folder_ / fmt::format("{}-{}{}", asked.stem().string(), number, asked.extension().string());
  }
  base::write_whole_file(free, content);
  return free.filename().string();
}

std::vector<calibrate::MeasuredPicture> PictureFolder::all() {
  std::vector<calibrate::MeasuredPicture> pictures;
  std::vector<fs::path> files = files_of(folder_);
  std::vector<std::string> pixels;
  for (const fs::path& file : files) {
    const auto kept = this->kept(file);
    const std::lock_guard lock(kept->mutex);
    pictures.push_back(kept->measured);
    pixels.push_back(kept->measured.pixels);
  }
  const auto first_of = vision::copies_among(files, pixels);
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    if (first_of[k]) pictures[k].copy_of = files[*first_of[k]].string();
  }
  calibrate::name_outliers(pictures);
  return pictures;
}

std::string PictureFolder::set() { return calibrate::set_json(calibrate::measured_set(all()), {}); }

std::string PictureFolder::csv() { return calibrate::measure_csv(all()); }

std::string PictureFolder::workbook() {
  const std::vector<calibrate::MeasuredPicture> pictures = all();
  return calibrate::measure_workbook(pictures);
}

std::string PictureFolder::report() {
  std::vector<calibrate::report::MeasuredPhotograph> shown;
  const std::vector<calibrate::MeasuredPicture> pictures = all();
  for (const calibrate::MeasuredPicture& picture : pictures) {
    if (!picture.copy_of.empty()) continue;
    calibrate::report::MeasuredPhotograph photograph = calibrate::photograph_of(picture);
    if (is_photograph(picture.file) && photograph.error.empty()) {
      const calibrate::MeasuredAgain drawn = again(fs::path(picture.file).filename().string());
      photograph.overlay = calibrate::report::overlay_for_page(drawn.picture, drawn.measured.angle,
                                                               drawn.notes, pictures.size());
    }
    shown.push_back(std::move(photograph));
  }
  return calibrate::report::measure_report(shown).html;
}

}  // namespace repose::studio
