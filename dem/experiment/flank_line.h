#pragma once

#include <optional>
#include <vector>

namespace repose::dem {

/// One side of a heap's silhouette, from the crest outwards, a column apart. Heights in m.
struct Flank {
  std::vector<double> height;
  std::vector<double> smooth;  ///< the same, averaged over some columns
  double column_m = 0;         ///< how wide a column is
  double crest_m = 0;          ///< height of the heap's crest
};

struct FlankLine {
  double at_crest = 0;  ///< m, where the line passes the crest's column
  double fall = 0;      ///< m per column, above 0
};

/// The line through a flank between two heights, `low` and `high`.
///
/// The ends are put where the fitted line, not the bumpy edge, has those heights; an apron, the
/// thin layer that runs out from the foot, is left out: it begins where the slope over two grains
/// has sunk under a third of the upper half's, or where less than two grains of height are left and
/// the foot is still twice as far as that slope would take. It is left out where five grains of
/// flank or more remain above it. A silhouette does not show its grains:
/// for one counts the mean distance between the edge's upward crossings of the line, at most a
/// fifth of the crest's height. Least squares, then Tukey's biweight (Huber & Ronchetti 2009,
/// Robust Statistics, sec. 4.8). It is what silhouettes are measured with.
/// None where there are too few columns, or where the line does not fall.
std::optional<FlankLine> fit_flank_line(const Flank& flank, double low, double high);

}  // namespace repose::dem
