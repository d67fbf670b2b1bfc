#pragma once

#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
#include <libavutil/imgutils.h>
#include <libswscale/swscale.h>
}

/// RAII wrappers for FFmpeg's objects.
namespace repose::vision::ffmpeg {

struct Free {
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
  void operator()(AVFormatContext* input) const { avformat_close_input(&input); }
};
using Input = std::unique_ptr<AVFormatContext, Free>;
using Frame = std::unique_ptr<AVFrame, Free>;
using Packet = std::unique_ptr<AVPacket, Free>;
using Codec = std::unique_ptr<AVCodecContext, Free>;

/// Stops FFmpeg's libraries from printing to stderr; only the command line prints.
void silence();

/// Without pixels, for a decoder to fill.
/// @throws std::bad_alloc, as do the next two
Frame empty_frame();
Packet empty_packet();
/// Black, with rows that are padded.
Frame blank_frame(int width, int height, AVPixelFormat format);

/// Converts frames from one pixel format to another, and rescales if their sizes differ. Between
/// RGB and YUV by ITU-R BT.601, whatever colour space a film declares.
class Conversion {
 public:
  /// @throws base::InputError  "what. Fix: ...": a pixel format that cannot be converted.
  void run(const AVFrame& from, AVFrame& to);

 private:
  std::unique_ptr<SwsContext, Free> scaler_;
};

}  // namespace repose::vision::ffmpeg
