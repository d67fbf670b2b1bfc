#pragma once

#include <string_view>

namespace repose::vision {

/// Whether a file begins like a film: MP4, MOV, AVI, MKV, WebM or GIF. Also true for HEIC pictures,
/// which use MP4's container.
inline bool is_film(std::string_view head) {
  using namespace std::string_view_literals;
  if (head.size() < 12) return false;
  for (const std::string_view box : {"ftyp"sv, "moov"sv, "mdat"sv, "wide"sv, "free"sv, "skip"sv}) {
    if (head.substr(4, 4) == box) return true;
  }
  const bool is_avi = head.starts_with("RIFF") && head.substr(8, 3) == "AVI";
  return is_avi || head.starts_with("\x1a\x45\xdf\xa3"sv) || head.starts_with("GIF8");
}

}  // namespace repose::vision
