#include "render/film/film.h"

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gif_lib.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <sched.h>

#include "base/whole_file.h"

namespace repose::render {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& what, const char* fix) {
  throw std::invalid_argument(fmt::format("{}: {}. Fix: {}", file.string(), what, fix));
}

/// Keeps the calling thread to one processor. The encoder of H.264 takes as many threads as there
/// are processors for whoever opens it, and what it writes depends on their number and on chance;
/// the library that opens it has no other way to choose.
class OnOneProcessor {
 public:
  OnOneProcessor() {
    if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    is_bound_ = sched_setaffinity(0, sizeof one, &one) == 0;
  }
  ~OnOneProcessor() {
    if (is_bound_) sched_setaffinity(0, sizeof before_, &before_);
  }
  OnOneProcessor(const OnOneProcessor&) = delete;
  OnOneProcessor& operator=(const OnOneProcessor&) = delete;
  OnOneProcessor(OnOneProcessor&&) = delete;
  OnOneProcessor& operator=(OnOneProcessor&&) = delete;

 private:
  cpu_set_t before_ = {};
  bool is_bound_ = false;
};

constexpr const char* kFixPlace = "choose a folder you may write to, or free some space there.";

}  // namespace

/// Appends pictures to a file of one kind.
class Film::Writer {
 public:
  Writer() = default;
  virtual ~Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  Writer(Writer&&) = delete;
  Writer& operator=(Writer&&) = delete;

  /// Both return whether it worked.
  virtual bool add(const vision::Picture& picture) = 0;
  virtual bool close() = 0;
};

class Film::Mp4Writer : public Film::Writer {
 public:
  Mp4Writer(const fs::path& file, double frames_per_s, int width, int height)
      : file_(file), size_(width & ~1, height & ~1) {  // H.264 halves the colours' resolution
    const OnOneProcessor while_opened;
    writer_.open(file_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                 frames_per_s, size_);
  }

  bool add(const vision::Picture& picture) override {
    if (!writer_.isOpened()) return false;
    const cv::Mat whole(picture.height, picture.width, CV_8UC3,
                        const_cast<std::uint8_t*>(picture.bgr.data()));
    writer_.write(whole(cv::Rect({0, 0}, size_)));
    ++frames_;
    return true;
  }
  /// The library does not say that a disk was full: what can be read again was written.
  bool close() override {
    writer_.release();
    cv::VideoCapture film(file_.string(), cv::CAP_FFMPEG);
    int frames = 0;
    while (film.grab()) ++frames;
    return frames == frames_;
  }

 private:
  fs::path file_;
  cv::Size size_;
  cv::VideoWriter writer_;
  int frames_ = 0;
};

class Film::GifWriter : public Film::Writer {
 public:
  GifWriter(const fs::path& file, double frames_per_s, int width, int height)
      : width_(width),
        height_(height),
        delay_cs_(
            static_cast<unsigned char>(std::clamp(std::round(100 / frames_per_s), 1.0, 255.0))),
        gif_(EGifOpenFileName(file.c_str(), false, nullptr)) {
    if (gif_ == nullptr) return;
    EGifSetGifVersion(gif_, true);
    is_good_ = EGifPutScreenDesc(gif_, width, height, 8, 0, nullptr) == GIF_OK;
    const std::array<unsigned char, 3> forever = {1, 0, 0};
    is_good_ = is_good_ && EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
               EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0") == GIF_OK &&
               EGifPutExtensionBlock(gif_, forever.size(), forever.data()) == GIF_OK &&
               EGifPutExtensionTrailer(gif_) == GIF_OK;
  }
  ~GifWriter() override {
    if (gif_ != nullptr) EGifCloseFile(gif_, nullptr);
  }
  GifWriter(const GifWriter&) = delete;
  GifWriter& operator=(const GifWriter&) = delete;
  GifWriter(GifWriter&&) = delete;
  GifWriter& operator=(GifWriter&&) = delete;

  bool add(const vision::Picture& picture) override {
    if (gif_ == nullptr || !is_good_) return false;
    const std::size_t pixels = picture.bgr.size() / 3;
    std::array<std::vector<GifByteType>, 3> planes;  // blue, green, red
    for (std::size_t c = 0; c < 3; ++c) {
      planes[c].resize(pixels);
      for (std::size_t k = 0; k < pixels; ++k) planes[c][k] = picture.bgr[3 * k + c];
    }
    std::vector<GifByteType> numbers(pixels);
    constexpr int kColours = 256;
    int colours = kColours;
    ColorMapObject* map = GifMakeMapObject(kColours, nullptr);
    const std::array<unsigned char, 4> control = {0, delay_cs_, 0, 0};
    is_good_ =
        map != nullptr &&
        GifQuantizeBuffer(static_cast<unsigned>(width_), static_cast<unsigned>(height_), &colours,
                          planes[2].data(), planes[1].data(), planes[0].data(), numbers.data(),
                          map->Colors) == GIF_OK &&
        EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, control.size(), control.data()) == GIF_OK &&
        EGifPutImageDesc(gif_, 0, 0, width_, height_, false, map) == GIF_OK;
    for (int row = 0; row < height_ && is_good_; ++row) {
      is_good_ = EGifPutLine(gif_, numbers.data() + static_cast<std::ptrdiff_t>(row) * width_,
                             width_) == GIF_OK;
    }
    GifFreeMapObject(map);
    return is_good_;
  }
  bool close() override {
    if (gif_ == nullptr) return false;
    is_good_ = EGifCloseFile(std::exchange(gif_, nullptr), nullptr) == GIF_OK && is_good_;
    return is_good_;
  }

 private:
  int width_, height_;
  unsigned char delay_cs_;
  GifFileType* gif_;
  bool is_good_ = false;
};

Film::Film(fs::path file, double frames_per_s)
    : file_(std::move(file)), frames_per_s_(frames_per_s) {
  const std::string ending = file_.extension().string();
  if (ending != ".mp4" && ending != ".gif") {
    refuse(file_, "no film can be written as \"" + ending + '"',
           "let the name end in .mp4 or .gif.");
  }
}

Film::~Film() = default;

void Film::open_writer() {
  part_ = base::part_of(file_);
  if (file_.extension() == ".gif") {
    writer_ = std::make_unique<GifWriter>(part_->path(), frames_per_s_, width_, height_);
  } else {
    writer_ = std::make_unique<Mp4Writer>(part_->path(), frames_per_s_, width_, height_);
  }
}

void Film::add(const vision::Picture& picture) {
  if (!writer_) {
    width_ = picture.width;
    height_ = picture.height;
    if (width_ < 2 || height_ < 2)
      refuse(file_, "its picture size is too small", "640 x 480 pixels.");
    open_writer();
  }
  if (picture.width != width_ || picture.height != height_) {
    refuse(file_, "its pictures are not all of one size", "draw them alike.");
  }
  if (!writer_->add(picture)) refuse(file_, "cannot be written", kFixPlace);
}

void Film::close() {
  if (!writer_) refuse(file_, "it has no pictures", "add one.");
  if (!writer_->close()) refuse(file_, "cannot be written", kFixPlace);
  base::put_in_place(*part_, file_);
}

}  // namespace repose::render
