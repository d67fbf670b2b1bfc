#include "vision/track/strobe.h"

#include <cmath>
#include <map>

#include "vision/film/film_reader.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

/// What to show, by the numbers of its frames.
std::map<int, Blob> shown_blobs(const GrainPath& path) {
  std::map<int, Blob> shown;
  cv::Point2d last;
  for (const Sighting& sighting : path) {
    const cv::Point2d off = sighting.blob.centre - last;
    const double width = 2 * std::sqrt(sighting.blob.area_px / CV_PI);
    if (!shown.empty() && std::hypot(off.x, off.y) < .9 * width) continue;
    shown[sighting.frame] = sighting.blob;
    last = sighting.blob.centre;
  }
  return shown;
}

/// The part of a frame that the grain covers.
void show(const cv::Mat& frame, const cv::Mat& scene, const Blob& blob, cv::Mat& strobe) {
  for (int row = blob.box.y; row < blob.box.y + blob.box.height; ++row) {
    for (int k = blob.box.x; k < blob.box.x + blob.box.width; ++k) {
      const auto& seen = frame.at<cv::Vec3b>(row, k);
      const double cover = cover_of(seen, scene.at<cv::Vec3b>(row, k), blob.colour);
      auto& drawn = strobe.at<cv::Vec3b>(row, k);
      drawn = cv::Vec3b(cover * cv::Vec3d(seen) + (1 - cover) * cv::Vec3d(drawn));
    }
  }
}

}  // namespace

Picture strobe_picture(const FilmFile& file, const cv::Mat& scene, const GrainPath& path) {
  Picture picture = blank_picture(scene.cols, scene.rows);
  cv::Mat strobe = mat_of(picture);
  scene.copyTo(strobe);
  const std::map<int, Blob> blobs = shown_blobs(path);
  FilmReader film(file);
  FilmFrame frame;
  const int last = blobs.empty() ? -1 : blobs.rbegin()->first;
  for (int number = 0; number <= last; ++number) {
    const auto blob = blobs.find(number);
    if (!(blob == blobs.end() ? film.skip(frame) : film.next(frame))) break;
    if (blob != blobs.end()) show(frame.bgr, scene, blob->second, strobe);
  }
  return picture;
}

}  // namespace repose::vision
