#include "cli/camera/camera.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/input_error.h"
#include "cli/camera/camera_result.h"
#include "cli/common/interrupt.h"
#include "cli/common/memory.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "cli/common/picture_list.h"
#include "cli/common/progress.h"
#include "cli/common/terminal.h"
#include "vision/camera/board.h"
#include "vision/camera/lens_file.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

struct CameraPlan {
  std::vector<std::filesystem::path> pictures;
  double square_mm = vision::kBoardSquare_mm;
  int threads = 1;
  std::vector<std::string> errors;
  std::vector<std::string> notes;
};

CameraPlan plan_camera(const CameraArguments& arguments) {
  CameraPlan plan;
  plan.square_mm = read_number_within({"--square-mm", arguments.square_mm, plan.errors},
                                      vision::kSmallestSquare_mm, vision::kLargestSquare_mm,
                                      "--square-mm 23.9, the side of a printed one")
                       .value_or(plan.square_mm);
  plan.threads = read_threads({"--threads", arguments.threads, plan.errors});
  FileList list = list_pictures(arguments.pictures);
  plan.pictures = std::move(list.files);
  plan.notes = std::move(list.notes);
  plan.errors.insert(plan.errors.end(), list.errors.begin(), list.errors.end());
  if (arguments.out_file == kStandardOutput) {
    plan.errors.emplace_back("--out -: a camera file is read by its name. Fix: name a file.");
  }
  check_output_places({{"--out", arguments.out_file, ".toml", "by repose camera"},
                       json_place(arguments.json_file, "\"square_mm\"")},
                      plan.pictures, plan.errors);
  return plan;
}

struct Looks {
  std::vector<vision::BoardPicture> pictures;
  std::vector<std::string> errors;  ///< one a picture; empty where it was read
};

vision::BoardPicture look_at(const std::filesystem::path& file) {
  const vision::Picture picture = vision::read_picture(file);
  return {.file = file.string(),
          .width = picture.width,
          .height = picture.height,
          .corners = vision::find_board(picture)};
}

Looks look_at_all(const CameraPlan& plan, const std::atomic<bool>& is_interrupted) {
  Looks looks{.pictures = std::vector<vision::BoardPicture>(plan.pictures.size()),
              .errors = std::vector<std::string>(plan.pictures.size())};
  PartsProgress progress(plan.pictures.size(), "looked at");
  tbb::task_arena arena(plan.threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, plan.pictures.size(), [&](std::size_t i) {
      if (is_interrupted) return;
      try {
        looks.pictures[i] = look_at(plan.pictures[i]);
      } catch (const base::InputError& error) {
        looks.errors[i] = error.what();
      } catch (const std::exception& error) {
        if (!is_out_of_memory(error)) throw;
        looks.errors[i] =
            no_memory(plan.pictures[i].string(), "a smaller picture, or fewer --threads");
      }
      progress.report(i, 1);
    });
  });
  return looks;
}

}  // namespace

ExitCode run_camera(const CameraArguments& arguments) {
  const CameraPlan plan = plan_camera(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);

  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  const Looks looks = look_at_all(plan, is_interrupted);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  std::vector<std::string> errors;
  for (const std::string& error : looks.errors) {
    if (!error.empty()) errors.push_back(error);
  }
  print_lines(errors);
  if (!errors.empty()) return ExitCode::bad_input;

  CameraResult result{
      .files = {}, .fit = vision::fit_lens(looks.pictures), .square_mm = plan.square_mm};
  for (const vision::BoardPicture& picture : looks.pictures) result.files.push_back(picture.file);
  const bool is_refused = result.fit.status == vision::MeasureStatus::refused;
  Outputs outputs;
  outputs.show(camera_table(result, columns_of(stdout)));
  outputs.add(arguments.json_file, camera_json(result));
  if (!is_refused) {
    outputs.add(arguments.out_file, vision::lens_file_text(result.fit.lens, origin_of(result)));
  }
  outputs.write();
  return is_refused ? ExitCode::nothing_measurable : ExitCode::done;
}

}  // namespace repose::cli
