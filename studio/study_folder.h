#pragma once

#include <filesystem>
#include <mutex>
#include <string>

#include "dem/study/study.h"
#include "studio/json_answer.h"

namespace repose::studio {

/// The studies of one folder, and the sheets of readings that they name, as the page shows them and
/// has them filled in. Everything is read from the files when somebody asks, and checked by what
/// the command line checks it by. Several threads may ask at once.
///
/// Studies are known by their names in the folder: no other name leads anywhere, and of what a
/// study names nothing outside the folder is shown or written. All of it throws base::InputError
/// for a name that is not there.
class StudyFolder {
 public:
  explicit StudyFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }
  /// @throws base::InputError  there is no such study.
  std::filesystem::path path_of(const std::string& name) const;
  /// Where it is calibrated.
  std::filesystem::path calibration_of(const std::string& name) const;

  /// `studies`, [{`study`, `title`, `is_table`, `faults`}].
  Json list() const;
  /// `study`, `title`, `is_table`, `faults`, `hash`, `version`, `notes`, `sought` [{`name`, `min`,
  /// `max`}], `experiments` [{`experiment`, `description`, `value_name`, `unit`, `keys`,
  /// `measured`, `sheet`}]; of a study at fault nothing but the first four.
  Json study(const std::string& name) const;

  /// What a sheet's cells, {`columns`, `rows`}, would give: `faults` [{`row`, `column`, `text`}],
  /// both null where it is not of a cell, `notes`, `readings`.
  Json checked_sheet(const std::string& name, const std::string& experiment,
                     const Json& cells) const;
  /// The same, and writes it; `version` says which one was filled in.
  /// @throws base::InputError  the file is of another version by now, or cannot be written.
  Json save_sheet(const std::string& name, const std::string& experiment, const Json& cells);

  /// Puts rows of a table that a film gave below the sheet's own; those of the same sample are
  /// replaced. Columns that the sheet's test reads and the sheet lacks are added. Answers the
  /// `sheet`'s name, how many `rows` were added, and `notes`.
  /// @throws base::InputError  the study names no sheet, the sheet would be at fault, as with
  ///   another height of fall than the study's, or it cannot be written: nothing is.
  Json add_readings(const std::string& name, const std::string& experiment, const std::string& csv);

  /// What `numbers` of the protocols, {"experiment.drop": {"height_mm": "500"}}, would be: `faults`
  /// [{`key`, `text`}], the key null where it is of none of them. An empty text takes a key out.
  /// Likewise of the coefficients that are sought: {"contact.particle_wall.restitution": {"max":
  /// "0.8"}}.
  Json checked_numbers(const std::string& name, const Json& numbers) const;
  /// The same, and writes them; as save_sheet().
  Json save_numbers(const std::string& name, const Json& numbers);

 private:
  struct SheetOf;
  SheetOf sheet_of(const std::string& name, const std::string& experiment) const;

  const std::filesystem::path folder_;
  std::mutex saving_;
};

/// What is asked for a new study: `grains`, `plates`, `parts`, `experiments`, each with what it
/// says unless it is said otherwise.
Json new_study_form();

/// What a study of which that was said would be: `command`, `faults` [{`field`, `text`}], `title`,
/// `assumed`, `sheets`, `coefficients`, `usual`.
Json drafted_study(const std::filesystem::path& folder, const Json& said);

/// Writes it as `repose new` does. @returns  the same, and `study`, its name
/// @throws base::InputError  there is a fault, or it cannot be written.
Json start_study(const std::filesystem::path& folder, const Json& said);

/// @throws base::InputError  what was sent is not made from this text: its `version` is another.
void require_version(const Json& sent, const std::string& text, const std::string& name);

/// The coefficients that a study seeks: [{`name`, `value`, `min`, `max`}]; no value: null.
Json sought_json(const dem::Study& study);

/// Whether a file is in a folder, once links are followed.
bool is_within(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace repose::studio
