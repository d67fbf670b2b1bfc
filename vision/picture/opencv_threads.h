#pragma once

namespace repose::vision {

/// Keeps OpenCV to the thread that calls it, from the first call on: pictures and films are worked
/// on side by side, and as many as there are cores gain nothing from threads inside OpenCV. (A film
/// alone would: a drop takes .7 s in place of .6.) While one of those waits it may start on another
/// picture and reseed the generator that GrabCut draws from, and their number cannot be changed
/// while they are used. Hence each way into OpenCV that runs in several threads begins here.
void keep_opencv_to_one_thread();

}  // namespace repose::vision
