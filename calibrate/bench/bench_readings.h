#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/experiment/picture_set.h"
#include "calibrate/statistics/table/table.h"
#include "dem/experiment/experiment_table.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/study/study.h"

/// A study's bench measurements: sheets of readings (measured = { readings = "drops.csv" }), films
/// of experiments (measured = { videos = ["drops"] }), photographs and films of heaps. Readings
/// count only if the bench was set up as the study says. Grains are dropped in air but simulated
/// without it.

namespace repose::base {
struct FallingGrain;
}

namespace repose::calibrate {

/// Relative tolerance: a height or slope measured again for each reading differs a little from the
/// nominal one.
inline constexpr double kSameSetting = .01;

/// The protocol's value for a key of a study file, in the key's unit.
double protocol_value(const dem::ExperimentEntry& entry, dem::Protocol protocol,
                      std::string_view key);

/// Name of the part of a height's uncertainty due to the correction for air drag.
inline constexpr const char* kAirPart = "air_drag";

/// A grain for the calculation of air drag: its sphericity is that of the ellipsoid with the same
/// moments of inertia, whose half-axes are a^2 = 5/2 (k_y^2 + k_z^2 - k_x^2), k^2 the moments
/// divided by the mass, and whose surface area is 4 pi ((a^p b^p + a^p c^p + b^p c^p) / 3)^(1/p), p
/// = 1.6075, within 1.1 % (K. Thomsen, see Michon 2004, "Surface area of an ellipsoid",
/// numericana.com).
base::FallingGrain falling_grain(const dem::ClumpShape& grain, double density_kg_m3);

/// The study with its drops' rebound heights corrected to those without air: readings are raised by
/// the loss due to air drag (base::rise_without_air_m); the uncertainty and a description of this
/// are in Measured::systematic. Readings without air drag (Measured::in_air) stay unchanged.
/// @throws base::InputError  a rebound height that is impossible for such a grain in air.
dem::Study without_air(dem::Study study, const dem::ClumpShape& grain);

/// The reading from a film.
struct FilmReading {
  std::string experiment;
  std::filesystem::path file;
  std::string status;           ///< "ok", "flagged", "refused" or "not read"
  std::optional<double> value;  ///< in the unit of the experiment; std::nullopt: it does not count
  double uncertainty = 0;       ///< half-width of its 95 % interval
  std::string reason;           ///< why there is no value, or why the user should check it
  /// For a length that the study states and the film shows, such as a drop's fall height: (seen -
  /// stated) / stated.
  double length_error = 0;
};

/// A number read off a film, with the half-width of its 95 % interval.
struct FilmNumber {
  double value = 0;
  double uncertainty = 0;
};

/// Sets a film's reading: the value that the experiment's sheet would give for a row with these
/// columns ("drop_mm", "rebound_mm"). A film is refused if the experiment differs from the study's.
void read_row(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
              const std::map<std::string, FilmNumber>& row, FilmReading& film);

/// The study with the films' readings as its measured values: each film is a repeat. Their common
/// error follows from lengths that they show and the study states: the mean error of these, due to
/// frame rate, lens or scale, also affects the readings, and counts as a standard uncertainty
/// because it is not corrected (JCGM 100:2008, GUM, F.2.4.5). Proved by BenchFilms.WhatFilmsShare*.
dem::Study with_films(dem::Study study, const std::vector<FilmReading>& films);

/// The reading from a picture of a bench's heap.
struct PictureReading {
  std::filesystem::path file;
  std::string status;  ///< "ok", "flagged" or "refused"; see counts_in_mean
  std::optional<double> angle_deg;
  std::string reason;     ///< why there is no angle
  double own_deg = 0;     ///< as SetPicture::own_deg
  double camera_deg = 0;  ///< as SetPicture::camera_deg
  std::string heap = {};  ///< as SetPicture::heap
};

/// All pictures as a set.
PictureSet set_of(const std::vector<PictureReading>& pictures);

/// The study with the angles of its heaps as measured values: one for each heap, however many
/// pictures there are of it. The camera's error is a part common to all pictures; a single heap's
/// angle is no more certain than its own pictures.
dem::Study with_pictures(dem::Study study, const std::vector<PictureReading>& pictures);

/// The readings from a sheet.
struct SheetReadings {
  std::string experiment;
  std::filesystem::path file;
  int rows = 0;
  std::vector<std::string>
      notes;  ///< on rows that were omitted or may not be readings, a sentence each
  /// One per grain, in the unit of the experiment; repeats on one grain are averaged first.
  std::vector<double> values;
  bool in_air = true;  ///< as dem::Measured::in_air: its column in_air
};

/// The readings of the table of an experiment's sheet, for those who fill it in.
/// @param file  for messages
/// @throws base::InputError  all its errors, as in read_sheets().
SheetReadings readings_of_table(const dem::ExperimentEntry& entry,
                                const dem::StudyExperiment& described,
                                const std::filesystem::path& file, Table table, NoRows no_rows);

/// Reads all sheets, in the order of the experiments. A sheet without rows has no values or is an
/// error, depending on `no_rows`.
/// @throws base::InputError  all errors of all sheets, "FILE:LINE: ..." each: see read_sheet and
///   check_readings; or a fall height or incline that differs from the study's.
std::vector<SheetReadings> read_sheets(const dem::Study& study, NoRows no_rows);

/// The study with the sheets' values as its measured values.
dem::Study with_readings(dem::Study study, const std::vector<SheetReadings>& sheets);

/// All measurements of a study's bench.
struct Measurement {
  std::vector<SheetReadings> sheets;
  std::vector<PictureReading> pictures;  ///< and films of heaps
  std::vector<FilmReading> films;        ///< of the other experiments
};

/// The study as measured, from the study as read: readings of its sheets and films and angles of
/// its pictures become its measured values, those of drops corrected to no air (without_air).
/// @throws base::InputError  see without_air().
dem::Study as_measured(dem::Study study, const dem::ClumpShape& grain,
                       const Measurement& measurement);

}  // namespace repose::calibrate
