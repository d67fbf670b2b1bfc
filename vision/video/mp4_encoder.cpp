#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "base/input_error.h"
#include "vision/picture/ffmpeg.h"
#include "vision/picture/made_here.h"
#include "vision/video/film_encoder.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;

/// Lets a frame rate such as 29.97 become 30000/1001.
constexpr int kMaxOfFraction = 1'001'000;

/// Default quality, one thread: the output of several depends on their number. "mbtree" distributes
/// bits by what later pictures reuse; with AVX-512, x264 then reads uninitialised memory if rows
/// are not a multiple of eight macroblocks (128 pixels), and the file's bytes depend on it. Test:
/// FilmWriter.HasTheSameBytesWhateverWasInMemory.
AVDictionary* encoder_options() {
  AVDictionary* options = nullptr;
  av_dict_set(&options, "crf", "23", 0);
  av_dict_set(&options, "x264-params", "mbtree=0", 0);
  av_dict_set(&options, "threads", "1", 0);
  return options;
}

ffmpeg::Codec opened_encoder(double frames_per_s, int width, int height) {
  const auto* encoder = avcodec_find_encoder(AV_CODEC_ID_H264);
  if (!encoder) {
    throw base::InputError({.value = "FFmpeg was installed without an encoder of H.264",
                            .fix = "let the name end in .gif, or install FFmpeg with x264."});
  }
  ffmpeg::Codec codec(avcodec_alloc_context3(encoder));
  if (!codec) throw std::bad_alloc();
  codec->width = width;
  codec->height = height;
  codec->framerate = av_d2q(frames_per_s, kMaxOfFraction);
  codec->time_base = av_inv_q(codec->framerate);
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->color_range = AVCOL_RANGE_MPEG;
  codec->colorspace = AVCOL_SPC_SMPTE170M;  // ITU-R BT.601, as in ffmpeg::Conversion
  codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  AVDictionary* options = encoder_options();
  const int result = avcodec_open2(codec.get(), encoder, &options);
  av_dict_free(&options);
  return result < 0 ? nullptr : std::move(codec);
}

struct CloseOutput {
  void operator()(AVFormatContext* output) const {
    avio_closep(&output->pb);
    avformat_free_context(output);
  }
};
using Output = std::unique_ptr<AVFormatContext, CloseOutput>;

/// The output with its header written. Nothing in it depends on library versions or the date.
Output opened_output(const fs::path& file, const AVCodecContext& codec) {
  AVFormatContext* format = nullptr;
  if (avformat_alloc_output_context2(&format, nullptr, "mp4", nullptr) < 0) throw std::bad_alloc();
  Output output(format);
  format->flags |= AVFMT_FLAG_BITEXACT;
  AVStream* stream = avformat_new_stream(format, nullptr);
  if (!stream || avcodec_parameters_from_context(stream->codecpar, &codec) < 0) {
    throw std::bad_alloc();
  }
  stream->time_base = codec.time_base;
  stream->avg_frame_rate = codec.framerate;
  // Marks it as a film of ours; see vision/picture/made_here.h.
  av_dict_set(&format->metadata, "comment", kFilmComment, 0);
  const std::string name = "file:" + file.string();
  const bool is_good = avio_open(&format->pb, name.c_str(), AVIO_FLAG_WRITE) >= 0 &&
                       avformat_write_header(format, nullptr) >= 0;
  return is_good ? std::move(output) : nullptr;
}

class Mp4Encoder : public FilmEncoder {
 public:
  Mp4Encoder(const fs::path& file, double frames_per_s, int width, int height)
      : bgr_(ffmpeg::blank_frame(width & ~1, height & ~1, AV_PIX_FMT_BGR24)),  // chroma is halved
        yuv_(ffmpeg::blank_frame(width & ~1, height & ~1, AV_PIX_FMT_YUV420P)),
        packet_(ffmpeg::empty_packet()) {
    ffmpeg::silence();
    codec_ = opened_encoder(frames_per_s, bgr_->width, bgr_->height);
    if (codec_) output_ = opened_output(file, *codec_);
  }

  bool add(const Picture& picture) override {
    if (!output_ || av_frame_make_writable(yuv_.get()) < 0) return false;
    constexpr int kChannels = 3;
    av_image_copy_plane(bgr_->data[0], bgr_->linesize[0], picture.bgr.data(),
                        kChannels * picture.width, kChannels * bgr_->width, bgr_->height);
    to_yuv_.run(*bgr_, *yuv_);
    yuv_->pts = frames_++;
    return encode(yuv_.get());
  }

  bool close() override {
    if (!output_) return false;
    const bool is_written = encode(nullptr) && av_write_trailer(output_.get()) >= 0;
    return avio_closep(&output_->pb) >= 0 && is_written;
  }

 private:
  /// nullptr: flushes the encoder.
  bool encode(const AVFrame* frame) {
    if (avcodec_send_frame(codec_.get(), frame) < 0) return false;
    int result = 0;
    while ((result = avcodec_receive_packet(codec_.get(), packet_.get())) >= 0) {
      packet_->duration = 1;
      av_packet_rescale_ts(packet_.get(), codec_->time_base, output_->streams[0]->time_base);
      if (av_interleaved_write_frame(output_.get(), packet_.get()) < 0) return false;
    }
    return result == AVERROR(EAGAIN) || result == AVERROR_EOF;
  }

  ffmpeg::Frame bgr_, yuv_;
  ffmpeg::Packet packet_;
  ffmpeg::Conversion to_yuv_;
  ffmpeg::Codec codec_;  ///< nullptr, like the next, if it could not be opened
  Output output_;
  std::int64_t frames_ = 0;
};

}  // namespace

std::unique_ptr<FilmEncoder> mp4_encoder(const fs::path& file, double frames_per_s, int width,
                                         int height) {
  return std::make_unique<Mp4Encoder>(file, frames_per_s, width, height);
}

}  // namespace repose::vision
