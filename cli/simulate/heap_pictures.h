#pragma once

#include <string>
#include <vector>

#include "calibrate/study/heap_views.h"

namespace repose::cli {

/// What pictures of a simulated heap from all around tell.
struct HeapPictures {
  std::vector<calibrate::HeapView> views;
  std::string overlay_file;  ///< the first view with what was measured; empty: none was asked for
  std::string error;         ///< why there are no views
};

}  // namespace repose::cli
