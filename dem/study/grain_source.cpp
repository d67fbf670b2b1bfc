#include "dem/study/grain_source.h"

#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {
namespace {

std::string text_of(const CalliperSizes& sizes) {
  constexpr double kMillimetres = 1e3;
  return fmt::format("calliper sizes {:g} x {:g} x {:g} mm, tip {:g}",
                     sizes.length_m * kMillimetres, sizes.width_m * kMillimetres,
                     sizes.thickness_m * kMillimetres, sizes.tip_fraction);
}

ClumpFile filled(const Mesh& surface, const FillOptions& options) {
  FilledClump filled = clump_of(surface, options);
  return {.source = {}, .repairs = {}, .shape = std::move(filled.shape), .errors = filled.errors};
}

/// At the size given by the source.
ClumpFile unscaled_grain(const GrainSource& source) {
  if (source.clump) return read_clump_file(*source.clump);
  if (source.scan) {
    Scan scan = read_scan(*source.scan, source.scan_unit);
    ClumpFile clump = filled(scan.surface, source.fill);
    clump.source = source.scan->filename().string();
    clump.repairs = std::move(scan.repairs);
    return clump;
  }
  if (!source.sizes) {
    throw base::InputError(
        {.value = "the grain has no shape", .fix = "give a scan, calliper sizes or a clump file."});
  }
  ClumpFile clump = filled(calliper_surface(*source.sizes), source.fill);
  clump.source = text_of(*source.sizes);
  return clump;
}

}  // namespace

void scale(ClumpFile& clump, double factor) {
  clump.shape = scaled(clump.shape, factor);
  for (double* length_m : {&clump.errors.surface_error_mean_m, &clump.errors.surface_error_p95_m,
                           &clump.errors.sticks_out_m, &clump.errors.falls_short_m}) {
    *length_m *= factor;
  }
}

ClumpFile build_grain(const GrainSource& source) {
  ClumpFile clump = unscaled_grain(source);
  if (source.size_factor != 1) scale(clump, source.size_factor);
  return clump;
}

}  // namespace repose::dem
