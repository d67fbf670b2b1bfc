#include "vision/compare/comparison_notes.h"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace repose::vision {
namespace {

using Measured = std::array<const ReposeAngle*, 2>;

const char* name_of_picture(int picture) { return picture == 0 ? "first" : "second"; }

void note(HeapComparison& result, std::string code, std::string message) {
  result.warnings.push_back({std::nullopt, {std::move(code), std::move(message)}});
}

void note_side(HeapComparison& result, const SideComparison& side, const char* name,
               const std::array<const Flank*, 2>& flanks) {
  if (side.cover == Cover::whole) return;
  std::string where;
  for (const int picture : {0, 1}) {
    const Flank& flank = *flanks[static_cast<std::size_t>(picture)];
    const bool is_missing =
        side.cover == Cover::none ? flank.status == FlankStatus::absent : flank.leaves_frame;
    if (!is_missing) continue;
    if (!where.empty()) where += " and the ";
    where += name_of_picture(picture);
  }
  if (side.cover == Cover::none) {
    note(result, "side_not_compared",
         fmt::format("There is no {} flank in the {} picture: that side is not compared.", name,
                     where));
  } else {
    note(result, "side_cut",
         fmt::format("The {} foot is out of the frame in the {} picture: that side is compared as "
                     "far as both show it.",
                     name, where));
  }
}

void note_scale(HeapComparison& result, const CompareOptions& options) {
  if (result.unit == LengthUnit::metre) return;
  if (options.scale[0]) {
    note(result, "base_not_seen",
         "The base is not fully visible in both pictures, so its known width gives no scale.");
  }
  note(result, "no_scale",
       fmt::format("Without a scale only shapes are compared, scaled to the same {}: it cannot be "
                   "told which heap is larger.",
                   result.unit == LengthUnit::height ? "height" : "area"));
}

void note_angles(HeapComparison& result, const Measured& measured, const CompareOptions& options) {
  if (measured[0]->window != measured[1]->window || measured[0]->method != measured[1]->method) {
    note(result, "unlike_definitions",
         "The two angles are measured by different methods or windows, which accounts for part of "
         "their difference.");
  }
  if (options.same_measurement) {
    note(result, "same_picture",
         "Both are the same picture, with the same errors, so their difference has none.");
  }
  if (!result.angle) return;
  const bool left = result.left.angle.has_value();
  const bool right = result.right.angle.has_value();
  if (!left && !right) {
    note(result, "unlike_sides",
         "No flank was measured in both pictures: the angles of opposite sides are compared, in "
         "which a camera's roll counts twice.");
  } else if (left != right) {
    note(result, "one_side",
         fmt::format("The angles are those of the {} sides only.", left ? "left" : "right"));
  }
  const auto differs = [](const SideComparison& side) {
    return side.angle && side.angle->verdict == Agreement::different;
  };
  if (result.angle->verdict == Agreement::equivalent &&
      (differs(result.left) || differs(result.right))) {
    note(result, "sides_differ",
         "The mean angles are equivalent, but a side's angle differs: one heap leans.");
  }
}

}  // namespace

void add_notes(HeapComparison& result, const Measured& measured, const CompareOptions& options) {
  for (const int picture : {0, 1}) {
    const ReposeAngle& heap = *measured[static_cast<std::size_t>(picture)];
    if (heap.status == MeasureStatus::refused) {
      result.warnings.push_back(
          {picture,
           {"angle_refused", "Its outline is compared, but its angle is refused: " + heap.reason}});
    }
    for (const Warning& warning : heap.warnings) result.warnings.push_back({picture, warning});
  }
  note_side(result, result.left, "left", {&measured[0]->left, &measured[1]->left});
  note_side(result, result.right, "right", {&measured[0]->right, &measured[1]->right});
  note_angles(result, measured, options);
  if (result.is_aligned_by_crest && result.iou) {
    note(result, "aligned_by_crest",
         "The outlines are aligned by their crests, which depend on single grains: see what the "
         "best shift changes.");
  }
  note_scale(result, options);
}

}  // namespace repose::vision
