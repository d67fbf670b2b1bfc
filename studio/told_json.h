#pragma once

#include <string>
#include <vector>

#include "calibrate/measured/measured_file.h"
#include "studio/json_answer.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/painted_mask.h"

/// What page and program exchange about a picture, besides `repose measure --json`.
namespace repose::studio {

/// The user's hints for a picture: `rotate_deg`, `heap` [x, y, width, height], `half`, `ground`
/// [x1, y1, x2, y2], `keep`, `drop` [[x, y], ...], `exclude` [[x, y, width, height], ...], `scale`
/// {`line`, `length_mm`}, `board`, `pitch_deg`, `window` [from, to], `definition`, `has_mask`,
/// `painted` [{`says` heap, no_heap or nothing, `width`, `path` [[x, y], ...]}, ...]. What was not
/// given is null or an empty list; painted strokes are in the mask once saved.
Json told_json(const vision::PictureSettings& told);

/// The settings with everything that the page can set replaced; a mask and a lens stay. Painted
/// strokes are not yet in the mask: see painted_in().
/// @throws base::InputError  an unknown key or an invalid value; lists all.
vision::PictureSettings with_told(vision::PictureSettings settings, const Json& told);

/// The painted strokes in `told`, which with_told() accepts.
/// @throws base::InputError  an invalid stroke; lists all.
std::vector<vision::BrushStroke> painted_in(const Json& told);

/// Marks drawn over a picture, in its pixels: `width`, `height`, `outline`, `ground`, and for each
/// side `line` and `apron_line`.
Json marks_json(const calibrate::MeasuredAgain& again);

}  // namespace repose::studio
