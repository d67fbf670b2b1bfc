#include "cli/measure/measure.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibrate/report/measure_report.h"
#include "cli/common/copies.h"
#include "cli/common/heap_names.h"
#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/measure/measure_batch.h"
#include "cli/measure/measure_csv.h"
#include "cli/measure/measure_json.h"
#include "cli/measure/measure_options.h"
#include "cli/measure/measure_table.h"
#include "cli/measure/summary.h"

namespace repose::cli {
namespace {

void print_errors(const std::vector<MeasuredPicture>& pictures) {
  for (const MeasuredPicture& picture : pictures) {
    const std::string whose = picture.outcome == Outcome::internal_error ? "internal error: " : "";
    if (!picture.error.empty()) print_line(whose + picture.error);
    if (!picture.overlay_error.empty()) print_line(picture.overlay_error);
  }
}

/// Of pictures and films that are copies of an earlier one.
void name_copies(std::vector<MeasuredPicture>& pictures) {
  std::vector<MeasuredPicture*> whole;
  std::vector<std::filesystem::path> files;
  std::vector<std::string> pixels;
  for (MeasuredPicture& picture : pictures) {
    if (is_of_series(picture) || picture.outcome != Outcome::measured) continue;
    whole.push_back(&picture);
    files.emplace_back(picture.file);
    pixels.push_back(picture.pixels);
  }
  const auto first_of = copies_among(files, pixels);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (!first_of[i]) continue;
    whole[i]->copy_of = files[*first_of[i]].string();
    print_line(text_of_copy(files[i], files[*first_of[i]]));
  }
}

std::string human_text(const std::vector<MeasuredPicture>& pictures,
                       const MeasureArguments& arguments) {
  const auto is_unread = [](const auto& picture) { return picture.outcome != Outcome::measured; };
  if (std::all_of(pictures.begin(), pictures.end(), is_unread)) return {};
  const TableStyle style{.columns = columns_of(stdout),
                         .has_colour = wants_colour(stdout),
                         .shows_definitions = arguments.shows_definitions};
  std::string text = measure_table(pictures, style);
  const auto repeats = std::count_if(pictures.begin(), pictures.end(),
                                     [](const auto& picture) { return !is_of_series(picture); });
  if (repeats > 1) text += '\n' + summary_text(summarise(pictures)) + '\n';
  return text;
}

std::string report_page(const std::vector<MeasuredPicture>& pictures) {
  std::vector<calibrate::report::MeasuredPhotograph> shown;
  for (const MeasuredPicture& picture : pictures) {
    if (is_of_series(picture) || !picture.copy_of.empty()) continue;
    shown.push_back({.file = picture.file,
                     .error = picture.outcome == Outcome::measured ? "" : picture.error,
                     .angle = picture.angle,
                     .overlay = picture.overlay,
                     .heap = picture.heap});
  }
  return calibrate::report::measure_report(shown).html;
}

Outputs results_of(const std::vector<MeasuredPicture>& pictures,
                   const MeasureArguments& arguments) {
  Outputs outputs;
  outputs.show(human_text(pictures, arguments));
  outputs.add(arguments.json_file, measure_json(pictures));
  outputs.add(arguments.csv_file, measure_csv(pictures));
  outputs.add(arguments.summary_file, summary_json(summarise(pictures)));
  if (!arguments.report_file.empty()) outputs.add(arguments.report_file, report_page(pictures));
  return outputs;
}

ExitCode exit_code(const std::vector<MeasuredPicture>& pictures) {
  const auto any = [&](auto predicate) {
    return std::any_of(pictures.begin(), pictures.end(), predicate);
  };
  if (any([](const auto& picture) { return picture.outcome == Outcome::internal_error; })) {
    return ExitCode::internal_error;
  }
  if (any([](const auto& picture) {
        return picture.outcome == Outcome::bad_input || !picture.overlay_error.empty();
      })) {
    return ExitCode::bad_input;
  }
  const bool any_angle = any(
      [](const auto& picture) { return picture.angle.status != vision::MeasureStatus::refused; });
  return any_angle ? ExitCode::done : ExitCode::nothing_measurable;
}

}  // namespace

ExitCode run_measure(const MeasureArguments& arguments) {
  const MeasurePlan plan = plan_measure(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);

  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  std::vector<MeasuredPicture> pictures = measure_batch(plan, is_interrupted);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  name_copies(pictures);
  if (arguments.groups_by_name) {
    for (MeasuredPicture& picture : pictures) picture.heap = heap_by_name(picture.file);
  }
  name_outliers(pictures);
  Outputs outputs = results_of(pictures, arguments);
  outputs.write_files();
  print_errors(pictures);
  outputs.write();
  return exit_code(pictures);
}

}  // namespace repose::cli
