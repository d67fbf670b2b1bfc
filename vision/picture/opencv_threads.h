#pragma once

namespace repose::vision {

/// Keeps OpenCV to the thread that calls it, from the first call on: pictures and films are worked
/// on side by side. Threads inside OpenCV would gain nothing then; while one of them waits it may
/// start on another picture and reseed the generator that GrabCut draws from; and their number
/// cannot be changed while they are used. Hence each way into OpenCV that runs in several threads
/// begins here.
void keep_opencv_to_one_thread();

}  // namespace repose::vision
