#pragma once

#include <filesystem>
#include <mutex>
#include <string>

#include "dem/study/study.h"
#include "studio/json_answer.h"

namespace repose::studio {

/// The studies of one folder and their sheets of readings, for the page to show and fill in.
/// Everything is read from the files on demand, and checked as by the command line. Thread-safe.
///
/// Studies are identified by their names in the folder: no other path is accepted, and files
/// outside the folder that a study names are neither shown nor written. All members throw
/// base::InputError for an unknown name.
class StudyFolder {
 public:
  explicit StudyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }
  /// @throws base::InputError  unknown study.
  std::filesystem::path path_of(const std::string& name) const;
  /// Its calibration's folder.
  std::filesystem::path calibration_of(const std::string& name) const;

  /// `studies`, [{`study`, `title`, `is_table`, `faults`}].
  Json list() const;
  /// `study`, `title`, `is_table`, `faults`, `hash`, `version`, `notes`, `sought` (see
  /// sought_json()), `experiments` [{`experiment`, `description`, `value_name`, `unit`, `keys`,
  /// `measured`, `sheet`}]; for an unreadable study, only the first four.
  Json study(const std::string& name) const;

  /// Checks a sheet's cells, {`columns`, `rows`}: `faults` [{`row`, `column`, `text`}], row and
  /// column null if it does not concern a cell, `notes`, number of `readings`.
  Json checked_sheet(const std::string& name, const std::string& experiment,
                     const Json& cells) const;
  /// The same, and writes it; `version` is the one that was filled in.
  /// @throws base::InputError  the file has changed since, or cannot be written.
  Json save_sheet(const std::string& name, const std::string& experiment, const Json& cells);

  /// Appends the rows of a film's table to the sheet; existing rows of the same sample are
  /// replaced. Columns that the sheet's test reads and the sheet lacks are added. Returns the
  /// `sheet`'s name, the number of `rows` added, and `notes`.
  /// @throws base::InputError  the study names no sheet, the sheet would be invalid (for example a
  ///   different drop height than the study's), or it cannot be written; nothing is written then.
  Json add_readings(const std::string& name, const std::string& experiment, const std::string& csv);

  /// Checks `numbers` of the protocols, {"experiment.drop": {"height_mm": "500"}}: `faults`
  /// [{`key`, `text`}], the key null if it concerns none of them. An empty text removes a key.
  /// Likewise for free coefficients: {"contact.particle_wall.restitution": {"max": "0.8"}}.
  Json checked_numbers(const std::string& name, const Json& numbers) const;
  /// The same, and writes them if there are no faults; throws like save_sheet().
  Json save_numbers(const std::string& name, const Json& numbers);

 private:
  struct SheetOf;
  SheetOf sheet_of(const std::string& name, const std::string& experiment) const;

  const std::filesystem::path folder_;
  std::mutex saving_;
};

/// The choices for a new study: `grains`, `plates`, `parts`, `experiments` with their properties,
/// and the defaults `usual_grain` and `usual_plate`.
Json new_study_form();

/// Preview of the study that a filled-in form describes: `command`, `faults` [{`field`, `text`}],
/// `title`, `assumed`, `warning`, `sheets`, `usual`.
Json drafted_study(const std::filesystem::path& folder, const Json& said);

/// Writes it like `repose new`. @returns  the same, and `study`, its name
/// @throws base::InputError  there is an error, or it cannot be written.
Json start_study(const std::filesystem::path& folder, const Json& said);

/// @throws base::InputError  `sent` is not based on this text: its `version` differs.
void require_version(const Json& sent, const std::string& text, const std::string& name);

/// A study's free coefficients: [{`name`, `value`, `min`, `max`}]; `value` is null if not set.
Json sought_json(const dem::Study& study);

/// Whether a file is in a folder, after resolving links.
bool is_within(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace repose::studio
