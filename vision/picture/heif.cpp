#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>

#include <libheif/heif.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/imgproc.hpp>

#include "base/input_error.h"
#include "vision/picture/decoding.h"
#include "vision/picture/other_formats.h"

/// HEIC and AVIF, as written by phones.
namespace repose::vision {

namespace {

template <auto kFree>
struct Deleter {
  template <typename Kind>
  void operator()(Kind* one) const {
    kFree(one);
  }
};

using Context = std::unique_ptr<heif_context, Deleter<heif_context_free>>;
using Handle = std::unique_ptr<heif_image_handle, Deleter<heif_image_handle_release>>;
using Image = std::unique_ptr<heif_image, Deleter<heif_image_release>>;
using Options = std::unique_ptr<heif_decoding_options, Deleter<heif_decoding_options_free>>;

void require(const heif_error& error) {
  if (error.code == heif_error_Ok) return;
  if (error.code == heif_error_Memory_allocation_error) throw std::bad_alloc();
  if (error.code == heif_error_Unsupported_filetype ||
      error.code == heif_error_Unsupported_feature) {
    throw base::InputError({.value = "is a HEIC or AVIF picture of a kind that cannot be read",
                            .fix = "convert it to JPEG, or set the telephone's camera to \"most "
                                   "compatible\"."});
  }
  throw base::InputError({.value = "the HEIC or AVIF picture is truncated or damaged",
                          .fix = "copy it from its source again."});
}

}  // namespace

Picture decode_heif(std::span<const std::uint8_t> bytes) {
  const Context context(heif_context_alloc());
  const Options options(heif_decoding_options_alloc());
  if (!context || !options) throw std::bad_alloc();
  require(heif_context_read_from_memory_without_copy(context.get(), bytes.data(), bytes.size(),
                                                     nullptr));
  heif_image_handle* found = nullptr;
  require(heif_context_get_primary_image_handle(context.get(), &found));
  const Handle handle(found);
  check_claimed_size(heif_image_handle_get_width(found), heif_image_handle_get_height(found));

  const bool has_alpha = heif_image_handle_has_alpha_channel(found) != 0;
  options->convert_hdr_to_8bit = 1;
  options->strict_decoding = 1;
  heif_image* decoded = nullptr;  // upright: the file's own rotations and mirroring are applied
  require(heif_decode_image(found, &decoded, heif_colorspace_RGB,
                            has_alpha ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB,
                            options.get()));
  const Image image(decoded);
  int row_bytes = 0;
  std::uint8_t* pixels = heif_image_get_plane(decoded, heif_channel_interleaved, &row_bytes);
  if (pixels == nullptr) require({heif_error_Invalid_input, {}, ""});
  const cv::Mat samples(heif_image_get_height(decoded, heif_channel_interleaved),
                        heif_image_get_width(decoded, heif_channel_interleaved),
                        has_alpha ? CV_8UC4 : CV_8UC3, pixels, static_cast<std::size_t>(row_bytes));
  cv::Mat bgr;
  cv::cvtColor(samples, bgr, has_alpha ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  return flatten(bgr);
}

}  // namespace repose::vision
