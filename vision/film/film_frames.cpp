#include "vision/film/film_frames.h"

#include "vision/film/film_reader.h"
#include "vision/picture/opencv.h"
#include "vision/picture/picture.h"

namespace repose::vision {
namespace {

template <typename Item>
void keep_every_second(std::vector<Item>& items) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < items.size(); k += 2) items[kept++] = std::move(items[k]);
  items.resize(kept);
}

}  // namespace

FilmFrames film_frames(const FilmFile& file, const FilmFramesOptions& options) {
  constexpr int kQuality = 80;
  FilmFrames frames;
  FilmReader reader(file);
  FilmFrame frame;
  std::size_t step = 1;
  // Frames that are not kept are skipped, which is faster than converting them.
  for (std::size_t number = 0; number % step == 0 ? reader.next(frame) : reader.skip(frame);
       ++number) {
    if (number % step != 0) continue;
    frames.width = frame.bgr.cols;
    frames.height = frame.bgr.rows;
    frames.times_s.push_back(frame.time_s);
    Picture picture = blank_picture(frame.bgr.cols, frame.bgr.rows);
    cv::Mat pixels = mat_of(picture);
    frame.bgr.copyTo(pixels);
    frames.jpegs.push_back(jpeg_of(reduced(picture, options.side_px), kQuality));
    if (frames.jpegs.size() <= options.max_frames) continue;
    keep_every_second(frames.times_s);
    keep_every_second(frames.jpegs);
    step *= 2;
  }
  return frames;
}

}  // namespace repose::vision
