#include "cli/commands.h"

#include <memory>

#include <CLI/CLI.hpp>

#include "cli/calibrate/calibrate.h"
#include "cli/compare/compare.h"
#include "cli/export/export.h"
#include "cli/measure/measure.h"
#include "cli/render/render.h"
#include "cli/report/report.h"
#include "cli/shape/shape.h"
#include "cli/simulate/simulate.h"
#include "cli/statistics/statistics_commands.h"
#include "cli/verify/verify.h"

namespace repose::cli {
namespace {

constexpr const char* kMeasureNotes = R"(
PICTURE is a level side view: JPEG, PNG, TIFF, BMP or WebP. A folder stands
for the pictures in it. FILE may be - for standard output.

Methods:
  auto   Several ways to part the heap from its background are tried and the
         most convincing silhouette is taken. Its ground line is found; thin
         aprons at the toe, the crest and stray grains are left out. A robust
         line is fitted to each side within the window. Angles are measured
         from the ground line.
  paper  The chain of the published hazelnut study: grey picture, Otsu
         threshold, holes filled, edge, ordinary least squares through each
         side's edge over the whole window, mean of the two sides' absolute
         slopes.

Window: the stretch of each side that is fitted, in parts of the heap's
height. Sides are hollow at the toe and round at the crest, so the window is
part of the result: always state it. The other definitions in use (height
over base, half-height tangent, whole flank, other windows) are listed by
--definitions and in the JSON.

Uncertainties are half-widths of 95 % intervals. Several pictures give a mean
of those with status ok. A number with status flagged has a warning that a
person must look at; a refused picture has a reason instead of a number.
)";

constexpr const char* kCompareNotes = R"(
Each PICTURE is a level side view of one heap: a photograph or a rendered
silhouette. Both are measured like repose measure does, turned until their
ground is level, and put above each other: axis on axis, ground on ground. The
axis is the middle of the silhouette between 20 and 80 % of its height; where
a side is missing, crest is put on crest. All differences are the first minus
the second.

Verdict on the angles, from the 95 % interval of their difference:
  equivalent   the interval lies within the margin
  different    it does not, and it leaves out 0
  cannot tell  neither
It is about these two heaps. Heaps of the same grains differ, too: pour and
photograph several, and compare the means of repose measure.

Scale: mm of a pixel, or the known width of the base. One value is for both
pictures, A,B is one for each. Without a scale only shapes are compared, and
lengths are in parts of the square root of a silhouette's area.
)";

constexpr const char* kShapeNotes = R"(
Turns a scan (STL, OBJ, PLY) or calliper sizes into a clump: a rigid grain of
overlapping spheres for a discrete element program. Volume, mass and inertia
come from the surface, never from the spheres. Small errors of a scan are
mended and named; others are refused with the way to mend them.

Volume error: what the spheres leave out and what of them sticks out, as a
share of the body's volume.

Examples:
  repose shape nut.stl --spheres 11 --out nut.json --mesh nut.glb
  repose shape --size-mm 22.48,18.23,17.46 --tip .5 --density-kg-m3 851
)";

constexpr const char* kSimulateNotes = R"(
EXPERIMENT is drop (rebound height, mm), tilt (angle of sliding, degrees),
roll (distance along the flat, mm) or heap (angle of repose, degrees). STUDY
is a study file: samples/hazelnut/study.toml explains all of its keys.

A heap's final state is drawn as silhouettes from --views sides, equally spaced
over half a turn, each measured as repose measure does: 1 is the XZ view alone,
0 draws none. Where at least half of the views of every repeat could be
measured their mean is the value, else the angle from the grains' positions;
both are told.

Each repeat has its own seed: --seed, and those that follow. The same seed
gives the same result at any number of threads. With --out, the same command
goes on with what was interrupted.

Examples:
  repose simulate drop study.toml --repeats 10
  repose simulate heap study.toml --set contact.particle_wall.restitution=0.3
)";

