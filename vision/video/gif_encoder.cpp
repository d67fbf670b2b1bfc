#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>
#include <vector>

#include <gif_lib.h>

#include "vision/picture/made_here.h"
#include "vision/video/film_encoder.h"

namespace repose::vision {
namespace {

class GifEncoder : public FilmEncoder {
 public:
  GifEncoder(const std::filesystem::path& file, double frames_per_s, int width, int height)
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
               EGifPutExtensionTrailer(gif_) == GIF_OK &&
               EGifPutComment(gif_, kFilmComment) == GIF_OK;
  }
  ~GifEncoder() override {
    if (gif_ != nullptr) EGifCloseFile(gif_, nullptr);
  }
  GifEncoder(const GifEncoder&) = delete;
  GifEncoder& operator=(const GifEncoder&) = delete;
  GifEncoder(GifEncoder&&) = delete;
  GifEncoder& operator=(GifEncoder&&) = delete;

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

}  // namespace

std::unique_ptr<FilmEncoder> gif_encoder(const std::filesystem::path& file, double frames_per_s,
                                         int width, int height) {
  return std::make_unique<GifEncoder>(file, frames_per_s, width, height);
}

}  // namespace repose::vision
