#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "vision/picture/picture.h"

namespace repose::vision {

/// Of a heap, as the picture shows it.
enum class Side { left, right };

inline const char* name_of(Side side) { return side == Side::left ? "left" : "right"; }

/// How a picture may have to be turned until its heap stands upright [deg, clockwise].
inline constexpr std::array<int, 3> kTurns_deg{90, 180, 270};

/// What a person says of one picture. Positions in the picture's pixels.
struct Hints {
  /// Of kTurns_deg; 0: upright as it is. What reads a picture or a film turns it; all else, as its
  /// positions here, is of the turned one.
  int turn_deg = 0;
  /// Around the heap: nothing outside counts, and the heap's height ends where the box does.
  std::optional<Box> heap;
  /// The one side with a flank, of a heap whose other side stands against a wall, a glass or the
  /// box that it was poured into. None: both sides are looked at.
  std::optional<Side> half;
  /// Two points of the line that the heap stands on.
  std::optional<Segment> ground;
  std::vector<Point> keep;  ///< places on the heap
  std::vector<Point> drop;  ///< places beside the heap
  /// As large as the picture, and turned with it: light is on the heap, dark is not, grey (a
  /// quarter to three quarters) leaves it open. Empty: none.
  Picture mask = {};
  std::filesystem::path mask_file = {};  ///< that the mask was read from
  std::string source = {};  ///< the file that they were read from; empty when given otherwise

  bool empty() const;
  /// "box around the heap, ground line, 2 places on the heap": what a person has said.
  std::string text() const;
};

/// What cannot be meant in a picture of this size, a line each.
std::vector<base::Fault> problems_of(const Hints& hints, int width, int height);

/// The hints inside a box, from the box's own corner; the box itself has been followed.
Hints hints_within(const Hints& hints, const Box& box);

/// The part of a picture that a box inside it shows.
Picture part_of(const Picture& picture, const Box& box);

}  // namespace repose::vision
