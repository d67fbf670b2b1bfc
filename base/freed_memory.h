#pragma once

namespace repose::base {

/// Memory that is freed from now on stays with the process, where the C library can be told so.
/// Pictures need buffers of a megabyte for a moment: to give each of them back to the system, and
/// to have it cleared anew, takes a quarter of the time of measuring a silhouette.
void disable_heap_trimming();

}  // namespace repose::base
