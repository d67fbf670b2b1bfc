#include <opencv2/core/utility.hpp>

// Linked into programs that run under the thread sanitizer. OpenCV is compiled without it, so its
// own threads would be reported as racing with the code that follows them.

namespace {

[[maybe_unused]] const bool is_set = [] {
  cv::setNumThreads(1);
  return true;
}();

}  // namespace
