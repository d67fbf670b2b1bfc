#pragma once

namespace repose::base {

/// From now on the process keeps freed memory, if the C library supports that. Pictures need
/// short-lived buffers of about a megabyte: returning each to the system, and having it zeroed
/// again, takes a quarter of the time of measuring a silhouette.
void disable_heap_trimming();

}  // namespace repose::base
