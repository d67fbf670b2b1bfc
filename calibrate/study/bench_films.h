#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "dem/study/experiment_table.h"
#include "dem/study/study.h"

/// Films of bench experiments that a study names, as in measured = { videos = ["drops"] }.
namespace repose::calibrate {

/// What a film gave.
struct FilmReading {
  std::string experiment;
  std::filesystem::path file;
  std::string status;           ///< "ok", "flagged", "refused" or "not read"
  std::optional<double> value;  ///< in the unit of the experiment; none: it does not count
  double uncertainty = 0;       ///< half-width of its 95 % interval
  std::string reason;           ///< why there is no value, or why a person should look at it
  /// Of a length that the study states and the film shows, as the fall of a drop: seen less stated,
  /// by stated.
  double length_error = 0;
};

/// A number read off a film, with the half-width of its 95 % interval.
struct FilmNumber {
  double value = 0;
  double uncertainty = 0;
};

/// Gives a film its reading: the value of the experiment's sheet, of a row with these columns
/// ("drop_mm", "rebound_mm"). A film of an experiment done otherwise than the study says is
/// refused.
void read_row(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
              const std::map<std::string, FilmNumber>& row, FilmReading& film);

/// The study with the films' readings as its measured values: each film is a repeat. What they
/// share is told by the lengths that they show and the study states: their mean error, of frame
/// rate, lens or scale, is one of the readings too, and is a standard uncertainty as it is not
/// corrected (JCGM 100:2008, GUM, F.2.4.5). Proved by BenchFilms.WhatFilmsShare*.
dem::Study with_films(dem::Study study, const std::vector<FilmReading>& films);

}  // namespace repose::calibrate
