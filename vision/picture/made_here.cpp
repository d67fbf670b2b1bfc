#include "vision/picture/made_here.h"

#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include <boost/crc.hpp>

namespace repose::vision {
namespace {

using namespace std::string_view_literals;

/// A PNG text chunk (chapter 11.3.4 of its standard): keyword, zero, text.
constexpr std::string_view kPngText = "tEXtSoftware\0repose"sv;
constexpr std::string_view kJpegComment = "Software: repose";

std::string big_endian(std::uint32_t number, int bytes) {
  std::string text;
  for (int k = bytes - 1; k >= 0; --k) text += static_cast<char>(number >> (8 * k) & 0xFFU);
  return text;
}

/// Length of the data, type and data, checksum of both.
std::string png_chunk() {
  constexpr std::size_t kType = 4;
  boost::crc_32_type sum;
  sum.process_bytes(kPngText.data(), kPngText.size());
  return big_endian(static_cast<std::uint32_t>(kPngText.size() - kType), 4) +
         std::string(kPngText) + big_endian(sum.checksum(), 4);
}

/// A comment segment; its length includes the length field.
std::string jpeg_segment() {
  return "\xFF\xFE" + big_endian(static_cast<std::uint32_t>(kJpegComment.size() + 2), 2) +
         std::string(kJpegComment);
}

}  // namespace

void mark_as_made_here(std::vector<std::uint8_t>& content) {
  constexpr std::size_t kPngHeader = 33, kJpegStart = 2;
  const bool is_png = content.size() > kPngHeader && content.front() == 0x89;
  const std::string mark = is_png ? png_chunk() : jpeg_segment();
  const auto place =
      content.begin() + static_cast<std::ptrdiff_t>(is_png ? kPngHeader : kJpegStart);
  content.insert(place, mark.begin(), mark.end());
}

bool is_made_here(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return true;
  std::array<char, 128> begin{};
  std::ifstream in(file, std::ios::binary);
  in.read(begin.data(), begin.size());
  const std::string_view text(begin.data(), static_cast<std::size_t>(in.gcount()));
  return text.empty() || text.find(kPngText) != text.npos || text.find(kJpegComment) != text.npos;
}

}  // namespace repose::vision
