#pragma once

#include <optional>
#include <vector>

#include "tests/support/edge_angle.h"
#include "tests/support/flank_law.h"
#include "tests/support/heap_scene.h"
#include "vision/picture/picture.h"

namespace repose::testing {

/// Ideal outline of a heap on its stage: the drawing board, which is larger than the picture by a
/// margin on all sides so that it can be turned. x is to the right, y up from the ground, in px.
class HeapProfile {
 public:
  HeapProfile(const HeapForm& form, double picture_width_px, double margin_px);

  /// The curve from left to right, points at most half a pixel apart.
  const std::vector<vision::Point>& curve() const { return curve_; }
  double height_at(double x) const;

  double height_px() const { return height_px_; }
  double grain_px() const { return grain_px_; }
  double apex_x() const { return apex_x_; }
  double left_toe_x() const { return left_toe_x_; }    ///< where the flank meets the ground
  double right_toe_x() const { return right_toe_x_; }  ///< likewise

  /// A flank's angle by its definition; std::nullopt if the shape has no such flank.
  std::optional<EdgeAngle> angle(Side side) const;

  /// The straight part of a flank, toe first; for a hollow one, from 20 to 80 % of the height.
  std::optional<vision::Segment> flank(Side side) const;

 private:
  void lay_heap(const HeapForm& form);
  void lay_hollow(const HeapForm& form);
  void lean_on_wall(const HeapForm& form);
  void lay_column();
  void lay_layer(double stage_width_px);
  void add_toe(const HeapForm& form, Side side);
  void add_flank(const FlankLaw& law, Side side, double highest);
  void add_line(vision::Point to);
  void add_bend(vision::Point control, vision::Point to);
  void index_heights();
  bool has_flank(Side side) const { return side == Side::left ? has_left_ : has_right_; }
  double crest_x() const;
  vision::Segment window_of_hollow(Side side) const;

  std::vector<vision::Point> curve_;
  std::vector<double> heights_;  ///< at x = first_x_ + i/2
  double first_x_ = 0;
  double height_px_ = 0;
  double grain_px_ = 0;
  double apex_x_ = 0;
  double apex_height_ = 0;  ///< of the uncut cone
  double left_toe_x_ = 0;
  double right_toe_x_ = 0;
  double runout_px_ = 0;
  double straight_from_ = 0.15;
  bool is_hollow_ = false;
  bool has_left_ = true;
  bool has_right_ = true;
};

}  // namespace repose::testing
