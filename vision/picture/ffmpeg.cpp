#include "vision/picture/ffmpeg.h"

#include <cstring>
#include <new>

#include "base/input_error.h"

namespace repose::vision::ffmpeg {

void silence() { av_log_set_level(AV_LOG_QUIET); }

Frame empty_frame() {
  Frame frame(av_frame_alloc());
  if (!frame) throw std::bad_alloc();
  return frame;
}

Packet empty_packet() {
  Packet packet(av_packet_alloc());
  if (!packet) throw std::bad_alloc();
  return packet;
}

Frame blank_frame(int width, int height, AVPixelFormat format) {
  Frame frame = empty_frame();
  frame->format = format;
  frame->width = width;
  frame->height = height;
  if (av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
  // Zeroed, so that reads beyond a row's end do not depend on earlier memory contents.
  for (AVBufferRef* buffer : frame->buf) {
    if (buffer) std::memset(buffer->data, 0, static_cast<std::size_t>(buffer->size));
  }
  return frame;
}

void Conversion::run(const AVFrame& from, AVFrame& to) {
  scaler_.reset(sws_getCachedContext(
      scaler_.release(), from.width, from.height, static_cast<AVPixelFormat>(from.format), to.width,
      to.height, static_cast<AVPixelFormat>(to.format), SWS_BICUBIC, nullptr, nullptr, nullptr));
  if (!scaler_ || sws_scale(scaler_.get(), from.data, from.linesize, 0, from.height, to.data,
                            to.linesize) < 0) {
    throw base::InputError({.value = "its colours are stored in a way that cannot be read",
                            .fix = "save it in another format."});
  }
}

}  // namespace repose::vision::ffmpeg
