#pragma once

#include <filesystem>

#include "vision/film/film_file.h"
#include "vision/picture/picture.h"
#include "vision/track/grain_path.h"

namespace repose::vision {

/// The scene with the grain in it at successive places of its path, about its width apart or more.
Picture strobe_picture(const FilmFile& file, const cv::Mat& scene, const GrainPath& path);

}  // namespace repose::vision
