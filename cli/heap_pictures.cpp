#include "cli/heap_pictures.h"

#include <algorithm>

#include "cli/degrees.h"

namespace repose::cli {

int count(const HeapPictures& pictures, vision::MeasureStatus status) {
  return static_cast<int>(
      std::count_if(pictures.views.begin(), pictures.views.end(),
                    [&](const HeapView& view) { return view.status == status; }));
}

std::optional<vision::Repeats> angle_deg(const HeapPictures& pictures) {
  std::vector<double> angles;
  for (const HeapView& view : pictures.views) {
    if (view.angle_rad) angles.push_back(to_degrees(*view.angle_rad));
  }
  if (angles.empty()) return std::nullopt;
  return vision::summarise(angles);
}

}  // namespace repose::cli
