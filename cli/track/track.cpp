#include "cli/track/track.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/common/copies.h"
#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/track/track_batch.h"
#include "cli/track/track_json.h"
#include "cli/track/track_options.h"
#include "cli/track/track_table.h"

namespace repose::cli {
namespace {

void print_errors(const std::vector<TrackedFilm>& films) {
  for (const TrackedFilm& film : films) {
    const std::string whose = film.is_internal_error ? "internal error: " : "";
    if (!film.error.empty()) print_line(whose + film.error);
    if (!film.overlay_error.empty()) print_line(film.overlay_error);
  }
}

/// Of films that are copies of an earlier one.
void name_copies(std::vector<TrackedFilm>& films) {
  std::vector<std::filesystem::path> files;
  for (const TrackedFilm& film : films) files.emplace_back(film.file);
  const auto first_of = copies_among(files, std::vector<std::string>(files.size()));
  for (std::size_t i = 0; i < films.size(); ++i) {
    if (!first_of[i]) continue;
    films[i].copy_of = films[*first_of[i]].file;
    print_line(text_of_copy(files[i], files[*first_of[i]]));
  }
}

ExitCode exit_code(const std::vector<TrackedFilm>& films) {
  const auto any = [&](auto predicate) {
    return std::any_of(films.begin(), films.end(), predicate);
  };
  if (any([](const auto& film) { return film.is_internal_error; })) return ExitCode::internal_error;
  if (any([](const auto& film) { return !film.error.empty() || !film.overlay_error.empty(); }))
    return ExitCode::bad_input;
  return any([](const auto& film) { return has_reading(film); }) ? ExitCode::done
                                                                 : ExitCode::nothing_measurable;
}

}  // namespace

ExitCode run_track(const TrackArguments& arguments) {
  const TrackPlan plan = plan_track(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);

  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  std::vector<TrackedFilm> films = track_batch(plan, is_interrupted);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  name_copies(films);
  Outputs outputs;
  const bool any_was_read =
      std::any_of(films.begin(), films.end(), [](const auto& film) { return film.error.empty(); });
  if (any_was_read)
    outputs.show(track_table(films, plan.filmed, columns_of(stdout), wants_colour(stdout)));
  outputs.add(arguments.json_file, track_json(films));
  outputs.add(arguments.csv_file, track_csv(films, plan));
  outputs.write_files();
  print_errors(films);
  outputs.write();
  return exit_code(films);
}

}  // namespace repose::cli
