#pragma once

#include <array>
#include <string>
#include <vector>

#include "cli/compare/compare_options.h"
#include "vision/compare/heap_comparison.h"
#include "vision/compare/heap_sets.h"

/// The words and units of a comparison, in JSON and table.

namespace repose::cli {

inline const char* name_of(vision::Agreement verdict) {
  switch (verdict) {
    case vision::Agreement::equivalent:
      return "equivalent";
    case vision::Agreement::different:
      return "different";
    case vision::Agreement::cannot_tell:
      break;
  }
  return "cannot tell";
}

inline const char* name_of(vision::Coverage cover) {
  switch (cover) {
    case vision::Coverage::whole:
      return "whole";
    case vision::Coverage::part:
      return "part";
    case vision::Coverage::none:
      break;
  }
  return "no";
}

inline const char* name_of(vision::LengthUnit unit) {
  switch (unit) {
    case vision::LengthUnit::metre:
      return "mm";
    case vision::LengthUnit::root_area:
      return "root_area";
    case vision::LengthUnit::height:
      break;
  }
  return "height";
}

/// Files hold mm where the inside of the program has metres.
inline double shown_per_unit(vision::LengthUnit unit) {
  return unit == vision::LengthUnit::metre ? 1000 : 1;
}

/// The comparison for people to read, at most `columns` wide.
std::string compare_table(const ComparePlan& plan, const vision::HeapComparison& comparison,
                          int columns);

/// The comparison of two sets as people read it, for a terminal of some width.
std::string sets_table(const ComparePlan& plan,
                       const std::array<std::vector<vision::SeenHeap>, 2>& heaps,
                       const vision::SetComparison& comparison, int columns);

/// What a set is called in tables and figures.
std::string title_of(const HeapSource& source);

}  // namespace repose::cli
