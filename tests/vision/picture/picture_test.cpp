#include "vision/picture/picture.h"

#include <array>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>
#include <unistd.h>

#include "base/input_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/picture/coded_pictures.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using testing::Bytes;
using testing::coded;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using testing::TemporaryFolder;
using ::testing::ThrowsMessage;

using Colour = std::array<int, 3>;

Colour colour_at(const Picture& picture, int x, int y) {
  const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(x));
  return {picture.bgr[at], picture.bgr[at + 1], picture.bgr[at + 2]};
}

/// Error of JPEG at full quality on uniform areas.
constexpr int kJpegLoss = 3;

void expect_colour(const Colour& actual, const Colour& expected, int tolerance) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    EXPECT_NEAR(actual[channel], expected[channel], tolerance) << "channel " << channel;
  }
}

cv::Mat noise(int width, int height) {
  cv::Mat samples(height, width, CV_8UC3);
  cv::RNG random(7);
  random.fill(samples, cv::RNG::UNIFORM, 0, 256);
  return samples;
}

class PictureFile : public ::testing::Test {
 protected:
  Picture read(const std::string& name, const Bytes& bytes) const {
    return read_picture(folder_.write(name, bytes));
  }
  /// The error for a file with that content.
  std::string error_of(const std::string& name, const Bytes& bytes) const {
    return error_of(folder_.write(name, bytes));
  }
  static std::string error_of(const std::filesystem::path& file) {
    try {
      read_picture(file);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "it was read";
  }

  TemporaryFolder folder_;
};

TEST_F(PictureFile, LosslessFormatsKeepEveryPixel) {
  const cv::Mat samples = noise(37, 23);
  for (const char* ending : {".png", ".tif", ".bmp"}) {
    const Picture picture = read(std::string("heap") + ending, coded(ending, samples));
    ASSERT_EQ(picture.width, 37) << ending;
    ASSERT_EQ(picture.height, 23) << ending;
    EXPECT_TRUE(std::equal(picture.bgr.begin(), picture.bgr.end(), samples.datastart)) << ending;
  }
}

TEST_F(PictureFile, LossyFormatsKeepColours) {
  const cv::Mat samples(24, 40, CV_8UC3, cv::Scalar(40, 90, 200));
  for (const char* ending : {".jpg", ".webp"}) {
    const Picture picture = read(std::string("heap") + ending, coded(ending, samples));
    ASSERT_EQ(picture.width, 40) << ending;
    expect_colour(colour_at(picture, 20, 12), {40, 90, 200}, kJpegLoss);
  }
}

TEST_F(PictureFile, ContentDecidesNotTheName) {
  EXPECT_EQ(read("heap.jpg", coded(".png", noise(5, 4))).width, 5);
}

TEST_F(PictureFile, GreyBecomesColour) {
  const cv::Mat grey(8, 8, CV_8U, cv::Scalar(77));
  for (const char* ending : {".png", ".tif", ".bmp", ".jpg"}) {
    const Picture picture = read(std::string("grey") + ending, coded(ending, grey));
    expect_colour(colour_at(picture, 4, 4), {77, 77, 77}, 1);
  }
}

TEST_F(PictureFile, SixteenBitsBecomeEight) {
  cv::Mat samples(4, 4, CV_16UC3, cv::Scalar(0, 128 * 257, 255 * 257));
  for (const char* ending : {".png", ".tif"}) {
    const Picture picture = read(std::string("deep") + ending, coded(ending, samples));
    EXPECT_THAT(colour_at(picture, 1, 1), ElementsAre(0, 128, 255)) << ending;
  }
}

TEST_F(PictureFile, TwelveBitsInSixteenAreStretched) {
  cv::Mat samples(4, 4, CV_16U, cv::Scalar(2048));
  samples.at<std::uint16_t>(0, 0) = 4095;
  for (const char* ending : {".png", ".tif"}) {
    const Picture picture = read(std::string("raw") + ending, coded(ending, samples));
    EXPECT_EQ(colour_at(picture, 0, 0)[0], 255) << ending;
    EXPECT_NEAR(colour_at(picture, 2, 2)[0], 128, 1) << ending;
  }
}

TEST_F(PictureFile, TransparentPartsContrastWithTheRest) {
  for (const int brightness : {30, 220}) {
    cv::Mat samples(6, 6, CV_8UC4, cv::Scalar(9, 9, 9, 0));
    samples(cv::Rect(0, 0, 3, 6)).setTo(cv::Scalar(brightness, brightness, brightness, 255));
    const int background = brightness < 128 ? 255 : 0;
    for (const char* ending : {".png", ".tif"}) {
      const Picture picture = read(std::string("cut_out") + ending, coded(ending, samples));
      EXPECT_EQ(colour_at(picture, 1, 1)[0], brightness) << ending;
      EXPECT_EQ(colour_at(picture, 4, 1)[0], background) << ending;
    }
  }
}

TEST_F(PictureFile, HalfTransparentIsMixed) {
  const cv::Mat samples(6, 6, CV_8UC4, cv::Scalar(50, 50, 50, 127));
  const Picture picture = read("half.png", coded(".png", samples));
  EXPECT_NEAR(colour_at(picture, 1, 1)[0], 50 * 127 / 255.0 + 128, 1);
}

TEST_F(PictureFile, NothingVisibleIsRefused) {
  const cv::Mat samples(6, 6, CV_8UC4, cv::Scalar(50, 50, 50, 0));
  EXPECT_THAT(error_of("ghost.png", coded(".png", samples)), HasSubstr("transparent"));
}

TEST_F(PictureFile, InksBecomeLight) {
  // Full cyan and half black: no red, half of green and blue.
  const std::vector<std::uint8_t> inks = {255, 0, 0, 128};
  for (const bool is_adobe : {true, false}) {
    const Picture picture = read("print.jpg", testing::cmyk_jpeg(16, 16, inks, is_adobe));
    expect_colour(colour_at(picture, 8, 8), {127, 127, 0}, kJpegLoss);
  }
}

/// Red, green, blue and white quarters, named in the order top left, top right, bottom left,
/// bottom right.
cv::Mat quarters() {
  cv::Mat samples(32, 64, CV_8UC3, cv::Scalar(255, 255, 255));
  samples(cv::Rect(0, 0, 32, 16)).setTo(cv::Scalar(0, 0, 255));
  samples(cv::Rect(32, 0, 32, 16)).setTo(cv::Scalar(0, 255, 0));
  samples(cv::Rect(0, 16, 32, 16)).setTo(cv::Scalar(255, 0, 0));
  return samples;
}

std::string quarter_names(const Picture& picture) {
  std::string names;
  for (const int y : {picture.height / 4, 3 * picture.height / 4}) {
    for (const int x : {picture.width / 4, 3 * picture.width / 4}) {
      const auto [blue, green, red] = colour_at(picture, x, y);
      const bool is_white = blue > 200 && green > 200;
      names += is_white ? 'W' : blue > 200 ? 'B' : green > 200 ? 'G' : red > 200 ? 'R' : '?';
    }
  }
  return names;
}

TEST_F(PictureFile, ExifOrientationIsApplied) {
  // By the table of the EXIF standard: at which side the stored first row and column appear.
  const std::array<std::string, 8> seen = {"RGBW", "GRWB", "WBGR", "BWRG",
                                           "RBGW", "BRWG", "WGBR", "GWRB"};
  const Bytes jpeg = coded(".jpg", quarters());
  const Bytes png = coded(".png", quarters());
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const std::string& expected = seen[static_cast<std::size_t>(orientation - 1)];
    for (const Picture& picture :
         {read("turned.jpg", testing::with_exif(jpeg, orientation)),
          read("turned.png", testing::with_exif_in_png(png, orientation))}) {
      EXPECT_EQ(quarter_names(picture), expected) << orientation;
      EXPECT_EQ(picture.width, orientation <= 4 ? 64 : 32) << orientation;
    }
  }
}

