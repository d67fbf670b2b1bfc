#include "dem/shape/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <utility>

#include "dem/shape/hole_filling.h"
#include "dem/shape/mass_properties.h"
#include "dem/shape/mesh_edges.h"
#include "dem/shape/mesh_file.h"
#include "dem/shape/mesh_measure.h"
#include "dem/shape/mesh_orientation.h"
#include "dem/shape/self_crossing.h"
#include "dem/shape/weld.h"

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

/// A surface on the bench: what was mended, and what cannot be.
struct Bench {
  Mesh mesh;
  std::vector<std::string> repairs;
  std::vector<std::string> faults;
};

void keep_triangles(Mesh& mesh, const std::vector<bool>& keep) {
  Mesh kept{.vertices = std::move(mesh.vertices), .triangles = {}};
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) kept.triangles.push_back(mesh.triangles[t]);
  }
  mesh = without_loose_corners(kept);
}

void weld_corners(Bench& bench) {
  Welded welded = weld(bench.mesh);
  bench.mesh = std::move(welded.mesh);
  if (welded.collapsed > 0) {
    bench.repairs.push_back(text("triangles without area removed: %zu", welded.collapsed));
  }
  if (welded.duplicates > 0) {
    bench.repairs.push_back(
        text("triangles removed that were there twice: %zu", welded.duplicates));
  }
}

/// Where more than two triangles meet in an edge, the surface has no one inside: cut them out, the
/// hole is filled like any other.
void cut_out_fins(Bench& bench) {
  std::vector<bool> keep(bench.mesh.triangles.size(), true);
  const std::vector<EdgeUse> uses = edge_uses(bench.mesh);
  std::size_t edges = 0;
  for_each_edge(uses, [&](std::span<const EdgeUse> edge) {
    if (edge.size() <= 2) return;
    ++edges;
    for (const EdgeUse& use : edge) keep[static_cast<std::size_t>(use.triangle)] = false;
  });
  if (edges == 0) return;
  Mesh cut = bench.mesh;
  keep_triangles(cut, keep);
  const double share = 1 - area_m2(cut) / area_m2(bench.mesh);
  if (share > kLargestDroppedShare) {
    bench.faults.push_back(text(
        "more than two triangles meet in %zu edges, over %.2g %% of the surface. Fix: MeshLab, "
        "Filters > Cleaning and Repairing > Repair non Manifold Edges; or Blender, 3D Print "
        "Toolbox > Make Manifold.",
        edges, 100 * share));
    return;
  }
  bench.repairs.push_back(
      text("triangles cut out where more than two met in an edge: %zu, at %zu edges",
           bench.mesh.triangles.size() - cut.triangles.size(), edges));
  bench.mesh = std::move(cut);
}

void orient(Bench& bench) {
  const Oriented oriented = orient_consistently(bench.mesh);
  if (!oriented.is_two_sided) {
    bench.faults.push_back(
        "has no inside: following its triangles leads back to the other side. Fix: MeshLab, "
        "Filters > Remeshing, Simplification and Reconstruction > Screened Poisson.");
  } else if (oriented.turned > 0) {
    bench.repairs.push_back(
        text("triangles turned round that faced the wrong way: %zu", oriented.turned));
  }
}

/// Keeps the one body; loose flakes go, several bodies are not ours to choose from.
void keep_one_body(Bench& bench) {
  const std::vector<int> piece_of = pieces_of(bench.mesh);
  std::vector<double> areas(piece_of.empty() ? 0
                                             : 1 + static_cast<std::size_t>(*std::max_element(
                                                       piece_of.begin(), piece_of.end())));
  for (std::size_t t = 0; t < piece_of.size(); ++t) {
    areas[static_cast<std::size_t>(piece_of[t])] += area_m2(bench.mesh, bench.mesh.triangles[t]);
  }
  if (areas.size() <= 1) return;
  const double largest = *std::max_element(areas.begin(), areas.end());
  const auto is_flake = [&](double area) { return area <= kLargestDroppedShare * largest; };
  const auto flakes = static_cast<std::size_t>(std::count_if(areas.begin(), areas.end(), is_flake));
  if (areas.size() - flakes > 1) {
    bench.faults.push_back(
        text("holds %zu separate bodies, or one with closed cavities. Fix: save one closed outer "
             "surface (MeshLab: Filters > Mesh Layer > Split in Connected Components).",
             areas.size() - flakes));
  }
  if (flakes == 0) return;
  std::vector<bool> keep(piece_of.size());
  for (std::size_t t = 0; t < keep.size(); ++t) {
    keep[t] = !is_flake(areas[static_cast<std::size_t>(piece_of[t])]);
  }
  keep_triangles(bench.mesh, keep);
  bench.repairs.push_back(text("loose pieces removed, each below %g %% of the body's surface: %zu",
                               100 * kLargestDroppedShare, flakes));
}