constexpr const char* kCalibrateNotes = R"(
STUDY is a study file in which coefficients of contact have bounds instead of a
value, as in restitution = { min = 0.1, max = 0.6 }, and experiments say what
the bench measured. All unknowns are fitted to all measurements at once; each
has an interval and a verdict: determined, one-sided, or undetermined by these
data. The fit is then simulated with fresh seeds.

Simulations are kept in --out: the same command goes on with what was
interrupted, and a study with other bounds or measurements finds them again.
The same study gives the same result with any number of --jobs.

Methods:
  joint     all unknowns fitted to all measurements at once, with intervals
  paper     as a published calibration did: single points, to compare with

Budgets:
  quick     13 minutes of one core for the fit; heaps ten times softer, few
  standard  150 minutes of one core; heaps as stiff as the study says
  paper     62 simulations at most, as many as a published calibration made
The minutes are estimates for a study of some hundred grains; checks come on top.

Examples:
  repose calibrate study.toml
  repose calibrate study.toml --budget standard --jobs 8 --out hazelnut
)";

constexpr const char* kReportNotes = R"(
FOLDER is what repose calibrate --out wrote. The page needs no other file and
no network: it can be sent by e-mail, printed on A4, and read on a telephone.
It begins with the coefficients and shows how they were found. A study that has
no result yet gets a page that says so. Photographs that the study names are
measured again; those that are gone are said.

The tables hold the numbers of every chart, as CSV.

Examples:
  repose report study_calibration
  repose report hazelnut --out hazelnut.html --tables none
)";

constexpr const char* kExportNotes = R"(
FOLDER is what repose calibrate left (--out). Material, contacts, clump and a
deck for each experiment go to FOLDER/export/PROGRAM, with a README.txt that
says of each coefficient what it means here and there.

Programs:
  liggghts    decks for drop, tilt, roll and heap
  yade        the same as scripts
  lammps      decks for drop, tilt and roll
  mercurydpm  a driver for the drop, not run by us
  edem        tables to type in

Rolling friction means something else in each. What a program has exactly, or
nearly, is converted. Where its law is another one the export is refused, and
the reason told; --approximate writes the value that is the same in the mean.

Example:
  repose export hazelnut --to yade --approximate
)";

constexpr const char* kRenderNotes = R"(
STATE is a .vtp file that repose simulate --out wrote, or the trajectory.pvd of
a run for a film.

Styles:
  silhouette  Black grains on white, every pixel one or the other.
  photo       What a camera in a laboratory sees: soft light, shadows, a plate
              before a backdrop, depth of field, noise.

Without --camera all depths have the same scale. With it there is a lens on a
stand: distance_mm from the grains' middle, height_mm above the ground,
focal_mm for a picture 36 mm wide, pitch_deg (down), roll_deg, k1 and k2
(distortion). What is left out makes it level and the grains fit.

--truth: camera, mm to a pixel, the ground line and the heap's upper edge, in
pixels from the top left corner.

Examples:
  repose render heaps/heap_seed_1.vtp --out heap.png
  repose render heap.vtp --style photo --camera distance_mm=1500 --out heap.jpg
  repose render heap.vtp --turntable 72 --out heap.mp4
  repose render heap.vtp --out heap.glb
)";

