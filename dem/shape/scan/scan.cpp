#include "dem/shape/scan/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/mesh_file.h"
#include "dem/shape/scan/repair.h"

namespace repose::dem {
namespace {

template <typename... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 400> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

std::string place_of(const Vector& point_m) {
  return text("(%.4g, %.4g, %.4g) mm", 1e3 * point_m.x(), 1e3 * point_m.y(), 1e3 * point_m.z());
}

/// A surface being repaired, with repairs made and errors that cannot be repaired.
struct Workpiece {
  Mesh mesh;
  std::vector<std::string> repairs;
  std::vector<base::Fault> errors;
};

void keep_triangles(Mesh& mesh, const std::vector<bool>& keep) {
  Mesh saved{.vertices = std::move(mesh.vertices), .triangles = {}};
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) saved.triangles.push_back(mesh.triangles[t]);
  }
  mesh = without_loose_corners(saved);
}

void weld_corners(Workpiece& piece) {
  Welded welded = weld(piece.mesh);
  piece.mesh = std::move(welded.mesh);
  if (welded.collapsed > 0) {
    piece.repairs.push_back(text("triangles without area removed: %zu", welded.collapsed));
  }
  if (welded.duplicates > 0) {
    piece.repairs.push_back(
        text("triangles removed that were there twice: %zu", welded.duplicates));
  }
}

/// If more than two triangles meet at an edge, the inside is ambiguous: removes them; the hole is
/// filled like any other.
void remove_non_manifold_edges(Workpiece& piece) {
  std::vector<bool> keep(piece.mesh.triangles.size(), true);
  const std::vector<EdgeUse> uses = edge_uses(piece.mesh);
  std::size_t edges = 0;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() <= 2) return;
    ++edges;
    for (const EdgeUse& use : edge) keep[static_cast<std::size_t>(use.triangle)] = false;
  });
  if (edges == 0) return;
  Mesh cut = piece.mesh;
  keep_triangles(cut, keep);
  const double fraction = 1 - area_m2(cut) / area_m2(piece.mesh);
  if (fraction > kLargestDroppedFraction) {
    piece.errors.push_back(
        {.value = text("more than two triangles meet in %zu edges, over %.2g %% of the surface",
                       edges, 100 * fraction),
         .fix = "MeshLab, Filters > Cleaning and Repairing > Repair non Manifold Edges; or "
                "Blender, 3D Print Toolbox > Make Manifold."});
    return;
  }
  piece.repairs.push_back(
      text("triangles cut out where more than two met in an edge: %zu, at %zu edges",
           piece.mesh.triangles.size() - cut.triangles.size(), edges));
  piece.mesh = std::move(cut);
}

void orient(Workpiece& piece) {
  const Oriented oriented = orient_consistently(piece.mesh);
  if (!oriented.is_two_sided) {
    piece.errors.push_back(
        {.value = "has no inside: following its triangles leads back to the other side",
         .fix = "MeshLab, Filters > Remeshing, Simplification and Reconstruction > Screened "
                "Poisson."});
  } else if (oriented.turned > 0) {
    piece.repairs.push_back(
        text("triangles turned round that faced the wrong way: %zu", oriented.turned));
  }
}

/// Keeps the one body and drops loose flakes; several bodies are an error.
void keep_one_body(Workpiece& piece) {
  const std::vector<int> piece_of = pieces_of(piece.mesh);
  std::vector<double> areas(piece_of.empty() ? 0
                                             : 1 + static_cast<std::size_t>(*std::max_element(
                                                       piece_of.begin(), piece_of.end())));
  for (std::size_t t = 0; t < piece_of.size(); ++t) {
    areas[static_cast<std::size_t>(piece_of[t])] += area_m2(piece.mesh, piece.mesh.triangles[t]);
  }
  if (areas.size() <= 1) return;
  const double largest = *std::max_element(areas.begin(), areas.end());
  const auto is_flake = [&](double area) { return area <= kLargestDroppedFraction * largest; };
  const auto flakes = static_cast<std::size_t>(std::count_if(areas.begin(), areas.end(), is_flake));
  if (areas.size() - flakes > 1) {
    piece.errors.push_back({.value = text("holds %zu separate bodies, or one with closed cavities",
                                          areas.size() - flakes),
                            .fix = "save one closed outer surface (MeshLab: Filters > Mesh Layer > "
                                   "Split in Connected Components)."});
  }
  if (flakes == 0) return;
  std::vector<bool> keep(piece_of.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    keep[t] = !is_flake(areas[static_cast<std::size_t>(piece_of[t])]);
  }
  keep_triangles(piece.mesh, keep);
  piece.repairs.push_back(text("loose pieces removed, each below %g %% of the body's surface: %zu",
                               100 * kLargestDroppedFraction, flakes));
}

