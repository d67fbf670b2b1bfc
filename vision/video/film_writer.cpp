#include "vision/video/film_writer.h"

#include <string>
#include <utility>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "vision/video/film_encoder.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFixPlace = "choose a folder you may write to, or free some space there.";

}  // namespace

FilmWriter::FilmWriter(fs::path file, double frames_per_s)
    : file_(std::move(file)), frames_per_s_(frames_per_s) {
  const std::string ending = file_.extension().string();
  if (ending != ".mp4" && ending != ".gif") {
    base::refuse(file_, "no film can be written as \"" + ending + '"',
                 "let the name end in .mp4 or .gif.");
  }
}

FilmWriter::~FilmWriter() = default;

void FilmWriter::open_encoder() {
  part_ = base::part_of(file_);
  try {
    const auto encoder = file_.extension() == ".gif" ? gif_encoder : mp4_encoder;
    encoder_ = encoder(part_->path(), frames_per_s_, width_, height_);
  } catch (const base::InputError& error) {
    throw error.in(file_.string());
  }
}

void FilmWriter::add(const Picture& picture) {
  if (!encoder_) {
    width_ = picture.width;
    height_ = picture.height;
    if (width_ < 2 || height_ < 2)
      base::refuse(file_, "its picture size is too small", "640 x 480 pixels.");
    open_encoder();
  }
  if (picture.width != width_ || picture.height != height_) {
    base::refuse(file_, "its pictures are not all of one size", "draw them alike.");
  }
  if (!encoder_->add(picture)) base::refuse(file_, "cannot be written", kFixPlace);
}

void FilmWriter::close() {
  if (!encoder_) base::refuse(file_, "it has no pictures", "add one.");
  if (!encoder_->close()) base::refuse(file_, "cannot be written", kFixPlace);
  base::put_in_place(*part_, file_);
}

}  // namespace repose::vision