Command measure_command(CLI::App& app) {
  const auto given = std::make_shared<MeasureArguments>();
  MeasureArguments& arguments = *given;
  CLI::App* measure = app.add_subcommand("measure", "Measure heaps in pictures");
  measure->add_option("pictures", arguments.pictures, "Pictures, or folders of pictures")
      ->option_text("PICTURE|FOLDER ...")
      ->required();
  measure->add_option("--method", arguments.method, "How to measure (auto)")
      ->option_text("auto|paper");
  measure->add_option("--window", arguments.window, "Part of the height (0.2,0.8)")
      ->option_text("FROM,TO");
  measure->add_option("--exclude", arguments.exclude, "Box in pixels to leave out; repeatable")
      ->option_text("X,Y,W,H")
      ->allow_extra_args(false);
  measure->add_option("--pitch-deg", arguments.pitch_deg, "Camera's downward pitch (not known)")
      ->option_text("DEGREES");
  measure->add_option("--overlay", arguments.overlay_folder, "Draw what was measured")
      ->option_text("FOLDER");
  measure->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  measure->add_option("--csv", arguments.csv_file, "A row for each picture")->option_text("FILE|-");
  measure->add_option("--summary", arguments.summary_file, "Mean and interval, as JSON")
      ->option_text("FILE|-");
  measure->add_option("--report", arguments.report_file, "A page to read, send and print")
      ->option_text("FILE.html");
  measure->add_option("--threads", arguments.threads, "Pictures at a time (all cores)")
      ->option_text("N");
  measure->add_flag("--definitions", arguments.shows_definitions, "List other definitions too");
  measure->footer(kMeasureNotes);
  return {measure, [given] { return run_measure(*given); },
          "no picture is named. Fix: repose measure PICTURE, or a folder of pictures."};
}

Command compare_command(CLI::App& app) {
  const auto given = std::make_shared<CompareArguments>();
  CompareArguments& arguments = *given;
  constexpr int kPictures = 2;
  CLI::App* compare = app.add_subcommand("compare", "Compare the heaps in two pictures");
  compare->add_option("pictures", arguments.pictures, "The two pictures")
      ->option_text("PICTURE PICTURE")
      ->required()
      ->expected(kPictures);
  compare->add_option("--mm-per-px", arguments.mm_per_px, "Scale: mm of a pixel")
      ->option_text("A[,B]");
  compare->add_option("--base-mm", arguments.base_mm, "Scale: known width of the base")
      ->option_text("A[,B]");
  compare->add_option("--grain-mm", arguments.grain_mm, "Grain size, to count in grains too")
      ->option_text("D");
  compare->add_option("--margin-deg", arguments.margin_deg, "Difference that does not matter (2)")
      ->option_text("DEGREES");
  compare->add_option("--method", arguments.method, "How to measure (auto)")
      ->option_text("auto|paper");
  compare->add_option("--window", arguments.window, "Part of the height (0.2,0.8)")
      ->option_text("FROM,TO");
  compare->add_option("--pitch-deg", arguments.pitch_deg, "Cameras' downward pitch (not known)")
      ->option_text("A[,B]");
  compare->add_option("--exclude-first", arguments.exclude_first, "Box to leave out; repeatable")
      ->option_text("X,Y,W,H")
      ->allow_extra_args(false);
  compare->add_option("--exclude-second", arguments.exclude_second, "Box to leave out; repeatable")
      ->option_text("X,Y,W,H")
      ->allow_extra_args(false);
  compare->add_option("--overlay", arguments.overlay_file, "Draw both outlines")
      ->option_text("FILE.png");
  compare->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  compare->footer(kCompareNotes);
  return {compare, [given] { return run_compare(*given); },
          "two pictures are needed. Fix: repose compare PICTURE PICTURE."};
}

Command shape_command(CLI::App& app) {
  const auto given = std::make_shared<ShapeArguments>();
  ShapeArguments& arguments = *given;
  CLI::App* shape = app.add_subcommand("shape", "Turn a scan or sizes into a clump of spheres");
  shape->add_option("scan", arguments.scan, "Surface of one grain")->option_text("SCAN");
  shape->add_option("--size-mm", arguments.size_mm, "Length, width, thickness, without a scan")
      ->option_text("L,W,T");
  shape->add_option("--tip", arguments.tip, "Pointedness of one end, 0 to 1 (0)")
      ->option_text("SHARE");
  shape->add_option("--unit", arguments.unit, "Unit of the scan (mm)")->option_text("mm|m");
  shape->add_option("--spheres", arguments.spheres, "How many spheres (11)")->option_text("N");
  shape->add_option("--volume-error", arguments.volume_error, "As many as this error takes")
      ->option_text("P%");
  shape->add_option("--density-kg-m3", arguments.density_kg_m3, "For the mass")->option_text("D");
  shape->add_option("--out", arguments.out_file, "Clump file")->option_text("FILE.json");
  shape->add_option("--mesh", arguments.mesh_file, "Surface and spheres, to look at")
      ->option_text("FILE.glb|FILE.stl");
  shape->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  shape->footer(kShapeNotes);
  return {shape, [given] { return run_shape(*given); }, ""};
}