void fill_holes(Workpiece& piece) {
  const std::vector<Hole> holes = find_holes(piece.mesh);
  if (holes.empty()) return;
  double area = 0;
  for (const Hole& hole : holes) area += hole.area;
  const double fraction = area / area_m2(piece.mesh);
  if (!(fraction <= kLargestFilledFraction)) {
    const auto largest = std::max_element(
        holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.area < b.area; });
    piece.errors.push_back(
        {.value = text("is not closed: its holes (%zu) are %.2g %% of its surface, more than the "
                       "%g %% that are filled unasked; the largest is about %s",
                       holes.size(), 100 * fraction, 100 * kLargestFilledFraction,
                       place_of(largest->middle).c_str()),
         .fix = "MeshLab, Filters > Remeshing, Simplification and Reconstruction > Close Holes; or "
                "Blender, Mesh > Clean Up > Fill Holes; or scan the hidden side too."});
    return;
  }
  for (const Hole& hole : holes) fill_hole(hole, piece.mesh);
  piece.repairs.push_back(
      text("holes filled: %zu, %.2g %% of the surface", holes.size(), 100 * fraction));
}

double signed_volume(const Mesh& mesh) {
  double volume = 0;
  const Vector point = bounds_of(mesh).center();
  for (const auto& triangle : mesh.triangles) {
    volume += area_normal(mesh, triangle).dot(corner(mesh, triangle, 0) - point) / 6;
  }
  return volume;
}

void turn_outside_out(Workpiece& piece) {
  if (signed_volume(piece.mesh) >= 0) return;
  for (auto& triangle : piece.mesh.triangles) std::swap(triangle[1], triangle[2]);
  piece.repairs.emplace_back("the surface was inside out and was turned round");
}

void check_volume(Workpiece& piece) {
  constexpr double kFlat = 1e-6;  // of the diagonal cubed
  const double diagonal = bounds_of(piece.mesh).diagonal().norm();
  if (signed_volume(piece.mesh) <= kFlat * diagonal * diagonal * diagonal) {
    piece.errors.push_back({.value = "encloses next to no volume",
                            .fix = "save a closed surface, not a sheet or a line."});
  }
}

void check_crossing(Workpiece& piece) {
  const SelfCrossing crossing = find_self_crossing(piece.mesh);
  if (crossing.triangles == 0) return;
  piece.errors.push_back(
      {.value = text("crosses itself: %zu triangles pass through others, the first about %s",
                     crossing.triangles, place_of(crossing.where).c_str()),
       .fix = "MeshLab, Filters > Selection > Select Self Intersecting Faces, delete them and "
              "close the holes; or Blender, Remesh modifier."});
}

void check_size(Workpiece& piece, const char* other_unit, double other_factor) {
  const double size = bounds_of(piece.mesh).sizes().maxCoeff();
  const auto is_grain = [](double size_m) {
    return size_m >= kSmallestGrain_m && size_m <= kLargestGrain_m;
  };
  if (is_grain(size)) return;
  const bool is_other = other_unit != nullptr && is_grain(size * other_factor);
  piece.errors.push_back(
      {.value = text("is %.4g mm long, and grains are from %g to %g mm", 1e3 * size,
                     1e3 * kSmallestGrain_m, 1e3 * kLargestGrain_m),
       .fix = is_other ? fmt::format("{} is probably {}.", base::field("its unit"), other_unit)
                       : "scale the scan to mm before saving it."});
}

Scan mended(Workpiece piece, const std::string& name) {
  weld_corners(piece);
  if (piece.mesh.triangles.empty()) {
    piece.errors.push_back(
        {.value = "all its triangles are without area", .fix = "save the scan again."});
  } else {
    remove_non_manifold_edges(piece);
    orient(piece);
    keep_one_body(piece);
    fill_holes(piece);
    turn_outside_out(piece);
    if (piece.errors.empty() && !is_watertight(piece.mesh)) {
      piece.errors.push_back({.value = "is not closed, and filling its holes did not close it",
                              .fix = "MeshLab, Filters > Remeshing, Simplification and "
                                     "Reconstruction > Screened Poisson."});
    }
    if (piece.errors.empty()) check_volume(piece);
    check_crossing(piece);
  }
  if (piece.errors.empty()) {
    return {.surface = std::move(piece.mesh), .repairs = std::move(piece.repairs)};
  }
  throw base::InputError(std::move(piece.errors)).in(name);
}

}  // namespace

Scan read_scan(const std::filesystem::path& file, ScanUnit unit) {
  const bool is_mm = unit == ScanUnit::millimetre;
  Workpiece piece{.mesh = read_mesh_file(file), .repairs = {}, .errors = {}};
  if (is_mm) {
    for (Vector& vertex : piece.mesh.vertices) vertex /= 1e3;
  }
  check_size(piece, is_mm ? "m" : "mm", is_mm ? 1e3 : 1e-3);
  return mended(std::move(piece), file.string());
}

Scan checked_surface(const Mesh& surface_m, const std::string& name) {
  Workpiece piece{.mesh = surface_m, .repairs = {}, .errors = {}};
  check_size(piece, nullptr, 1);
  return mended(std::move(piece), name);
}

}  // namespace repose::dem
