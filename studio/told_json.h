#pragma once

#include <string>
#include <vector>

#include "calibrate/measured/measured_file.h"
#include "studio/json_answer.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/painted_mask.h"

/// What the page and the program say to each other about a picture, beside what `repose measure
/// --json` says.
namespace repose::studio {

/// What a person has said of a picture: `rotate_deg`, `heap` [x, y, width, height], `half`,
/// `ground` [x1, y1, x2, y2], `keep`, `drop` [[x, y], ...], `exclude` [[x, y, width, height], ...],
/// `scale`
/// {`line`, `length_mm`}, `board`, `pitch_deg`, `window` [from, to], `definition`, `has_mask`,
/// `painted` [{`says` heap, no_heap or nothing, `width`, `path` [[x, y], ...]}, ...]. What was not
/// said is null or an empty list; what was painted is in the mask once it is saved.
Json told_json(const vision::PictureSettings& told);

/// The settings with all that the page can say as it says it; a mask and a lens stay. What is
/// painted is not in the mask yet: painted_in().
/// @throws base::InputError  a key that does not exist, or a value that cannot be meant, each.
vision::PictureSettings with_told(vision::PictureSettings settings, const Json& told);

/// What is painted, of what with_told() has taken.
/// @throws base::InputError  a stroke that cannot be meant, each.
std::vector<vision::BrushStroke> painted_in(const Json& told);

/// What is drawn over a picture, in its pixels: `width`, `height`, `outline`, `ground`, and of each
/// side `line` and `apron_line`.
Json marks_json(const calibrate::MeasuredAgain& again);

}  // namespace repose::studio
