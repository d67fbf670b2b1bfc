#include "cli/measure/measure.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "calibrate/measured/measured_command.h"
#include "calibrate/measured/measured_json.h"
#include "calibrate/measured/measured_set.h"
#include "calibrate/report/measure_report.h"
#include "cli/common/batch.h"
#include "cli/common/terminal.h"
#include "cli/measure/measure_table.h"
#include "vision/files/file_list.h"

namespace repose::cli {

std::vector<calibrate::MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                                      const std::atomic<bool>& is_interrupted) {
  using Measured = std::vector<calibrate::MeasuredPicture>;
  std::vector<Measured> results =
      batch_of<Measured>(plan.pictures.size(), plan.threads, "measured", is_interrupted,
                         [&](std::size_t number, const std::function<void(double)>& report) {
                           return calibrate::measure_file(plan, number, report);
                         });
  Measured all;
  for (Measured& one : results) {
    std::move(one.begin(), one.end(), std::back_inserter(all));
  }
  return all;
}

namespace {

void print_errors(const std::vector<calibrate::MeasuredPicture>& pictures) {
  for (const calibrate::MeasuredPicture& picture : pictures) {
    const std::string whose =
        picture.outcome == calibrate::Outcome::internal_error ? "internal error: " : "";
    if (!picture.error.empty()) print_line(whose + picture.error);
    if (!picture.overlay_error.empty()) print_line(picture.overlay_error);
  }
}

/// Marks pictures and films that are duplicates of an earlier one.
void name_copies(std::vector<calibrate::MeasuredPicture>& pictures) {
  std::vector<calibrate::MeasuredPicture*> whole;
  std::vector<std::filesystem::path> files;
  std::vector<std::string> pixels;
  for (calibrate::MeasuredPicture& picture : pictures) {
    if (is_of_series(picture) || picture.outcome != calibrate::Outcome::measured) continue;
    whole.push_back(&picture);
    files.emplace_back(picture.file);
    pixels.push_back(picture.pixels);
  }
  const auto first_of = vision::copies_among(files, pixels);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (!first_of[i]) continue;
    whole[i]->copy_of = files[*first_of[i]].string();
    print_line(vision::text_of_copy(files[i], files[*first_of[i]]));
  }
}

std::string human_text(const std::vector<calibrate::MeasuredPicture>& pictures,
                       const MeasureArguments& arguments, const MeasurePlan& plan) {
  const auto is_unread = [](const auto& picture) {
    return picture.outcome != calibrate::Outcome::measured;
  };
  if (std::all_of(pictures.begin(), pictures.end(), is_unread)) return {};
  const TableStyle style{.columns = columns_of(stdout),
                         .has_colour = wants_colour(stdout),
                         .shows_definitions = arguments.shows_definitions};
  std::string text = measure_table(pictures, style);
  const std::string definition = plan.options.definition_text();
  if (!definition.empty()) text += "\nall angles by " + definition + '\n';
  const auto repeats = std::count_if(pictures.begin(), pictures.end(),
                                     [](const auto& picture) { return !is_of_series(picture); });
  if (repeats > 1) text += '\n' + calibrate::text_of_set(calibrate::measured_set(pictures)) + '\n';
  return text;
}

std::string report_page(const std::vector<calibrate::MeasuredPicture>& pictures,
                        const MeasurePlan& plan) {
  std::vector<calibrate::report::MeasuredPhotograph> shown;
  for (const calibrate::MeasuredPicture& picture : pictures) {
    if (is_of_series(picture) || !picture.copy_of.empty()) continue;
    shown.push_back(calibrate::photograph_of(picture));
  }
  return calibrate::report::measure_report(shown, plan.options).html;
}

Outputs results_of(const std::vector<calibrate::MeasuredPicture>& pictures,
                   const MeasureArguments& arguments, const MeasurePlan& plan) {
  Outputs outputs;
  outputs.show(human_text(pictures, arguments, plan));
  outputs.add(arguments.json_file, calibrate::measure_json(pictures));
  outputs.add(arguments.csv_file, calibrate::measure_csv(pictures));
  outputs.add(arguments.summary_file,
              calibrate::set_json(calibrate::measured_set(pictures), plan.options));
  if (!arguments.report_file.empty()) {
    outputs.add(arguments.report_file, report_page(pictures, plan));
  }
  return outputs;
}

ExitCode exit_code(const std::vector<calibrate::MeasuredPicture>& pictures) {
  const auto any = [&](auto predicate) {
    return std::any_of(pictures.begin(), pictures.end(), predicate);
  };
  if (any([](const auto& picture) {
        return picture.outcome == calibrate::Outcome::internal_error;
      })) {
    return ExitCode::internal_error;
  }
  if (any([](const auto& picture) {
        return picture.outcome == calibrate::Outcome::bad_input || !picture.overlay_error.empty();
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
  std::vector<calibrate::MeasuredPicture> pictures = measure_batch(plan, is_interrupted);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  name_copies(pictures);
  if (arguments.groups_by_name) {
    for (calibrate::MeasuredPicture& picture : pictures)
      picture.heap = vision::heap_by_name(picture.file);
  }
  calibrate::name_outliers(pictures);
  Outputs outputs = results_of(pictures, arguments, plan);
  outputs.write_files();
  print_errors(pictures);
  outputs.write();
  return exit_code(pictures);
}

}  // namespace repose::cli
