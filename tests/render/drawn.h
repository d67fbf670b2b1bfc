#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "render/renderer.h"
#include "tests/support/error_of.h"

namespace repose::render {

/// One renderer for all tests of a program: creating one takes a while.
inline Renderer& renderer() {
  static Renderer shared;
  return shared;
}

/// The pixels of a mask: their number and centroid.
struct Blob {
  double pixels = 0;
  double x = 0;
  double y = 0;
};

inline Blob blob_of(const Rendered& rendered) {
  Blob blob;
  const int width = rendered.picture.width;
  std::size_t at = 0;
  for (int y = 0; y < rendered.picture.height; ++y) {
    for (int x = 0; x < width; ++x, ++at) {
      if (rendered.grain_mask[at] == 0) continue;
      blob.pixels += 1;
      blob.x += x + .5;
      blob.y += y + .5;
    }
  }
  blob.x /= blob.pixels;
  blob.y /= blob.pixels;
  return blob;
}

}  // namespace repose::render