TEST_F(PictureFile, NonsenseOrientationIsUpright) {
  const Bytes jpeg = coded(".jpg", quarters());
  for (const int orientation : {0, 9, 200}) {
    EXPECT_EQ(quarter_names(read("odd.jpg", testing::with_exif(jpeg, orientation))), "RGBW");
  }
}

TEST_F(PictureFile, OnePixelIsAPicture) {
  const cv::Mat pixel(1, 1, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_THAT(colour_at(read("dot.png", coded(".png", pixel)), 0, 0), ElementsAre(1, 2, 3));
}

TEST_F(PictureFile, CutShortIsRefusedInEveryFormatWithoutPrinting) {
  const cv::Mat samples = noise(64, 48);
  ::testing::internal::CaptureStderr();
  for (const char* ending : {".jpg", ".png", ".tif", ".bmp", ".webp"}) {
    const Bytes whole = coded(ending, samples);
    for (const double part : {0.1, 0.5, 0.9}) {
      const std::string name = std::string("cut") + ending;
      EXPECT_THAT(
          error_of(name, testing::first_part(whole, part)),
          AllOf(HasSubstr(name + ": "), HasSubstr("truncated or damaged"), HasSubstr("Fix: ")))
          << part;
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(PictureFile, DamageIsRefusedWithoutPrinting) {
  ::testing::internal::CaptureStderr();
  for (const char* ending : {".jpg", ".png"}) {
    Bytes bytes = coded(ending, noise(64, 48));
    // A marker in the middle of the coded pixels, which no encoder writes.
    bytes[bytes.size() / 2] = 0xFF;
    bytes[bytes.size() / 2 + 1] = 0xD5;
    EXPECT_THAT(error_of(std::string("hit") + ending, bytes), HasSubstr("damaged")) << ending;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

/// Changes the little-endian two-byte number at a place.
Bytes with_change(Bytes bytes, std::size_t at, int change) {
  const int number = bytes.at(at) + 256 * bytes.at(at + 1) + change;
  bytes[at] = static_cast<std::uint8_t>(number);
  bytes[at + 1] = static_cast<std::uint8_t>(number / 256);
  return bytes;
}

TEST_F(PictureFile, OfATiffsPagesTheLargestIsThePicture) {
  const auto file = folder_.path() / "pages.tif";
  const std::vector<cv::Mat> with_preview = {noise(16, 12), noise(64, 48), noise(32, 24)};
  cv::imwritemulti(file.string(), with_preview);
  const Picture picture = read_picture(file);
  EXPECT_EQ(picture.width, 64);
  EXPECT_EQ(cv::norm(mat_of(picture), with_preview[1], cv::NORM_INF), 0);

  cv::imwritemulti(file.string(),
                   std::vector<cv::Mat>{noise(64, 48), noise(16, 12), noise(64, 48)});
  try {
    read_picture(file);
    FAIL() << "which of the two is the heap's, only a person knows";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("2 pages of 64 x 48 pixels"), HasSubstr("Fix: ")));
  }
}

/// Position of a tag's value in a little-endian TIFF.
std::size_t tiff_value(const Bytes& bytes, int tag) {
  std::size_t entry = bytes.at(4) + 256U * bytes.at(5) + 65536U * bytes.at(6) + 2;
  while (bytes.at(entry) + 256 * bytes.at(entry + 1) != tag) entry += 12;
  return entry + 8;
}

TEST_F(PictureFile, SizesThatTheFileDoesNotHoldAreRefused) {
  const cv::Mat samples = noise(64, 48);
  const Bytes bmp = coded(".bmp", samples), webp = coded(".webp", samples);
  Bytes tiff;
  cv::imencode(".tif", samples, tiff, {cv::IMWRITE_TIFF_COMPRESSION, 1});  // uncompressed
  constexpr int kTiffWidth = 256, kTiffHeight = 257;
  constexpr std::size_t kBmpWidth = 18, kBmpHeight = 22, kRiffLength = 4;
  EXPECT_EQ(read("whole.bmp", bmp).width, 64);
  EXPECT_EQ(read("whole.tif", tiff).width, 64);
  EXPECT_EQ(read("whole.webp", webp).width, 64);
  for (const int change : {-16, -1}) {
    for (const Bytes& bytes :
         {with_change(bmp, kBmpWidth, 8 * change), with_change(bmp, kBmpHeight, change),
          with_change(tiff, tiff_value(tiff, kTiffWidth), change),
          with_change(tiff, tiff_value(tiff, kTiffHeight), change),
          with_change(webp, kRiffLength, 2 * change)}) {
      EXPECT_THAT(error_of("wrong", bytes), AllOf(HasSubstr("damaged"), HasSubstr("Fix: ")))
          << change;
    }
  }
}

TEST_F(PictureFile, PalettesThatDoNotFitAreRefusedWithoutPrinting) {
  const cv::Mat grey(48, 64, CV_8UC1, cv::Scalar(100));
  const Bytes whole = coded(".bmp", grey);
  ASSERT_EQ(whole.at(28), 8) << "bits a pixel, with a palette";
  EXPECT_THAT(colour_at(read("grey.bmp", whole), 0, 0), ElementsAre(100, 100, 100));
  constexpr std::size_t kPixelsFrom = 10, kHeaderBytes = 14, kColours = 46;
  ::testing::internal::CaptureStderr();
  for (const auto& [at, change] : {std::pair{kColours, 0x7FFF},
                                   {kColours, 257 - whole.at(kColours)},
                                   {kHeaderBytes, 4000},
                                   {kPixelsFrom, -1000}}) {
    EXPECT_THAT(error_of("palette.bmp", with_change(whole, at, change)), HasSubstr("damaged"));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST_F(PictureFile, GiantClaimsAreRefusedBeforeMemoryIsAskedFor) {
  for (const Bytes& bytes :
       {testing::png_that_claims(50'000, 50'000), testing::jpeg_that_claims(50'000, 50'000),
        testing::bmp_that_claims(50'000, 50'000)}) {
    EXPECT_THAT(error_of("bomb", bytes),
                AllOf(HasSubstr("50000 x 50000"), HasSubstr("200 million"), HasSubstr("Fix: ")));
  }
}

TEST_F(PictureFile, MissingFileIsNamed) {
  const std::string file = (folder_.path() / "nowhere.jpg").string();
  EXPECT_THAT(error_of(file),
              AllOf(StartsWith(file + ": "), HasSubstr("no such file"), HasSubstr("Fix: ")));
}

TEST_F(PictureFile, FolderIsNoPicture) {
  EXPECT_THAT(error_of(folder_.path()), HasSubstr("is a folder"));
}

TEST_F(PictureFile, EmptyFileIsSaid) {
  EXPECT_THAT(error_of("empty.jpg", Bytes{}), HasSubstr("is empty"));
}

TEST_F(PictureFile, TextIsNoPicture) {
  EXPECT_THAT(error_of(folder_.write("notes.jpg", std::string("angle: 23 degrees"))),
              HasSubstr("none of JPEG, HEIC, PNG, TIFF, BMP, WebP"));
}

TEST_F(PictureFile, FilmIsNamed) {
  for (const std::string& head :
       {std::string("\0\0\0\x20", 4) + "ftypisom\x02", std::string("\0\0\0\x14", 4) + "ftypqt  ",
        std::string("\0\0\0\x08", 4) + "wide....", std::string("RIFF....AVI LIST")}) {
    EXPECT_THAT(error_of(folder_.write("heap.jpg", head + "........")),
                AllOf(HasSubstr("is a film"), Not(HasSubstr("HEIC"))));
  }
}

TEST_F(PictureFile, UnreadableFileIsSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  const auto file = folder_.write("locked.png", coded(".png", noise(4, 4)));
  std::filesystem::permissions(file, std::filesystem::perms::none);
  EXPECT_THAT(error_of(file), HasSubstr("cannot be read"));
}

Picture striped(int width, int height) {
  Picture picture{.width = width, .height = height, .bgr = {}};
  for (int i = 0; i < 3 * width * height; ++i) {
    picture.bgr.push_back(static_cast<std::uint8_t>(i * 31));
  }
  return picture;
}

TEST_F(PictureFile, WrittenPngReadsBackTheSame) {
  const Picture picture = striped(31, 17);
  const auto file = folder_.path() / "new.PNG";
  write_picture(file, picture);
  EXPECT_EQ(read_picture(file).bgr, picture.bgr);
  EXPECT_THAT(folder_.names(), ElementsAre("new.PNG"));
}

TEST_F(PictureFile, WrittenJpegReadsBack) {
  const auto file = folder_.path() / "new.jpg";
  write_picture(file, striped(31, 17));
  EXPECT_EQ(read_picture(file).width, 31);
}

TEST_F(PictureFile, WritingReplacesTheOldPicture) {
  const auto file = folder_.write("heap.png", std::string("old"));
  write_picture(file, striped(5, 5));
  EXPECT_EQ(read_picture(file).width, 5);
}

TEST_F(PictureFile, WritingErrorsAreSaidAndLeaveNothingBehind) {
  const Picture picture = striped(5, 5);
  const auto fails_with = [](const std::string& text) {
    return ThrowsMessage<base::InputError>(AllOf(HasSubstr(text), HasSubstr("Fix: ")));
  };
  EXPECT_THAT([&] { write_picture(folder_.path() / "no" / "heap.png", picture); },
              fails_with("there is no folder"));
  EXPECT_THAT([&] { write_picture(folder_.path() / "heap.gif", picture); }, fails_with(".png"));
  EXPECT_THAT([&] { write_picture(folder_.path() / "heap.png", Picture{}); }, fails_with("0 x 0"));
  std::filesystem::create_directory(folder_.path() / "taken.png");
  EXPECT_THAT([&] { write_picture(folder_.path() / "taken.png", picture); },
              fails_with("is a folder"));
  EXPECT_THAT(folder_.names(), ElementsAre("taken.png"));
}

}  // namespace
}  // namespace repose::vision
