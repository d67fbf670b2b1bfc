#pragma once

#include <opencv2/core/mat.hpp>

#include "tests/support/heap_paint.h"
#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"
#include "vision/picture/picture.h"

namespace repose::testing {

/// Where a point of the stage (px from its top left corner) lies in the picture.
vision::Point in_picture(const HeapScene& scene, double margin_px, vision::Point stage_point);

/// Takes the picture: uneven light, defocus, roll, exposure, sensor noise, compression.
vision::Picture take_picture(const Stage& stage, const HeapScene& scene, Random& random);

/// The picture as decoded from a JPEG file of that quality, 1 to 100.
vision::Picture jpeg_compressed(const vision::Picture& picture, int quality);

}  // namespace repose::testing
