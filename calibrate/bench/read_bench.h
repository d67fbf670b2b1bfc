#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/bench/bench_readings.h"
#include "calibrate/statistics/table/table.h"
#include "dem/study/study.h"

/// Reads a study's bench measurements: its sheets, the angles in its pictures, and its films.

namespace repose::calibrate {

/// Called with the completed fraction of a film, from 0 to 1, from any thread.
using FilmReport = std::function<void(std::size_t film, double fraction)>;

struct BenchOptions {
  NoRows no_rows = NoRows::refused;  ///< how to treat a sheet without rows
  int threads = 1;                   ///< for films, several at a time
  /// Called once for each experiment with films, with their number, before they are tracked;
  /// returns the callback for their progress. May be null.
  std::function<FilmReport(std::size_t films)> watch_films = {};
};

/// Reads the sheets that a study names, measures its photographs and films of heaps, with the hints
/// saved beside them (scale, board, lens), and tracks its other films. For each file there are
/// readings, or the reason why not.
/// @param study  as read from its file: files are looked up by its paths
/// @param notes  remarks on the readings for the user are added
/// @throws base::InputError  all errors of all files; or no picture or film of an experiment gives
///   a reading.
/// @throws std::runtime_error  an internal error, with the name of the file.
Measurement read_bench(const dem::Study& study, const BenchOptions& options,
                       std::vector<std::string>& notes);

}  // namespace repose::calibrate
