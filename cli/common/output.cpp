#include "cli/common/output.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/report/page.h"
#include "vision/files/file_list.h"
#include "vision/film/film_angle.h"
#include "vision/picture/made_here.h"

namespace repose::cli {

namespace {

void print(std::string_view text) {
  const bool is_written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (is_written && std::fflush(stdout) == 0) return;
  throw base::InputError(
      {.where = "standard output",
       .value = "cannot be written",
       .fix = "check whether the disk is full or the program reading it has ended."});
}

}  // namespace

void prepare_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  // Silences the library that writes films: cli/render reports its errors.
  ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // NOLINT(concurrency-mt-unsafe): before threads
  // open() takes the lowest free descriptor: closed standard streams become unwritable ones.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) == -1) ::open("/dev/null", O_RDONLY);
  }
}

void Outputs::add(const std::string& file, std::string text) {
  if (file.empty()) return;
  if (file == kStandardOutput) {
    printed_ = std::move(text);
    has_printed_ = true;
  } else {
    files_.push_back({file, std::move(text)});
  }
}

void Outputs::show(std::string text) { shown_ = std::move(text); }

void Outputs::write_files() {
  for (const auto& [file, text] : std::exchange(files_, {})) {
    try {
      base::write_whole_file(file, text);
    } catch (const base::InputError& error) {
      errors_.insert(errors_.end(), error.faults().begin(), error.faults().end());
    }
  }
}

void Outputs::write() {
  write_files();
  try {
    print(has_printed_ ? printed_ : shown_);
  } catch (const base::InputError& error) {
    errors_.insert(errors_.end(), error.faults().begin(), error.faults().end());
  }
  if (!errors_.empty()) throw base::InputError(std::exchange(errors_, {}));
}

void add_faults(const base::InputError& error, std::vector<std::string>& lines,
                base::FieldNames names) {
  for (const base::Fault& fault : error.faults()) lines.push_back(fault.text(names));
}

void print_error_text(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

void print_line(std::string_view line) noexcept {
  try {
    print_error_text("repose: " + base::printable(line) + '\n');
  } catch (const std::bad_alloc&) {
    print_error_text("repose: out of memory, so the error cannot be described\n");
  }
}

void print_lines(const std::vector<std::string>& lines) noexcept {
  for (const std::string& line : lines) print_line(line);
}

namespace {

namespace fs = std::filesystem;

/// Extensions of other kinds of files.
constexpr std::array<std::string_view, 14> kOtherEndings{".json", ".csv", ".html", ".htm", ".toml",
                                                         ".pdf",  ".stl", ".glb",  ".obj", ".ply",
                                                         ".vtp",  ".vtk", ".xlsx", ".ods"};

std::string small_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

/// Checks the name only, so that a page is never measured later as a photograph.
std::string error_of_name(const OutputPlace& place) {
  const std::string ending = small_ending(place.file);
  if (place.ending.empty() || ending == place.ending ||
      (ending == ".htm" && place.ending == ".html")) {
    return {};
  }
  const bool is_other =
      vision::has_picture_ending(place.file) || vision::has_film_ending(place.file) ||
      std::find(kOtherEndings.begin(), kOtherEndings.end(), ending) != kOtherEndings.end();
  if (!is_other) return {};
  return fmt::format("names of {} files are for another kind of file. Fix: a name that ends in {}.",
                     ending, place.ending);
}

/// A JSON file also contains the names of a CSV's columns, so only the header counts.
bool is_of_its_kind(std::string_view text, const OutputPlace& place) {
  if (place.ending != ".csv") return text.find(place.mark) != std::string_view::npos;
  const std::string_view header = text.substr(0, text.find('\n') + 1);
  return !header.starts_with('{') && !header.starts_with('[') &&
         header.find(place.mark) != std::string_view::npos;
}

/// The error for a file that already exists.
std::string error_of_earlier(const OutputPlace& place) {
  std::error_code ignored;
  if (!fs::is_regular_file(place.file, ignored) || fs::file_size(place.file, ignored) == 0) {
    return {};
  }
  constexpr const char* kFix = "Fix: choose another name, or move it away.";
  if (vision::has_picture_ending(place.file)) {
    return vision::is_made_here(place.file)
               ? ""
               : fmt::format("already exists, and is not a picture written by repose. {}", kFix);
  }
  if (place.mark.empty()) return {};
  const std::string other =
      fmt::format("already exists, and is not what this option writes. {}", kFix);
  try {
    return is_of_its_kind(base::read_whole_file(place.file), place) ? "" : other;
  } catch (const base::InputError&) {
    return other;  // an unreadable file is not ours either
  }
}

bool same_file(const fs::path& a, const fs::path& b) {
  return vision::identity(a) == vision::identity(b);
}

}  // namespace

OutputPlace json_place(const std::string& file, std::string_view key, const char* option) {
  return {.option = option, .file = file, .ending = ".json", .mark = key};
}

OutputPlace csv_place(const char* option, const std::string& file, std::string_view column) {
  return {.option = option, .file = file, .ending = ".csv", .mark = column};
}

OutputPlace page_place(const char* option, const std::string& file) {
  return {.option = option, .file = file, .ending = ".html", .mark = calibrate::report::kPageMark};
}

void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<fs::path>& inputs, std::vector<std::string>& errors) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [option, file, ending, mark] = places[i];
    if (file.empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (places[j].file.empty() || !same_file(places[j].file, file)) continue;
      errors.push_back(fmt::format("{} and {} both write to {}. Fix: give each its own file.",
                                   places[j].option, option, file));
    }
    if (file == kStandardOutput) continue;
    const bool is_input = std::any_of(inputs.begin(), inputs.end(), [&](const fs::path& input) {
      return !input.empty() && same_file(input, file);
    });
    std::string error = is_input ? "would overwrite an input file. Fix: choose another name."
                                 : error_of_name(places[i]);
    if (error.empty()) error = error_of_earlier(places[i]);
    if (!error.empty()) errors.push_back(fmt::format("{} {}: {}", option, file, error));
    try {
      base::check_can_write(file);
    } catch (const base::InputError& refused) {
      errors.push_back(fmt::format("{} {}", option, refused.what()));
    }
  }
}

bool make_output_folder(const char* option, const fs::path& folder,
                        std::vector<std::string>& errors) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; error || !fs::is_directory(folder, ignored)) {
    errors.push_back(fmt::format(
        "{} {}: the folder cannot be created ({}). Fix: choose a writable place.", option,
        folder.string(), error ? error.message() : "there is a file of that name"));
    return false;
  }
  try {
    base::check_can_write(folder / "file");
    return true;
  } catch (const base::InputError& unwritable) {
    errors.push_back(fmt::format("{} {}", option, unwritable.what()));
    return false;
  }
}

}  // namespace repose::cli
