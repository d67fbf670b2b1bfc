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

/// What a study's bench gave: sheets of readings (measured = { readings = "drops.csv" }), films of
/// experiments (measured = { videos = ["drops"] }), photographs and films of heaps. Readings count
/// for an experiment only where the bench was set as the study says. Grains are dropped in air, and
/// simulated without it.

namespace repose::base {
struct FallingGrain;
}

namespace repose::calibrate {

/// A height or slope measured anew for each reading differs a little from the one that was set.
inline constexpr double kSameSetting = .01;

/// What the protocol has for a key of a study file, in its unit.
double protocol_value(const dem::ExperimentEntry& entry, dem::Protocol protocol,
                      std::string_view key);

/// Name of the part of a height's uncertainty that the correction for the drag of the air brings.
inline constexpr const char* kAirPart = "air_drag";

/// A grain as the air meets it: the sphericity is that of the ellipsoid with the same moments of
/// inertia, whose half-axes are a^2 = 5/2 (k_y^2 + k_z^2 - k_x^2), k^2 the moments by the mass, and
/// whose surface is 4 pi ((a^p b^p + a^p c^p + b^p c^p) / 3)^(1/p), p = 1.6075, within 1.1 %
/// (K. Thomsen, see Michon 2004, "Surface area of an ellipsoid", numericana.com).
base::FallingGrain falling_grain(const dem::ClumpShape& grain, double density_kg_m3);

/// The study with the rebounds of its drops as high as they would be without air: what was read at
/// the bench is raised by what the drag of the air takes (base::rise_without_air_m), its
/// uncertainty and what was done are in Measured::systematic. Not those that are free of it
/// already (Measured::in_air).
/// @throws base::InputError  a rebound that no such grain could have in air.
dem::Study without_air(dem::Study study, const dem::ClumpShape& grain);

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

/// What a picture of a bench's heap gave.
struct PictureReading {
  std::filesystem::path file;
  std::string status;  ///< "ok", "flagged" or "refused"; see counts_in_mean
  std::optional<double> angle_deg;
  std::string reason;     ///< why there is none
  double own_deg = 0;     ///< as SetPicture::own_deg
  double camera_deg = 0;  ///< as SetPicture::camera_deg
  std::string heap = {};  ///< as SetPicture::heap
};

/// All of them together.
PictureSet set_of(const std::vector<PictureReading>& pictures);

/// The study with the angles of its heaps as measured values: one for each heap, however many
/// pictures there are of it. What the camera does to all pictures is a part that they share; a
/// single heap's angle is no surer than its own pictures are.
dem::Study with_pictures(dem::Study study, const std::vector<PictureReading>& pictures);

/// What a sheet gave.
struct SheetReadings {
  std::string experiment;
  std::filesystem::path file;
  int rows = 0;
  std::vector<std::string>
      notes;  ///< rows that were left out or may be no readings, a sentence each
  /// Of each grain, in the unit of the experiment: repeats on one grain are averaged first.
  std::vector<double> values;
  bool in_air = true;  ///< as dem::Measured::in_air: its column in_air
};

/// What the table of an experiment's sheet gives, for whoever fills it in.
/// @param file  for messages
/// @throws base::InputError  every error of it, as of read_sheets().
SheetReadings readings_of_table(const dem::ExperimentEntry& entry,
                                const dem::StudyExperiment& described,
                                const std::filesystem::path& file, Table table, NoRows no_rows);

/// Reads all of them, in the order of the experiments. A sheet without rows has no values, or is an
/// error.
/// @throws base::InputError  every error of every sheet, "FILE:LINE: ..." each: see read_sheet
/// and check_readings; or another height of fall or incline than that of the study.
std::vector<SheetReadings> read_sheets(const dem::Study& study, NoRows no_rows);

/// The study with the sheets' values as its measured values.
dem::Study with_readings(dem::Study study, const std::vector<SheetReadings>& sheets);

/// All that a study's bench gave.
struct Measurement {
  std::vector<SheetReadings> sheets;
  std::vector<PictureReading> pictures;  ///< and films of heaps
  std::vector<FilmReading> films;        ///< of the other experiments
};

/// The study as measured, from the study as read: readings of its sheets and films and angles of
/// its pictures are its measured values, those of drops as without air (without_air).
/// @throws base::InputError  see without_air.
dem::Study as_measured(dem::Study study, const dem::ClumpShape& grain,
                       const Measurement& measurement);

}  // namespace repose::calibrate
