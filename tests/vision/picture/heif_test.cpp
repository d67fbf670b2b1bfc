#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <libheif/heif.h>
#include <opencv2/core.hpp>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/picture/coded_pictures.h"
#include "vision/picture/picture.h"

/// HEIC and AVIF, written by libheif's encoders.
namespace repose::vision {
namespace {

using ::testing::AllOf;
using testing::Bytes;
using ::testing::HasSubstr;

heif_error append_to(heif_context* /*context*/, const void* data, std::size_t size, void* bytes) {
  const auto* from = static_cast<const std::uint8_t*>(data);
  auto& all = *static_cast<Bytes*>(bytes);
  all.insert(all.end(), from, from + size);
  return {heif_error_Ok, heif_suberror_Unspecified, ""};
}

struct Coded {
  heif_compression_format format = heif_compression_HEVC;
  heif_orientation orientation = heif_orientation_normal;
};

/// A picture whose left half is orange and whose right half is blue.
Bytes halves(int width, int height, const Coded& how) {
  heif_context* context = heif_context_alloc();
  heif_encoder* encoder = nullptr;
  EXPECT_EQ(heif_context_get_encoder_for_format(context, how.format, &encoder).code, heif_error_Ok);
  heif_encoder_set_lossy_quality(encoder, 95);
  heif_image* image = nullptr;
  heif_image_create(width, height, heif_colorspace_RGB, heif_chroma_interleaved_RGB, &image);
  heif_image_add_plane(image, heif_channel_interleaved, width, height, 8);
  int row_bytes = 0;
  std::uint8_t* pixels = heif_image_get_plane(image, heif_channel_interleaved, &row_bytes);
  cv::Mat samples(height, width, CV_8UC3, pixels, static_cast<std::size_t>(row_bytes));
  samples.setTo(cv::Scalar(200, 90, 40));  // red first
  samples.colRange(width / 2, width).setTo(cv::Scalar(30, 160, 220));
  heif_encoding_options* options = heif_encoding_options_alloc();
  options->image_orientation = how.orientation;
  EXPECT_EQ(heif_context_encode_image(context, image, encoder, options, nullptr).code,
            heif_error_Ok);
  Bytes bytes;
  heif_writer writer{.writer_api_version = 1, .write = append_to};
  heif_context_write(context, &writer, &bytes);
  heif_encoding_options_free(options);
  heif_image_release(image);
  heif_encoder_release(encoder);
  heif_context_free(context);
  return bytes;
}

class HeifPicture : public ::testing::Test {
 protected:
  Picture read(const std::string& name, const Bytes& bytes) const {
    return read_picture(folder_.write(name, bytes));
  }
  std::string error_of(const Bytes& bytes) const {
    try {
      read("heap.heic", bytes);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "it was read";
  }
  /// Blue, green and red at a place; the coding may change them slightly.
  static void expect_colour(const Picture& picture, int x, int y, const std::vector<int>& bgr) {
    constexpr int kLoss = 6;
    const auto at = std::size_t{3} * static_cast<std::size_t>(y * picture.width + x);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(picture.bgr[at + k], bgr[k], kLoss) << k;
  }

  testing::TemporaryFolder folder_;
};

TEST_F(HeifPicture, OfATelephoneIsReadWhateverItsName) {
  for (const heif_compression_format format : {heif_compression_HEVC, heif_compression_AV1}) {
    const Picture picture = read("IMG_0001.jpg", halves(96, 64, {.format = format}));
    ASSERT_EQ(picture.width, 96);
    ASSERT_EQ(picture.height, 64);
    expect_colour(picture, 16, 32, {40, 90, 200});
    expect_colour(picture, 80, 32, {220, 160, 30});
  }
}

TEST_F(HeifPicture, TakenOnItsSideIsUpright) {
  const Picture picture =
      read("heap.heic", halves(96, 64, {.orientation = heif_orientation_rotate_90_cw}));
  ASSERT_EQ(picture.width, 64);
  ASSERT_EQ(picture.height, 96);
  expect_colour(picture, 32, 16, {40, 90, 200});  // the left half is now at the top
  expect_colour(picture, 32, 80, {220, 160, 30});
}

TEST_F(HeifPicture, CutShortOrDamagedIsRefusedWithoutPrinting) {
  const Bytes whole = halves(96, 64, {});
  ::testing::internal::CaptureStderr();
  for (const double part : {.1, .5, .9}) {
    EXPECT_THAT(error_of(testing::first_part(whole, part)),
                AllOf(HasSubstr("heap.heic: "), HasSubstr("Fix: ")))
        << part;
  }
  EXPECT_THAT(error_of({0, 0, 0, 0x18, 'f', 't', 'y', 'p', 'h', 'e', 'i', 'c', 0, 0, 0, 0}),
              HasSubstr("Fix: "));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace repose::vision
