#pragma once

#include "vision/compare/heap_comparison.h"

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

inline const char* name_of(vision::Cover cover) {
  switch (cover) {
    case vision::Cover::whole:
      return "whole";
    case vision::Cover::part:
      return "part";
    case vision::Cover::none:
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

}  // namespace repose::cli
