#include "tests/support/heap_camera.h"

#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/picture/jpeg.h"
#include "vision/picture/opencv.h"

namespace repose::testing {
namespace {

void light_unevenly(cv::Mat light, const Camera& camera) {
  const double half = std::hypot(light.cols, light.rows) / 2;
  const double right = std::cos(camera.gradient_rad) * camera.gradient / half;
  const double down = std::sin(camera.gradient_rad) * camera.gradient / half;
  for (int row = 0; row < light.rows; ++row) {
    const double y = row + 0.5 - light.rows / 2.0;
    for (int column = 0; column < light.cols; ++column) {
      const double x = column + 0.5 - light.cols / 2.0;
      const double corner = (x * x + y * y) / (half * half);
      const double factor = (1 + right * x + down * y) * (1 - camera.vignette * corner);
      light.at<cv::Vec3f>(row, column) *= static_cast<float>(std::max(0.02, factor));
    }
  }
}

cv::Mat rolled(const cv::Mat& light, const HeapScene& scene, double margin_px) {
  const double cosine = std::cos(scene.camera.tilt_rad);
  const double sine = std::sin(scene.camera.tilt_rad);
  // The origin of warpAffine is the first pixel's centre, that of in_picture its corner.
  const vision::Point at = in_picture(scene, margin_px, {0.5, 0.5});
  const cv::Matx23d turn(cosine, -sine, at.x - 0.5, sine, cosine, at.y - 0.5);
  cv::Mat picture;
  cv::warpAffine(light, picture, turn, {scene.width, scene.height}, cv::INTER_CUBIC,
                 cv::BORDER_REPLICATE);
  return picture;
}

/// Shot noise grows with the square root of the light; read noise is constant.
void add_noise(cv::Mat& light, double noise, Random& random) {
  cv::RNG rng(random.seed());
  cv::Mat grains(light.size(), CV_32FC3);
  rng.fill(grains, cv::RNG::NORMAL, 0, noise);
  for (int row = 0; row < light.rows; ++row) {
    for (int column = 0; column < light.cols; ++column) {
      auto& pixel = light.at<cv::Vec3f>(row, column);
      const auto& grain = grains.at<cv::Vec3f>(row, column);
      for (int c = 0; c < 3; ++c) pixel[c] += grain[c] * std::sqrt(0.02F + std::abs(pixel[c]));
    }
  }
}

cv::Mat developed(const cv::Mat& light) {
  cv::Mat clipped = cv::min(cv::max(light, 0), 1);
  cv::pow(clipped, 1 / 2.2, clipped);
  cv::Mat bytes;
  clipped.convertTo(bytes, CV_8UC3, 255);
  return bytes;
}

vision::Picture picture_of(const cv::Mat& bytes) {
  vision::Picture picture{.width = bytes.cols, .height = bytes.rows, .bgr = {}};
  picture.bgr.assign(bytes.datastart, bytes.dataend);
  return picture;
}

}  // namespace

vision::Point in_picture(const HeapScene& scene, double margin_px, vision::Point stage_point) {
  const double cosine = std::cos(scene.camera.tilt_rad);
  const double sine = std::sin(scene.camera.tilt_rad);
  const double x = stage_point.x - margin_px - scene.width / 2.0;
  const double y = stage_point.y - margin_px - scene.height / 2.0;
  return {scene.width / 2.0 + x * cosine - y * sine, scene.height / 2.0 + x * sine + y * cosine};
}

vision::Picture take_picture(const Stage& stage, const HeapScene& scene, Random& random) {
  cv::Mat light = rolled(stage.light, scene, stage.margin_px);
  if (scene.style == Style::silhouette) return picture_of(developed(light));
  const Camera& camera = scene.camera;
  light_unevenly(light, camera);
  cv::GaussianBlur(light, light, {}, camera.blur_px, camera.blur_px);
  light *= camera.exposure;
  add_noise(light, camera.noise, random);
  vision::Picture picture = picture_of(developed(light));
  return camera.jpeg_quality > 0 ? jpeg_compressed(picture, camera.jpeg_quality) : picture;
}

vision::Picture jpeg_compressed(const vision::Picture& picture, int quality) {
  return vision::decode_jpeg(vision::jpeg_of(picture, quality));
}

}  // namespace repose::testing
