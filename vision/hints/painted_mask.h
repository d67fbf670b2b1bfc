#pragma once

#include <filesystem>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// A mask (Hints::mask) that a person paints over a picture.

namespace repose::vision {

/// A line drawn with a round brush.
struct BrushStroke {
  enum class Says {
    heap,     ///< what lies under it belongs to the heap
    no_heap,  ///< it does not
    nothing,  ///< what was painted there before is taken back
  };
  Says says = Says::heap;
  double width_px = 1;
  std::vector<Point> path;
};

/// The mask with the strokes on it, one over the other; an empty one begins with nothing said.
/// @throws base::InputError  the mask is of another size.
Picture painted(Picture mask, int width, int height, const std::vector<BrushStroke>& strokes);

/// Where a picture's painted mask is kept: its name with ".repose.mask" behind, which is a PNG. The
/// name has no picture's ending: it is no heap of its folder.
std::filesystem::path mask_file_of(const std::filesystem::path& picture);

/// Writes the mask of the turned picture there, in the picture's own position, and puts its name
/// into the hints.
/// @throws base::InputError  when the file cannot be written.
void save_mask(Hints& hints, const std::filesystem::path& picture);

}  // namespace repose::vision
