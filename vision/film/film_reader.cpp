#include "vision/film/film_reader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "vision/picture/film_head.h"
#include "vision/picture/opencv.h"
#include "vision/picture/picture.h"
#include "vision/video/video_decoder.h"

namespace repose::vision {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> kEndings{".jpg",  ".jpeg", ".png",  ".tif",
                                                   ".tiff", ".bmp",  ".webp", ".heic"};

[[noreturn]] void refuse_frames(const fs::path& folder, const std::string& what,
                                const std::string& fix) {
  throw base::InputError({.where = folder.string(),
                          .value = what,
                          .rule = "a folder that is a film holds its frames as pictures whose "
                                  "names differ in their numbers alone, such as frame_0001.png",
                          .fix = fix});
}

std::string small_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

/// A name split at the last number in it.
struct NumberedName {
  std::string others;  ///< the text before and after the number
  std::int64_t number = 0;
};

std::optional<NumberedName> numbered(const fs::path& file) {
  constexpr const char* kDigits = "0123456789";
  const std::string name = file.stem().string();
  const std::size_t last = name.find_last_of(kDigits);
  if (last == std::string::npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of(kDigits, last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  NumberedName found{.others =
                         name.substr(0, first) + '*' + name.substr(last + 1) + small_ending(file)};
  const char* end = name.data() + last + 1;
  const auto read = std::from_chars(name.data() + first, end, found.number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return found;
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    const std::string ending = small_ending(entry->path());
    if (!is_hidden && std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end()) {
      pictures.push_back(entry->path());
    }
  }
  if (error)
    refuse_frames(folder, "cannot be read: " + error.message(), "get permission to read it.");
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

}  // namespace

std::vector<FrameFile> frame_files(const fs::path& folder) {
  std::vector<FrameFile> frames;
  std::string others;
  for (const fs::path& picture : pictures_in(folder)) {
    const auto name = numbered(picture);
    if (!name) {
      refuse_frames(folder,
                    fmt::format("{} has no number in its name", picture.filename().string()),
                    "move it elsewhere, or name the pictures by themselves.");
    }
    if (frames.empty()) others = name->others;
    if (name->others != others) {
      refuse_frames(
          folder,
          fmt::format("{} and {} differ in more than a number",
                      frames.front().file.filename().string(), picture.filename().string()),
          "a folder for each film.");
    }
    frames.push_back({.file = picture, .place = name->number});
  }
  if (frames.empty()) {
    refuse_frames(folder, "has no pictures", "name the folder of the frames, or the films in it.");
  }
  std::sort(frames.begin(), frames.end(),
            [](const FrameFile& a, const FrameFile& b) { return a.place < b.place; });
  std::int64_t step = 0;
  const std::int64_t first = frames.front().place;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const std::int64_t gap = frames[k].place - frames[k - 1].place;
    if (gap == 0) {
      refuse_frames(
          folder,
          fmt::format("{} and {} have the same number", frames[k - 1].file.filename().string(),
                      frames[k].file.filename().string()),
          "remove one of them.");
    }
    step = std::gcd(step, gap);
  }
  for (FrameFile& frame : frames) {
    frame.place = step > 0 ? (frame.place - first) / step : 0;
  }
  return frames;
}

namespace {

namespace fs = std::filesystem;

/// Two 8K pictures: decoded frames are held several times.
constexpr double kMaxFramePixels = 70e6;
constexpr double kUsualFramesPerS = 30;

void check_size(const fs::path& file, double pixels) {
  if (pixels <= kMaxFramePixels) return;
  base::refuse(file,
               fmt::format("its frames have {:.0f} million pixels, {:.0f} million are the most",
                           pixels / 1e6, kMaxFramePixels / 1e6),
               "convert it to 1920 x 1080.");
}

void check(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) base::refuse(file, "no such file", "check the name.");
  if (fs::is_directory(file, error)) {
    base::refuse(
        file, "is a folder",
        "name the films in it, such as FOLDER/*.mp4; of a folder of numbered frames say with "
        "--fps how many were taken a second.");
  }
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 12> head{};
  stream.read(head.data(), head.size());
  if (!stream && stream.gcount() == 0)
    base::refuse(file, "is empty or cannot be read", "copy it again.");
  // Judged by its first bytes: the decoder would also follow playlists to other files and
  // addresses.
  if (!is_film({head.data(), static_cast<std::size_t>(stream.gcount())})) {
    base::refuse(file, "is no film that repose reads",
                 "convert it to MP4 (H.264); MOV, AVI, MKV, WebM and GIF are read too.");
  }
}

}  // namespace

/// Where frames come from.
class FilmReader::Source {
 public:
  Source() = default;
  virtual ~Source() = default;
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;
  Source(Source&&) = delete;
  Source& operator=(Source&&) = delete;

