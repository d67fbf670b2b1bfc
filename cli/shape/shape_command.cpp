#include "cli/shape/shape_command.h"

#include <memory>

#include "cli/shape/shape.h"
#include "cli/shape/shape_options.h"

namespace repose::cli {
namespace {

constexpr const char* kShapeNotes = R"(
Turns a scan (STL, OBJ, PLY) or calliper sizes into a clump: a rigid grain of
overlapping spheres for a discrete element program. Volume, mass and inertia
come from the surface, never from the spheres. Small defects of a scan are
repaired and listed; a scan with others is refused, with advice on fixing it.

Volume error: the volume missed by the spheres plus the volume sticking out, as
a fraction of the grain's volume.

Examples:
  repose shape nut.stl --spheres 11 --out nut.json --mesh nut.glb
  repose shape --size-mm 22.48,18.23,17.46 --tip .5 --density-kg-m3 851
)";

}  // namespace

Command shape_command() {
  const auto given = std::make_shared<ShapeArguments>();
  return {
      .name = "shape",
      .summary = "Make a clump of spheres from a scan or sizes",
      .options =
          {{"scan", "SCAN", "Surface of one grain", &given->scan},
           {"--size-mm", "L,W,T", "Length, width, thickness, without a scan", &given->size_mm},
           {"--tip", "FRACTION", "Pointedness of one end, 0 to 1 (0)", &given->tip},
           {"--unit", "mm|m", "Unit of the scan (mm)", &given->unit},
           {"--spheres", "N", "Number of spheres (11)", &given->spheres},
           {"--volume-error", "P%", "As many spheres as this error requires", &given->volume_error},
           {"--density-kg-m3", "D", "Density, to compute the mass", &given->density_kg_m3},
           {"--out", "FILE.json", "Clump file", &given->out_file},
           {"--mesh", "FILE.glb|FILE.stl", "Surface and spheres, for viewing", &given->mesh_file},
           {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kShapeNotes,
      .fields = kShapeFields,
      .run = [given] { return run_shape(*given); }};
}

}  // namespace repose::cli
