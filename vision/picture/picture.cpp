#include "vision/picture/picture.h"

#include <algorithm>
#include <cctype>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "vision/picture/decoding.h"
#include "vision/picture/film_head.h"
#include "vision/picture/jpeg.h"
#include "vision/picture/made_here.h"
#include "vision/picture/opencv.h"
#include "vision/picture/other_formats.h"
#include "vision/picture/png.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::uint8_t>;

constexpr int kJpegQuality = 95;

std::string_view text_at(Bytes bytes, std::size_t from, std::size_t length) {
  if (from + length > bytes.size()) return {};
  return {reinterpret_cast<const char*>(bytes.data()) + from, length};
}

enum class Format { jpeg, png, tiff, bmp, webp, heic, film, unknown };

/// Whether a container's major brand is that of HEIC or AVIF.
bool is_picture_brand(std::string_view brand) {
  return brand.starts_with("he") || brand == "mif1" || brand == "msf1" || brand.starts_with("avi");
}

/// By content: names may be wrong.
Format format_of(Bytes bytes) {
  if (text_at(bytes, 0, 3) == "\xFF\xD8\xFF") return Format::jpeg;
  if (text_at(bytes, 0, 4) == "\x89PNG") return Format::png;
  using namespace std::string_view_literals;
  if (text_at(bytes, 0, 4) == "II*\0"sv || text_at(bytes, 0, 4) == "MM\0*"sv) return Format::tiff;
  if (text_at(bytes, 0, 2) == "BM" && bytes.size() > 26) return Format::bmp;
  if (text_at(bytes, 0, 4) == "RIFF" && text_at(bytes, 8, 4) == "WEBP") return Format::webp;
  if (text_at(bytes, 4, 4) == "ftyp" && is_picture_brand(text_at(bytes, 8, 4))) {
    return Format::heic;
  }
  const bool is_gif = text_at(bytes, 0, 4) == "GIF8";  // most of them are pictures
  if (!is_gif && is_film(text_at(bytes, 0, std::min<std::size_t>(bytes.size(), 16)))) {
    return Format::film;
  }
  return Format::unknown;
}

Picture decode(Bytes bytes) {
  switch (format_of(bytes)) {
    case Format::jpeg:
      return turned_upright(decode_jpeg(bytes), jpeg_orientation(bytes));
    case Format::png:
      return decode_png(bytes);
    case Format::tiff:
      return decode_tiff(bytes);
    case Format::bmp:
      return decode_bmp(bytes);
    case Format::webp:
      return decode_webp(bytes);
    case Format::heic:
      return decode_heif(bytes);
    case Format::film:
      throw base::InputError({.value = "is a film, and a picture is needed here",
                              .fix = "name a picture of what it shows at rest; repose measure and "
                                     "repose track read films."});
    case Format::unknown:
      break;
  }
  throw base::InputError(
      {.value = "no picture: the content is none of JPEG, HEIC, PNG, TIFF, BMP, WebP",
       .fix = "name a picture, or save it as JPEG or PNG."});
}

std::string lower_case_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  for (char& letter : ending)
    letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending;
}

}  // namespace

Picture read_picture(const fs::path& file) {
  const std::string bytes = base::read_whole_file(file);
  try {
    if (bytes.empty()) {
      throw base::InputError(
          {.value = "is empty (0 bytes)", .fix = "copy it from the camera again."});
    }
    return decode({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } catch (const base::InputError& error) {
    throw error.in(file.string());
  }
}

void write_picture(const fs::path& file, const Picture& picture) {
  const std::string ending = lower_case_ending(file);
  const bool is_jpeg = ending == ".jpg" || ending == ".jpeg";
  if (!is_jpeg && ending != ".png") {
    base::refuse(file, fmt::format("cannot be written as \"{}\"", ending),
                 "let the name end in .png, .jpg or .jpeg.");
  }
  if (picture.empty()) {
    base::refuse(
        file,
        fmt::format("a picture of {} x {} pixels cannot be written", picture.width, picture.height),
        "give at least one pixel.");
  }
  std::vector<std::uint8_t> content =
      is_jpeg ? encode_jpeg(picture, kJpegQuality) : encode_png(picture);
  mark_as_made_here(content);
  base::write_whole_file(file, std::as_bytes(std::span(content)));
}

namespace {

void require_pixels(const Picture& picture) {
  if (!picture.empty()) return;
  throw base::InputError(
      {.value = "a picture without pixels cannot be written", .fix = "give one."});
}

}  // namespace

std::vector<std::uint8_t> jpeg_of(const Picture& picture, int quality) {
  require_pixels(picture);
  return encode_jpeg(picture, quality);
}

std::vector<std::uint8_t> png_of(const Picture& picture) {
  require_pixels(picture);
  std::vector<std::uint8_t> content = encode_png(picture);
  mark_as_made_here(content);
  return content;
}

Picture turned(Picture picture, int clockwise_deg) {
  if (picture.empty() || clockwise_deg == 0) return picture;
  const bool is_on_its_side = clockwise_deg != 180;
  Picture upright = is_on_its_side ? blank_picture(picture.height, picture.width)
                                   : blank_picture(picture.width, picture.height);
  cv::Mat target = mat_of(upright);
  turn(mat_of(std::as_const(picture)), clockwise_deg, target);
  return upright;
}

Picture reduced(const Picture& picture, int longest_side_px) {
  const int longest = std::max(picture.width, picture.height);
  if (longest <= longest_side_px) return picture;
  const double scale = static_cast<double>(longest_side_px) / longest;
  Picture smaller = blank_picture(std::max(1, cvRound(picture.width * scale)),
                                  std::max(1, cvRound(picture.height * scale)));
  cv::Mat target = mat_of(smaller);
  cv::resize(mat_of(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  return smaller;
}

}  // namespace repose::vision
