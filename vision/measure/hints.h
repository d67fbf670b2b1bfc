#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// A heap's side, as seen in the picture.
enum class Side { left, right };

inline const char* name_of(Side side) { return side == Side::left ? "left" : "right"; }

/// Rotations that may be needed to set a heap upright [deg, clockwise].
inline constexpr std::array<int, 3> kTurns_deg{90, 180, 270};

/// What the user says about one picture. Positions in the picture's pixels.
struct Hints {
  /// One of kTurns_deg; 0: upright already. Code that reads a picture or video rotates it;
  /// everything else, including the positions here, refers to the rotated picture.
  int turn_deg = 0;
  /// Around the heap: everything outside is ignored, and the heap's height ends at the box.
  std::optional<Box> heap;
  /// The only side with a flank, if the heap's other side stands against a wall, a glass or the box
  /// that it was poured into. std::nullopt: both sides are examined.
  std::optional<Side> half;
  /// Two points on the line that the heap stands on.
  std::optional<Segment> ground;
  std::vector<Point> keep;  ///< places on the heap
  std::vector<Point> drop;  ///< places beside the heap
  /// Same size as the picture, and rotated with it: light is heap, dark is not, grey (a quarter to
  /// three quarters) is undecided. Empty: none.
  Picture mask = {};
  std::filesystem::path mask_file = {};  ///< file the mask was read from
  std::string source = {};  ///< file the hints were read from; empty if given otherwise

  bool empty() const;
  /// Summary of the hints: "box around the heap, ground line, 2 points on the heap".
  std::string text() const;
};

/// Hints that are invalid for a picture of this size, one entry each.
std::vector<base::Fault> problems_of(const Hints& hints, int width, int height);

/// The hints that lie inside a box, relative to its corner; the box hint itself is dropped.
Hints hints_within(const Hints& hints, const Box& box);

/// The part of a picture inside a box, which must lie inside the picture.
Picture part_of(const Picture& picture, const Box& box);

}  // namespace repose::vision