  /// False at the end; for a skipped frame only the time is set.
  virtual bool next(FilmFrame& frame, bool is_skipped) = 0;
  virtual int claimed_frames() const = 0;
  /// Unit of which times are multiples; 0: not rounded.
  virtual double time_unit_s() const { return 0; }
};

/// A file.
class FilmReader::VideoSource : public FilmReader::Source {
 public:
  explicit VideoSource(const fs::path& file)
      : film_((check(file), file)),
        claimed_interval_s_(1 / film_.claimed_frames_per_s().value_or(kUsualFramesPerS)) {
    check_size(file, film_.claimed_pixels());
  }

  bool next(FilmFrame& frame, bool is_skipped) override {
    if (!film_.advance()) return false;
    if (!is_skipped) film_.copy_to(frame.bgr);
    frame.time_s = last_s_ = time_of_frame();
    ++frames_;
    return true;
  }
  int claimed_frames() const override {
    const std::int64_t count = film_.claimed_frames();
    return count > 0 && count < kMaxFrames ? static_cast<int>(count) : 0;
  }
  double time_unit_s() const override { return film_.stamp_unit_s(); }

 private:
  /// If time stamps are missing or do not advance, adds the nominal frame interval.
  double time_of_frame() {
    const std::optional<double> stamp_s = film_.time_stamp_s();
    if (frames_ == 0) {
      first_s_ = stamp_s.value_or(0);
      return 0;
    }
    const double usual_s = last_s_ + claimed_interval_s_;
    if (!stamp_s) return usual_s;
    const double time_s = *stamp_s - first_s_;
    return time_s > last_s_ ? time_s : usual_s;
  }

  static constexpr std::int64_t kMaxFrames = 1'000'000'000;

  VideoDecoder film_;
  double claimed_interval_s_;
  int frames_ = 0;
  double first_s_ = 0;
  double last_s_ = 0;
};

/// Numbered pictures: a missing number is a dropped frame.
class FilmReader::FolderSource : public FilmReader::Source {
 public:
  FolderSource(const fs::path& folder, double frames_per_s)
      : frames_(frame_files(folder)), interval_s_(1 / frames_per_s) {}

  bool next(FilmFrame& frame, bool is_skipped) override {
    if (next_ == frames_.size()) return false;
    const FrameFile& now = frames_[next_++];
    frame.time_s = static_cast<double>(now.place) * interval_s_;
    if (is_skipped) return true;
    picture_ = read_picture(now.file);
    check_size(now.file, 1. * picture_.width * picture_.height);
    frame.bgr = mat_of(picture_);
    return true;
  }
  int claimed_frames() const override { return static_cast<int>(frames_.size()); }

 private:
  std::vector<FrameFile> frames_;
  double interval_s_;
  std::size_t next_ = 0;
  Picture picture_;  ///< owns the last frame's pixels
};

FilmReader::FilmReader(const FilmFile& file, std::vector<double> times_s)
    : file_(file.path), times_s_(std::move(times_s)), turn_deg_(file.turn_deg), lens_(file.lens) {
  keep_opencv_to_one_thread();
  std::error_code error;
  if (file.frames_per_s && fs::is_directory(file_, error)) {
    source_ = std::make_unique<FolderSource>(file_, *file.frames_per_s);
  } else {
    source_ = std::make_unique<VideoSource>(file_);
  }
}

FilmReader::~FilmReader() = default;

int FilmReader::claimed_frames() const { return source_->claimed_frames(); }

double FilmReader::time_unit_s() const { return source_->time_unit_s(); }

bool FilmReader::advance(FilmFrame& frame, bool is_skipped) {
  if (!source_->next(frame, is_skipped)) return false;
  if (number_ < times_s_.size()) frame.time_s = times_s_[number_];
  ++number_;
  return true;
}

bool FilmReader::next(FilmFrame& frame) {
  if (!advance(frame, false)) return false;
  if (size_.empty()) size_ = frame.bgr.size();
  if (frame.bgr.size() != size_) {
    base::refuse(file_, "the size of its frames changes", "keep the part of one size.");
  }
  if (turn_deg_ != 0) {
    cv::swap(seen_, frame.bgr);
    turn(seen_, turn_deg_, frame.bgr);
  }
  if (!lens_) return true;
  if (!correction_) {
    correction_.emplace(lens_for(turned(*lens_, turn_deg_), frame.bgr.cols, frame.bgr.rows));
  }
  cv::swap(seen_, frame.bgr);
  correction_->correct(seen_, frame.bgr);
  return true;
}

bool FilmReader::skip(FilmFrame& frame) { return advance(frame, true); }

}  // namespace repose::vision