void fill_holes(Bench& bench) {
  const std::vector<Hole> holes = find_holes(bench.mesh);
  if (holes.empty()) return;
  double area = 0;
  for (const Hole& hole : holes) area += hole.area;
  const double share = area / area_m2(bench.mesh);
  if (!(share <= kLargestFilledShare)) {
    const auto largest = std::max_element(
        holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.area < b.area; });
    bench.faults.push_back(text(
        "is not closed: its holes (%zu) are %.2g %% of its surface, more than the %g %% that are "
        "filled unasked; the largest is about %s. Fix: MeshLab, Filters > Remeshing, "
        "Simplification and Reconstruction > Close Holes; or Blender, Mesh > Clean Up > Fill "
        "Holes; or scan the hidden side too.",
        holes.size(), 100 * share, 100 * kLargestFilledShare, place_of(largest->middle).c_str()));
    return;
  }
  for (const Hole& hole : holes) fill_hole(hole, bench.mesh);
  bench.repairs.push_back(
      text("holes filled: %zu, %.2g %% of the surface", holes.size(), 100 * share));
}

double signed_volume(const Mesh& mesh) {
  double volume = 0;
  const Vector point = bounds_of(mesh).center();
  for (const auto& triangle : mesh.triangles) {
    volume += area_normal(mesh, triangle).dot(corner(mesh, triangle, 0) - point) / 6;
  }
  return volume;
}

void turn_outside_out(Bench& bench) {
  if (signed_volume(bench.mesh) >= 0) return;
  for (auto& triangle : bench.mesh.triangles) std::swap(triangle[1], triangle[2]);
  bench.repairs.emplace_back("the surface was inside out and was turned round");
}

void check_volume(Bench& bench) {
  constexpr double kFlat = 1e-6;  // of the cube over the diagonal
  const double diagonal = bounds_of(bench.mesh).diagonal().norm();
  if (signed_volume(bench.mesh) <= kFlat * diagonal * diagonal * diagonal) {
    bench.faults.emplace_back(
        "encloses next to no volume. Fix: save a closed surface, not a sheet or a line.");
  }
}

void check_crossing(Bench& bench) {
  const SelfCrossing crossing = find_self_crossing(bench.mesh);
  if (crossing.triangles == 0) return;
  bench.faults.push_back(
      text("crosses itself: %zu triangles pass through others, the first about %s. Fix: MeshLab, "
           "Filters > Selection > Select Self Intersecting Faces, delete them and close the holes; "
           "or Blender, Remesh modifier.",
           crossing.triangles, place_of(crossing.where).c_str()));
}

void check_size(Bench& bench, const char* other_unit, double other_factor) {
  const double size = bounds_of(bench.mesh).sizes().maxCoeff();
  const auto is_grain = [](double size_m) {
    return size_m >= kSmallestGrain_m && size_m <= kLargestGrain_m;
  };
  if (is_grain(size)) return;
  const bool is_other = other_unit != nullptr && is_grain(size * other_factor);
  bench.faults.push_back(text("is %.4g mm long, and grains are from %g to %g mm. Fix: ", 1e3 * size,
                              1e3 * kSmallestGrain_m, 1e3 * kLargestGrain_m) +
                         (is_other
                              ? text("its unit is probably the other one, --unit %s.", other_unit)
                              : std::string("scale the scan to mm before saving it.")));
}

Scan mended(Bench bench, const std::string& name) {
  weld_corners(bench);
  if (bench.mesh.triangles.empty()) {
    bench.faults.emplace_back("all its triangles are without area. Fix: save the scan again.");
  } else {
    cut_out_fins(bench);
    orient(bench);
    keep_one_body(bench);
    fill_holes(bench);
    turn_outside_out(bench);
    if (bench.faults.empty() && !is_watertight(bench.mesh)) {
      bench.faults.emplace_back(
          "is not closed, and filling its holes did not close it. Fix: MeshLab, Filters > "
          "Remeshing, Simplification and Reconstruction > Screened Poisson.");
    }
    if (bench.faults.empty()) check_volume(bench);
    check_crossing(bench);
  }
  if (bench.faults.empty()) {
    return {.surface = std::move(bench.mesh), .repairs = std::move(bench.repairs)};
  }
  std::string faults;
  for (const std::string& fault : bench.faults) {
    faults += (faults.empty() ? "" : "\n") + name + ": " + fault;
  }
  throw std::invalid_argument(faults);
}

}  // namespace

Scan read_scan(const std::filesystem::path& file, ScanUnit unit) {
  const bool is_mm = unit == ScanUnit::millimetre;
  Bench bench{.mesh = read_mesh_file(file), .repairs = {}, .faults = {}};
  if (is_mm) {
    for (Vector& vertex : bench.mesh.vertices) vertex /= 1e3;
  }
  check_size(bench, is_mm ? "m" : "mm", is_mm ? 1e3 : 1e-3);
  return mended(std::move(bench), file.string());
}

Scan checked_surface(const Mesh& surface_m, const std::string& name) {
  Bench bench{.mesh = surface_m, .repairs = {}, .faults = {}};
  check_size(bench, nullptr, 1);
  return mended(std::move(bench), name);
}

}  // namespace repose::dem
