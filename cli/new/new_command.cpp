#include "cli/new/new_command.h"

#include <memory>

#include "cli/new/new_options.h"
#include "cli/new/new_study.h"

namespace repose::cli {
namespace {

constexpr const char* kNewNotes = R"(
Writes a commented study file and, in a folder of the same name beside it, a
CSV sheet for each experiment to fill in at the bench: soybean.toml and
soybean/drops.csv, tilts.csv, rolls.csv, heaps.csv. Values not given are typical
of the grain, and marked as assumed in the file. Existing files are never
overwritten.

KIND of grain: soybean, maize, wheat, rice, hazelnut, pea, rapeseed, glass
(beads), other. KIND of plate, tube, incline, pane (the upright walls of a
draw-down): acrylic, steel, aluminium, glass, pvc, wood, rubber. Bounds of the
coefficients are from the literature on that grain where there is any, otherwise
wide.

Examples:
  repose new my_grain.toml
  repose new soybean.toml --grains soybean --plate acrylic \
    --grain-mm 7.6,6.9,6.2 --tube-mm 50x150
)";

}  // namespace

Command new_command() {
  const auto given = std::make_shared<NewArguments>();
  return {
      .name = "new",
      .summary = "Start a study: its file and sheets to fill in",
      .options = {{"study", "STUDY.toml", "Study file to write", &given->study, true},
                  {.name = "--grains",
                   .value_name = "KIND",
                   .help = "Kind of grain (other)",
                   .target = &given->grains,
                   .words = grain_names()},
                  {"--grain-mm", "L,W,T", "Length, width, thickness (typical)", &given->grain_mm},
                  {"--density-kg-m3", "D", "Density of a grain (typical)", &given->density_kg_m3},
                  {.name = "--plate",
                   .value_name = "KIND",
                   .help = "Material of the plate (steel)",
                   .target = &given->plate,
                   .words = plate_names()},
                  {.name = "--tube",
                   .value_name = "KIND",
                   .help = "Material of the tube (as the plate)",
                   .target = &given->tube,
                   .words = plate_names()},
                  {.name = "--incline",
                   .value_name = "KIND",
                   .help = "Material of the incline (as the plate)",
                   .target = &given->incline,
                   .words = plate_names()},
                  {.name = "--pane",
                   .value_name = "KIND",
                   .help = "Material of a box's walls (as the plate)",
                   .target = &given->pane,
                   .words = plate_names()},
                  {"--tube-mm", "DxH", "Inner diameter and height (from grain size)",
                   &given->tube_mm},
                  {"--experiments", "A,B,...", "Of the experiments (drop,tilt,roll,heap)",
                   &given->experiments}},
      .notes = kNewNotes,
      .missing = "no study file given. Fix: repose new my_study.toml.",
      .run = [given] { return run_new(*given); }};
}

}  // namespace repose::cli