Command simulate_command(CLI::App& app) {
  const auto given = std::make_shared<SimulateArguments>();
  SimulateArguments& arguments = *given;
  CLI::App* simulate = app.add_subcommand("simulate", "Run a bench experiment of a study");
  simulate->add_option("experiment", arguments.experiment, "Which experiment")
      ->option_text("drop|tilt|roll|heap")
      ->required();
  simulate->add_option("study", arguments.study, "Study file")
      ->option_text("STUDY.toml")
      ->required();
  simulate->add_option("--set", arguments.settings, "Replace a value of the study; repeatable")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  simulate->add_option("--seed", arguments.seed, "Of the first repeat")->option_text("N");
  simulate->add_option("--repeats", arguments.repeats, "How many, each with its own seed")
      ->option_text("N");
  simulate->add_option("--threads", arguments.threads, "At a time (all cores)")->option_text("N");
  simulate->add_option("--out", arguments.out_folder, "States, result.json; to go on from")
      ->option_text("FOLDER");
  simulate
      ->add_option("--trajectory-s", arguments.trajectory_s, "A frame each DT of simulated time, s")
      ->option_text("DT");
  simulate->add_option("--views", arguments.views, "Pictures of each heap, from all around (18)")
      ->option_text("N");
  simulate->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  simulate->footer(kSimulateNotes);
  return {simulate, [given] { return run_simulate(*given); },
          "an experiment and a study file are needed. Fix: repose simulate heap STUDY.toml."};
}

Command calibrate_command(CLI::App& app) {
  const auto given = std::make_shared<CalibrateArguments>();
  CalibrateArguments& arguments = *given;
  CLI::App* calibrate = app.add_subcommand("calibrate", "Find a study's open coefficients");
  calibrate->add_option("study", arguments.study, "Study file")
      ->option_text("STUDY.toml")
      ->required();
  calibrate->add_option("--budget", arguments.budget, "How much may be simulated (quick)")
      ->option_text("quick|standard|paper");
  calibrate->add_option("--method", arguments.method, "How the coefficients are found (joint)")
      ->option_text("joint|paper");
  calibrate->add_option("--set", arguments.settings, "Replace a value of the study; repeatable")
      ->option_text("KEY=VALUE")
      ->allow_extra_args(false);
  calibrate->add_option("--jobs", arguments.jobs, "Simulations at a time (all cores)")
      ->option_text("N");
  calibrate
      ->add_option("--out", arguments.out_folder, "Runs, result.json, heap.vtp (STUDY_calibration)")
      ->option_text("FOLDER");
  calibrate->add_option("--json", arguments.json_file, "Everything, for programs")
      ->option_text("FILE|-");
  calibrate->footer(kCalibrateNotes);
  return {calibrate, [given] { return run_calibrate(*given); },
          "no study file is named. Fix: repose calibrate STUDY.toml."};
}

Command report_command(CLI::App& app) {
  const auto given = std::make_shared<ReportArguments>();
  ReportArguments& arguments = *given;
  CLI::App* report = app.add_subcommand("report", "Write a page about a calibrated study");
  report->add_option("folder", arguments.folder, "What repose calibrate --out wrote")
      ->option_text("FOLDER")
      ->required();
  report->add_option("--out", arguments.out_file, "The page (FOLDER/report.html)")
      ->option_text("FILE.html");
  report->add_option("--tables", arguments.tables_folder, "Its numbers (FOLDER/tables)")
      ->option_text("FOLDER|none");
  report->footer(kReportNotes);
  return {report, [given] { return run_report(*given); },
          "no folder is named. Fix: repose report FOLDER, the one of repose calibrate --out."};
}

