#pragma once

#include <filesystem>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// A mask (Hints::mask) that a user paints over a picture.

namespace repose::vision {

/// A line drawn with a round brush.
struct BrushStroke {
  enum class Says {
    heap,     ///< what it covers belongs to the heap
    no_heap,  ///< it does not
    nothing,  ///< erases what was painted there before
  };
  Says says = Says::heap;
  double width_px = 1;
  std::vector<Point> path;
};

/// The mask with the strokes drawn in order; an empty mask starts with every pixel undecided.
/// @throws base::InputError  the mask is of another size.
Picture painted(Picture mask, int width, int height, const std::vector<BrushStroke>& strokes);

/// A picture's painted mask: the picture's name + ".repose.mask", a PNG. Its ending is not that of
/// a picture, so that it does not count as a heap of the folder.
std::filesystem::path mask_file_of(const std::filesystem::path& picture);

/// Writes the turned picture's mask there, turned back to the file's orientation, and sets its name
/// in the hints.
/// @throws base::InputError  the file cannot be written.
void save_mask(Hints& hints, const std::filesystem::path& picture);

}  // namespace repose::vision
