#include <opencv2/core/utility.hpp>

// Linked into what runs under the thread sanitizer. OpenCV is compiled without it, and what its own
// threads do would be reported as races with what follows them.

namespace {

[[maybe_unused]] const bool is_set = [] {
  cv::setNumThreads(1);
  return true;
}();

}  // namespace