Command export_command(CLI::App& app) {
  const auto given = std::make_shared<ExportArguments>();
  ExportArguments& arguments = *given;
  CLI::App* exported = app.add_subcommand("export", "Write a calibrated study for other programs");
  exported->add_option("folder", arguments.folder, "Folder of a study that has ended")
      ->option_text("FOLDER")
      ->required();
  exported->add_option("--to", arguments.target, "For which program")
      ->option_text("PROGRAM")
      ->required();
  exported->add_flag("--approximate", arguments.takes_approximate,
                     "Convert what has no exact counterpart");
  exported->add_option("--out", arguments.out_folder, "Decks (FOLDER/export/PROGRAM)")
      ->option_text("FOLDER");
  exported->add_option("--json", arguments.json_file, "Files and conversions, for programs")
      ->option_text("FILE|-");
  exported->footer(kExportNotes);
  return {exported, [given] { return run_export(*given); },
          "a study's folder and a program are needed. Fix: repose export FOLDER --to liggghts."};
}

Command render_command(CLI::App& app) {
  const auto given = std::make_shared<RenderArguments>();
  RenderArguments& arguments = *given;
  CLI::App* render = app.add_subcommand("render", "Draw a simulated state");
  render->add_option("state", arguments.state, "State, or trajectory.pvd")
      ->option_text("STATE")
      ->required();
  render->add_option("--view", arguments.view, "From where (xz)")->option_text("xz|DEGREES");
  render->add_option("--style", arguments.style, "What it looks like (silhouette)")
      ->option_text("silhouette|photo");
  render->add_option("--size", arguments.size, "Pixels (1920,1080)")->option_text("W,H");
  render->add_option("--mm-per-px", arguments.mm_per_px, "Scale (all grains fit)")
      ->option_text("MM");
  render->add_option("--camera", arguments.camera, "A lens; keys below")
      ->option_text("KEY=NUMBER,...");
  render->add_option("--show", arguments.show, "What of a grain (mesh)")
      ->option_text("mesh|spheres|both");
  render->add_option("--seed", arguments.seed, "Of a photo's looks and noise (1)")
      ->option_text("N");
  render->add_option("--passes", arguments.passes, "Of a photo; more: smoother shadows (24)")
      ->option_text("N");
  render->add_option("--mask", arguments.mask_file, "Grains white, all else black")
      ->option_text("FILE.png");
  render->add_option("--truth", arguments.truth_file, "What is exact about the picture")
      ->option_text("FILE.json");
  render->add_option("--turntable", arguments.turntable, "A film from all around")
      ->option_text("FRAMES");
  render->add_option("--out", arguments.out_file, "Picture .png .jpg, model .glb, film .mp4 .gif")
      ->option_text("FILE");
  render->footer(kRenderNotes);
  return {render, [given] { return run_render(*given); },
          "no state is named. Fix: repose render STATE.vtp --out heap.png."};
}

Command verify_command(CLI::App& app) {
  const auto given = std::make_shared<VerifyArguments>();
  CLI::App* verify =
      app.add_subcommand("verify", "Prove the contact physics: expected and computed");
  verify->add_option("--json", given->json_file, "The table, for programs")->option_text("FILE|-");
  return {verify, [given] { return run_verify(*given); }, ""};
}

}  // namespace

std::vector<Command> add_commands(CLI::App& app) {
  std::vector<Command> commands = {
      measure_command(app), compare_command(app),   shape_command(app),   simulate_command(app),
      render_command(app),  calibrate_command(app), report_command(app),  export_command(app),
      bench_command(app),   design_command(app),    regress_command(app), verify_command(app)};
  for (const Command& command : commands) command.app->get_formatter()->column_width(32);
  return commands;
}

}  // namespace repose::cli
