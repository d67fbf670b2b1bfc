#include "vision/film/film_reader.h"

#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "vision/picture/picture.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;

/// Two pictures of 8K: what is decoded is kept several times.
constexpr double kMostPixels = 70e6;
constexpr double kUsualFramesPerS = 30;

[[noreturn]] void refuse(const fs::path& file, std::string_view what, std::string_view fix) {
  throw std::invalid_argument(fmt::format("{}: {}. Fix: {}", file.string(), what, fix));
}

/// By its first bytes: the decoder would also follow playlists to other files and places.
bool is_film(std::string_view head) {
  using namespace std::string_view_literals;
  if (head.size() < 12) return false;
  for (const std::string_view box : {"ftyp"sv, "moov"sv, "mdat"sv, "wide"sv, "free"sv, "skip"sv}) {
    if (head.substr(4, 4) == box) return true;
  }
  const bool is_avi = head.starts_with("RIFF") && head.substr(8, 3) == "AVI";
  return is_avi || head.starts_with("\x1a\x45\xdf\xa3"sv) || head.starts_with("GIF8");
}

void check(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) refuse(file, "no such file", "check the name.");
  if (fs::is_directory(file, error)) {
    refuse(file, "is a folder", "name the films in it, such as FOLDER/*.mp4.");
  }
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 12> head{};
  stream.read(head.data(), head.size());
  if (!stream && stream.gcount() == 0) refuse(file, "is empty or cannot be read", "copy it again.");
  if (!is_film({head.data(), static_cast<std::size_t>(stream.gcount())})) {
    refuse(file, "is no film that repose reads",
           "convert it to MP4 (H.264); MOV, AVI, MKV, WebM and GIF are read too.");
  }
}

}  // namespace

FilmReader::FilmReader(const fs::path& file) : file_(file) {
  check(file);
  if (!film_.open(file.string(), cv::CAP_FFMPEG)) {
    refuse(file, "the film cannot be decoded: it is damaged, or of an unknown kind",
           "copy it from the telephone again, or convert it to MP4 (H.264).");
  }
  const double width = film_.get(cv::CAP_PROP_FRAME_WIDTH);
  const double height = film_.get(cv::CAP_PROP_FRAME_HEIGHT);
  if (!(width * height <= kMostPixels)) {
    refuse(file,
           fmt::format("its frames are {:.0f} x {:.0f} pixels, {:.0f} million are the most", width,
                       height, kMostPixels / 1e6),
           "convert it to 1920 x 1080.");
  }
  const double count = film_.get(cv::CAP_PROP_FRAME_COUNT);
  claimed_frames_ = count > 0 && count < 1e9 ? static_cast<int>(count) : 0;
  const double rate = film_.get(cv::CAP_PROP_FPS);
  claimed_interval_s_ = 1 / (std::isfinite(rate) && rate > 0 ? rate : kUsualFramesPerS);
}

/// Where time stamps are missing or do not advance, one frame after the other.
double FilmReader::time_of_frame() {
  constexpr double kSPerMs = 1e-3;
  const double stamp_s = kSPerMs * film_.get(cv::CAP_PROP_POS_MSEC);
  if (frames_ == 0) {
    first_s_ = stamp_s;
    return 0;
  }
  const double time_s = stamp_s - first_s_;
  return std::isfinite(time_s) && time_s > last_s_ ? time_s : last_s_ + claimed_interval_s_;
}

bool FilmReader::next(FilmFrame& frame) {
  if (!film_.grab() || !film_.retrieve(frame.bgr) || frame.bgr.empty()) return false;
  if (size_.empty()) size_ = frame.bgr.size();
  if (frame.bgr.size() != size_ || frame.bgr.type() != CV_8UC3) {
    refuse(file_, "the size of its frames changes", "keep the part of one size.");
  }
  frame.time_s = last_s_ = time_of_frame();
  ++frames_;
  return true;
}

bool FilmReader::skip(FilmFrame& frame) {
  if (!film_.grab()) return false;
  frame.time_s = last_s_ = time_of_frame();
  ++frames_;
  return true;
}

}  // namespace repose::vision
