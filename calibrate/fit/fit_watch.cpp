#include "calibrate/fit/fit_watch.h"

namespace repose::calibrate {

namespace {

thread_local const std::atomic<bool>* watched = nullptr;

}  // namespace

FitWatch::FitWatch(const std::atomic<bool>& is_interrupted) : before_(watched) {
  watched = &is_interrupted;
}

FitWatch::~FitWatch() { watched = before_; }

bool is_fit_interrupted() { return watched != nullptr && *watched; }

void stop_if_interrupted() {
  if (is_fit_interrupted()) throw FitInterrupted();
}

}  // namespace repose::calibrate
