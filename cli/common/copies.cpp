#include "cli/common/copies.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "base/fingerprint.h"
#include "vision/film/film_angle.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

bool have_same_bytes(const fs::path& a, const fs::path& b) {
  constexpr std::size_t kBlock = 1 << 16;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  std::vector<char> one(kBlock), other(kBlock);
  while (first && second) {
    first.read(one.data(), kBlock);
    second.read(other.data(), kBlock);
    if (first.gcount() != second.gcount() ||
        !std::equal(one.begin(), one.begin() + first.gcount(), other.begin())) {
      return false;
    }
  }
  return first.eof() && second.eof();
}

/// None where it is no file with bytes in it.
std::optional<std::uintmax_t> size_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const std::uintmax_t size = fs::file_size(file, error);
  return error || size == 0 ? std::nullopt : std::optional(size);
}

}  // namespace

std::string pixels_of(const vision::Picture& picture) {
  return base::fingerprint({fmt::format("{} {}", picture.width, picture.height),
                            std::string(picture.bgr.begin(), picture.bgr.end())});
}

std::vector<std::optional<std::size_t>> copies_among(const std::vector<fs::path>& files,
                                                     const std::vector<std::string>& pixels) {
  std::vector<std::optional<std::size_t>> first_of(files.size());
  std::vector<std::optional<std::uintmax_t>> sizes;
  sizes.reserve(files.size());
  for (const fs::path& file : files) sizes.push_back(size_of(file));
  for (std::size_t i = 1; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i && !first_of[i]; ++k) {
      if (first_of[k]) continue;
      const bool same_pixels = !pixels[i].empty() && pixels[i] == pixels[k];
      const bool same_size = sizes[i] && sizes[i] == sizes[k];
      if (same_pixels || (same_size && have_same_bytes(files[i], files[k]))) first_of[i] = k;
    }
  }
  return first_of;
}

std::string text_of_copy(const fs::path& copy, const fs::path& first) {
  return fmt::format("{}: the same {} as {}, counted once", copy.string(),
                     vision::has_film_ending(copy) ? "film" : "picture", first.string());
}

}  // namespace repose::cli
