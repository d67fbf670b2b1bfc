#include "vision/drawing/heap_comparison_overlay.h"

#include "base/input_error.h"
#include "vision/drawing/comparison_chart.h"
#include "vision/drawing/comparison_legend.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {

Picture draw_comparison(const Picture& first, const ReposeAngle& first_measured,
                        const HeapComparison& comparison, const ComparisonOverlayNotes& notes) {
  if (first.empty()) {
    throw base::InputError({.where = "overlay",
                            .value = "the picture has no pixels",
                            .fix = "give the first picture that was compared."});
  }
  if (comparison.status == MeasureStatus::refused) {
    throw base::InputError(
        {.where = "overlay", .value = "the comparison was refused", .fix = comparison.reason});
  }
  const Lettering lettering;
  const cv::Mat chart = draw_chart(first, first_measured, comparison, lettering);
  const cv::Mat legend = draw_legend(chart.cols, comparison, notes, lettering);
  Picture overlay = blank_picture(chart.cols, chart.rows + legend.rows);
  cv::Mat whole = mat_of(overlay);
  chart.copyTo(whole(cv::Rect({0, 0}, chart.size())));
  legend.copyTo(whole(cv::Rect({0, chart.rows}, legend.size())));
  return overlay;
}

}  // namespace repose::vision
