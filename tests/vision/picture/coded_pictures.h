#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>  // before jpeglib.h
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <jpeglib.h>
#include <opencv2/imgcodecs.hpp>

/// Contents of picture files, both ordinary and unusual.
namespace repose::testing {

using Bytes = std::vector<std::uint8_t>;

inline Bytes coded(const std::string& ending, const cv::Mat& samples) {
  Bytes bytes;
  cv::imencode(ending, samples, bytes);
  return bytes;
}

inline Bytes first_part(const Bytes& bytes, double part) {
  const auto size = static_cast<std::ptrdiff_t>(part * static_cast<double>(bytes.size()));
  return {bytes.begin(), bytes.begin() + size};
}

template <typename Range>
void append(Bytes& bytes, const Range& more) {
  for (const auto byte : more) bytes.push_back(static_cast<std::uint8_t>(byte));
}

inline void append_big_endian(Bytes& bytes, std::uint32_t number) {
  for (const int shift : {24, 16, 8, 0})
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// A CMYK JPEG of one colour; 255 is full ink. Adobe's programs store inks inverted and mark it.
inline Bytes cmyk_jpeg(int width, int height, const std::vector<std::uint8_t>& inks,
                       bool is_adobe) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &memory, &size);
  jpeg.image_width = static_cast<JDIMENSION>(width);
  jpeg.image_height = static_cast<JDIMENSION>(height);
  jpeg.input_components = 4;
  jpeg.in_color_space = JCS_CMYK;
  jpeg_set_defaults(&jpeg);
  jpeg.write_Adobe_marker = static_cast<boolean>(is_adobe);
  jpeg_start_compress(&jpeg, TRUE);
  Bytes row;
  for (int x = 0; x < width; ++x) {
    for (const std::uint8_t ink : inks) {
      row.push_back(is_adobe ? static_cast<std::uint8_t>(255 - ink) : ink);
    }
  }
  for (int y = 0; y < height; ++y) {
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  Bytes bytes(memory, memory + size);
  std::free(memory);
  return bytes;
}

/// The smallest EXIF block: an orientation and nothing else.
inline Bytes exif_block(int orientation) {
  const auto value = static_cast<std::uint8_t>(orientation);
  return {'I',  'I',  '*', 0, 8, 0, 0, 0,                  // little-endian, directory at 8
          1,    0,                                         // one entry:
          0x12, 0x01, 3,   0, 1, 0, 0, 0, value, 0, 0, 0,  // orientation, one short number
          0,    0,    0,   0};                             // no further directory
}

inline Bytes with_exif(const Bytes& jpeg, int orientation) {
  const Bytes block = exif_block(orientation);
  const auto length = static_cast<std::uint8_t>(2 + 6 + block.size());
  Bytes result;
  append(result, std::array{0xFF, 0xD8, 0xFF, 0xE1, 0, int{length}, int{'E'}, int{'x'}, int{'i'},
                            int{'f'}, 0, 0});
  append(result, block);
  append(result, std::span(jpeg).subspan(2));
  return result;
}

/// A PNG chunk with its checksum (CRC-32 as in the PNG standard, annex D).
inline Bytes png_chunk(const std::string& name, const Bytes& content) {
  Bytes chunk;
  append_big_endian(chunk, static_cast<std::uint32_t>(content.size()));
  append(chunk, name);
  append(chunk, content);
  std::uint32_t sum = 0xFFFFFFFF;
  for (std::size_t i = 4; i < chunk.size(); ++i) {
    sum ^= chunk[i];
    for (int bit = 0; bit < 8; ++bit) sum = (sum & 1U) ? sum >> 1 ^ 0xEDB88320 : sum >> 1;
  }
  append_big_endian(chunk, ~sum);
  return chunk;
}

constexpr std::size_t kPngHeaderFrom = 8;
constexpr std::size_t kPngHeaderTo = 33;

inline Bytes with_exif_in_png(const Bytes& png, int orientation) {
  const Bytes chunk = png_chunk("eXIf", exif_block(orientation));
  Bytes result;
  append(result, std::span(png).first(kPngHeaderTo));
  append(result, chunk);
  append(result, std::span(png).subspan(kPngHeaderTo));
  return result;
}

inline Bytes png_that_claims(std::uint32_t width, std::uint32_t height) {
  Bytes header;
  append_big_endian(header, width);
  append_big_endian(header, height);
  append(header, std::array{8, 2, 0, 0, 0});  // 8 bits, colour, the usual coding
  const Bytes chunk = png_chunk("IHDR", header);
  Bytes result = coded(".png", cv::Mat(8, 8, CV_8UC3, cv::Scalar(1, 2, 3)));
  std::copy(chunk.begin(), chunk.end(), result.begin() + kPngHeaderFrom);
  return result;
}

inline Bytes jpeg_that_claims(std::uint16_t width, std::uint16_t height) {
  Bytes result = coded(".jpg", cv::Mat(8, 8, CV_8UC3, cv::Scalar(1, 2, 3)));
  for (std::size_t at = 0; at + 8 < result.size(); ++at) {
    if (result[at] != 0xFF || result[at + 1] != 0xC0) continue;  // the frame's header
    result[at + 5] = static_cast<std::uint8_t>(height >> 8);
    result[at + 6] = static_cast<std::uint8_t>(height & 0xFF);
    result[at + 7] = static_cast<std::uint8_t>(width >> 8);
    result[at + 8] = static_cast<std::uint8_t>(width & 0xFF);
    break;
  }
  return result;
}

inline Bytes bmp_that_claims(std::int32_t width, std::int32_t height) {
  Bytes result = coded(".bmp", cv::Mat(8, 8, CV_8UC3, cv::Scalar(1, 2, 3)));
  for (std::size_t byte = 0; byte < 4; ++byte) {
    result[18 + byte] = static_cast<std::uint8_t>(width >> (8 * byte));
    result[22 + byte] = static_cast<std::uint8_t>(height >> (8 * byte));
  }
  return result;
}

}  // namespace repose::testing
