#include "vision/picture/upright.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include <libexif/exif-data.h>
#include <opencv2/core.hpp>

#include "vision/picture/mat_of_picture.h"

namespace repose::vision {

int jpeg_orientation(std::span<const std::uint8_t> jpeg) {
  const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(
      exif_data_new_from_data(jpeg.data(), static_cast<unsigned>(jpeg.size())), &exif_data_unref);
  if (!data) return kUprightOrientation;
  const ExifEntry* entry = exif_content_get_entry(data->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->components != 1) {
    return kUprightOrientation;
  }
  const int orientation = exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
  return orientation >= 1 && orientation <= 8 ? orientation : kUprightOrientation;
}

int exif_block_orientation(std::span<const std::uint8_t> block) {
  std::vector<std::uint8_t> with_head = {'E', 'x', 'i', 'f', 0, 0};
  // Some programs write the head into a PNG or WebP all the same.
  if (std::equal(with_head.begin(), with_head.end(), block.begin(),
                 block.begin() + std::min<std::ptrdiff_t>(6, std::ssize(block)))) {
    with_head.clear();
  }
  with_head.insert(with_head.end(), block.begin(), block.end());
  return jpeg_orientation(with_head);
}

Picture turned_upright(Picture picture, int orientation) {
  if (orientation <= kUprightOrientation || orientation > 8) return picture;
  const bool lies_on_its_side = orientation >= 5;
  Picture turned = lies_on_its_side ? blank_picture(picture.height, picture.width)
                                    : blank_picture(picture.width, picture.height);
  const cv::Mat stored = mat_of(picture);
  cv::Mat seen = mat_of(turned);
  constexpr int kUpDown = 0, kLeftRight = 1, kBoth = -1;
  switch (orientation) {
    case 2:
      cv::flip(stored, seen, kLeftRight);
      break;
    case 3:
      cv::flip(stored, seen, kBoth);
      break;
    case 4:
      cv::flip(stored, seen, kUpDown);
      break;
    case 5:
      cv::transpose(stored, seen);
      break;
    case 6:
      cv::rotate(stored, seen, cv::ROTATE_90_CLOCKWISE);
      break;
    case 7:
      cv::transpose(stored, seen);
      cv::flip(seen, seen, kBoth);
      break;
    default:
      cv::rotate(stored, seen, cv::ROTATE_90_COUNTERCLOCKWISE);
      break;
  }
  return turned;
}

}  // namespace repose::vision
