#pragma once

#include "base/input_error.h"
#include "base/units.h"
#include "vision/camera/board.h"
#include "vision/camera/lens_file.h"
#include "vision/camera/sized_heap.h"
#include "vision/compare/heap_comparison.h"
#include "vision/compare/heap_sets.h"
#include "vision/drawing/overlay.h"
#include "vision/drawing/scan_overlay.h"
#include "vision/files/file_list.h"
#include "vision/files/heap_file.h"
#include "vision/film/film_angle.h"
#include "vision/hints/hint_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"
#include "vision/scan/scan_file.h"
#include "vision/scan/scanned_heap.h"
#include "vision/track/film_track.h"

/// Angles of repose in photographs and films, and what films of drops, rolls and tilts show. Link
/// repose::vision.
///
///     #include <iostream>
///     #include <repose/measure.h>
///
///     int main(int, char* arguments[]) {
///       const repose::HeapInFile seen = repose::measure_heap_file(arguments[1]);
///       const repose::ReposeAngle& angle = seen.heap.angle;
///       if (angle.status == repose::MeasureStatus::refused) {
///         std::cerr << angle.reason << '\n';
///         return 1;
///       }
///       std::cout << repose::to_degrees(*angle.angle_rad) << " degrees\n";
///       repose::write_picture("overlay.png", repose::draw_overlay(seen.measured(), angle, {}));
///     }
///
/// What cannot be used is an InputError: what() says in a line for each fault where it is, what is
/// wrong and what to do.
namespace repose {

using base::InputError;

// A heap in a file: a photograph or a film, with the hints that are kept beside it, or a scan.
using vision::HeapInFile;
using vision::measure_heap_file;
using vision::measure_scan;
using vision::PictureSettings;
using vision::read_scan;
using vision::save_hints;
using vision::ScannedHeap;
using vision::ScanOptions;

// A heap in a picture: its angle alone, or with a lens, and a scale or a printed board.
using vision::Estimate;
using vision::measure_repose_angle;
using vision::measure_sized_heap;
using vision::MeasureOptions;
using vision::MeasureStatus;
using vision::read_lens_file;
using vision::ReposeAngle;
using vision::ScaleOptions;
using vision::SizedHeap;

// A heap that comes to rest in a film, and frames of the film.
using vision::FilmAngle;
using vision::FilmFile;
using vision::FrameSeries;
using vision::measure_film;

// Films of one grain that drops, rolls out or slides.
using vision::Filmed;
using vision::FilmTrack;
using vision::track_film;
using vision::TrackOptions;

// Whether two heaps, or two sets of them, agree.
using vision::compare_heaps;
using vision::compare_sets;

// Pictures.
using vision::draw_overlay;
using vision::draw_scan_overlay;
using vision::list_pictures;
using vision::OverlayNotes;
using vision::Picture;
using vision::read_picture;
using vision::write_picture;

}  // namespace repose
