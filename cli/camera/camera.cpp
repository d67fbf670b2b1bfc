#include "cli/camera/camera.h"

#include <atomic>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <utility>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/input_error.h"
#include "base/memory.h"
#include "cli/camera/camera_output.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/common/terminal.h"
#include "vision/camera/board.h"
#include "vision/camera/lens_file.h"
#include "vision/files/file_list.h"
#include "vision/measure/repose_angle.h"

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
  plan.pictures = files_in(vision::list_pictures(arguments.pictures), plan.errors, plan.notes);
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
  std::vector<std::string> errors;  ///< one per picture; empty: it was read
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
        if (!base::is_out_of_memory(error)) throw;
        looks.errors[i] =
            base::no_memory(plan.pictures[i].string(), "a smaller picture, or fewer --threads");
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

namespace {

constexpr const char* kCameraNotes = R"(
PICTURE shows the board of repose board; a folder stands for all pictures in it.
Take ten or more with the zoom and focus that the heaps are photographed with:
the board filling half of the picture or more, sharp, in the middle and in every
corner, turned by 20 to 40 degrees to the left, right, up and down.

The fit has one focal length, the position of the lens's axis, and as many
distortion coefficients (Brown-Conrady, as in OpenCV) as the pictures support.
Uncertainties are half-widths of 95 % intervals.

Refused, with the reason: fewer than 5 pictures with the board, pictures of
different sizes, boards that all face the same way or cover too little of the
picture, corners too far from the fit, a focal length that remains uncertain.

The camera file is for repose measure --camera-file, which then corrects the
lens's distortion. It is valid for uncropped pictures of any size from this
camera.

Examples:
  repose camera board_photos --out camera.toml
  repose measure heap.jpg --board --camera-file camera.toml
)";

}  // namespace

Command camera_command() {
  const auto given = std::make_shared<CameraArguments>();
  return {.name = "camera",
          .summary = "Find a camera's lens from pictures of the board",
          .options = {{"pictures", "PICTURE|FOLDER ...",
                       "Pictures of the board, or folders of them", &given->pictures, true},
                      {"--out", "FILE.toml", "Camera file to write", &given->out_file},
                      {"--square-mm", "MM", "Side of a printed square (24)", &given->square_mm},
                      {"--json", "FILE|-", "Full results, for programs", &given->json_file},
                      {"--threads", "N", "Pictures in parallel (all cores)", &given->threads}},
          .notes = kCameraNotes,
          .missing = "no picture given. Fix: repose camera PICTURE ..., or a folder of pictures.",
          .run = [given] { return run_camera(*given); }};
}

}  // namespace repose::cli
