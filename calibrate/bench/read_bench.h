#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/bench/bench_readings.h"
#include "calibrate/statistics/table/table.h"
#include "dem/study/study.h"

/// Reads a study's bench: its sheets, the angles in its pictures, and what its films show.

namespace repose::calibrate {

/// Is told which fraction of a film is done, from 0 to 1, from any thread.
using FilmReport = std::function<void(std::size_t film, double fraction)>;

struct BenchOptions {
  NoRows no_rows = NoRows::refused;  ///< of a sheet without any
  int threads = 1;                   ///< for films, several at a time
  /// Asked once for each experiment with films, of their number, before they are tracked; what it
  /// gives hears how far they are. Null: nobody asks.
  std::function<FilmReport(std::size_t films)> watch_films = {};
};

/// Reads the sheets that a study names, measures its photographs and films of heaps, with the hints
/// that are kept beside them (scale, board, lens), and tracks its other films: each file gives
/// readings, or it is said why it gives none.
/// @param study  as it was read: its own paths are where it looks
/// @param notes  what a person should know of the readings is added
/// @throws base::InputError  every error of every file; or an experiment none of whose pictures or
///   films gives a reading.
/// @throws std::runtime_error  an error of the program's own, with the name of the file.
Measurement read_bench(const dem::Study& study, const BenchOptions& options,
                       std::vector<std::string>& notes);

}  // namespace repose::calibrate
