#include <fmt/format.h>

#include "calibrate/statistics/bench/method.h"
#include "calibrate/statistics/bench/units.h"

/// Plates covered with glued grains: a bed of grains has no formula, the simulation stands for it.
namespace repose::calibrate {
namespace {

constexpr const char* kNoConstant =
    "No material constant: glued grains interlock. Calibrate a study with these readings.";

Method angle_method(const std::string& name, const std::string& what) {
  return {
      .source = "mean of the readings",
      .columns = {{"angle_deg", what, 0, kRightAngle_deg}},
      .outputs = {{name, "deg", what, [](ReadingValues v) { return v[0]; }, 0, kRightAngle_deg}},
      .error = {},
      .validity = kNoConstant};
}

}  // namespace

Method drop_on_grains_method() {
  Method method = restitution_method();
  method.source = "mean of the readings";
  method.outputs = {{"rebound", "mm", "height of rebound from glued grains",
                     [](ReadingValues v) { return v[1]; }}};
  method.optional_columns = {in_air_column()};
  method.remarks = {};
  method.error_of_all = {};
  method.validity =
      "No material constant: on a bed most grains are thrown aside. Calibrate a study with these "
      "readings.";
  return method;
}

Method tilt_on_grains_method() {
  return angle_method("angle_of_sliding", "tilt at which bonded grains slide off");
}

Method roll_on_grains_method() {
  return angle_method("angle_of_rolling", "tilt at which a single grain rolls off");
}

}  // namespace repose::calibrate
