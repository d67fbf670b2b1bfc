#include "cli/shape/shape_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/units.h"
#include "cli/common/table.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMm2PerM2 = 1e6;
constexpr double kMm3PerM3 = 1e9;
constexpr double kGramPerKg = 1e3;

/// Extents along the principal axes.
dem::Vector size_mm(const dem::ClumpShape& shape) {
  dem::Vector low = shape.surface.vertices.front(), high = low;
  for (const dem::Vector& vertex : shape.surface.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
  }
  return kMmPerM * (high - low);
}

double mass_g(const dem::ClumpShape& shape, double density_kg_m3) {
  return kGramPerKg * density_kg_m3 * shape.volume_m3;
}

dem::Vector gyration_mm2(const dem::ClumpShape& shape) { return kMm2PerM2 * shape.gyration_m2; }

void add_mass(const dem::ClumpShape& shape, std::optional<double> density_kg_m3, Table& table) {
  const dem::Vector gyration = gyration_mm2(shape);
  if (!density_kg_m3) {
    table.add_row({"mass", fmt::format("{} (needs --density-kg-m3)", kNothing)});
    table.add_row({"moments", fmt::format("{:.4g}, {:.4g}, {:.4g} mm² times the mass", gyration.x(),
                                          gyration.y(), gyration.z())});
    return;
  }
  const double mass = mass_g(shape, *density_kg_m3);
  const dem::Vector moments = mass * gyration;
  table.add_row({"mass", fmt::format("{:.4g} g at {:g} kg/m³", mass, *density_kg_m3)});
  table.add_row({"moments", fmt::format("{:.4g}, {:.4g}, {:.4g} g mm²", moments.x(), moments.y(),
                                        moments.z())});
}

void add_spheres(const dem::ClumpFile& clump, Table& table) {
  const auto& spheres = clump.shape.spheres;
  const dem::ClumpErrors& errors = clump.errors;
  const auto [smallest, largest] =
      std::minmax_element(spheres.begin(), spheres.end(),
                          [](const auto& a, const auto& b) { return a.radius < b.radius; });
  table.add_row({"spheres", fmt::format("{}, radii {:.4g} … {:.4g} mm", spheres.size(),
                                        kMmPerM * smallest->radius, kMmPerM * largest->radius)});
  table.add_row(
      {"volume error", fmt::format("{:.2f} % missing or sticking out; in all {:+.2f} %",
                                   100 * errors.volume_error, 100 * errors.volume_difference)});
  table.add_row({"inertia error",
                 fmt::format("{:.2f} % of the spheres alone (a simulation uses the surface's own)",
                             100 * errors.inertia_error)});
  table.add_row({"surface error", fmt::format("{:.3g} mm on average, {:.3g} mm for 95 %",
                                              kMmPerM * errors.surface_error_mean_m,
                                              kMmPerM * errors.surface_error_p95_m)});
  table.add_row(
      {"farthest", fmt::format("{:.3g} mm outside the surface, {:.3g} mm inside it",
                               kMmPerM * errors.sticks_out_m, kMmPerM * errors.falls_short_m)});
}

Json vector_json(const dem::Vector& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json spheres_json(const dem::ClumpShape& shape) {
  Json spheres = Json::array();
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    spheres.push_back({{"x_mm", kMmPerM * sphere.centre.x()},
                       {"y_mm", kMmPerM * sphere.centre.y()},
                       {"z_mm", kMmPerM * sphere.centre.z()},
                       {"r_mm", kMmPerM * sphere.radius}});
  }
  return spheres;
}

Json warnings_json(const dem::ClumpFile& clump) {
  Json warnings = Json::array();
  const std::string shape = dem::warning_of_shape(clump);
  if (!shape.empty()) warnings.push_back({{"code", "shape"}, {"message", shape}});
  return warnings;
}

}  // namespace

std::string shape_table(const dem::ClumpFile& clump, std::optional<double> density_kg_m3,
                        int columns) {
  const dem::ClumpShape& shape = clump.shape;
  const dem::Vector size = size_mm(shape);
  Table table({{.heading = ""}, {.heading = ""}});
  table.add_row({"grain", clump.source});
  table.add_row({"size", fmt::format("{:.4g} × {:.4g} × {:.4g} mm along the principal axes",
                                     size.x(), size.y(), size.z())});
  table.add_row({"surface", fmt::format("{} triangles, closed", shape.surface.triangles.size())});
  table.add_row({"volume", fmt::format("{:.5g} mm³", kMm3PerM3 * shape.volume_m3)});
  add_mass(shape, density_kg_m3, table);
  add_spheres(clump, table);
  for (const std::string& repair : clump.repairs) table.add_row({"repaired", repair});
  return table.text(columns);
}

std::string shape_json(const dem::ClumpFile& clump, std::optional<double> density_kg_m3) {
  const dem::ClumpShape& shape = clump.shape;
  const dem::ClumpErrors& errors = clump.errors;
  Json mass = nullptr, moments = nullptr, density = nullptr;
  if (density_kg_m3) {
    density = *density_kg_m3;
    mass = mass_g(shape, *density_kg_m3);
    moments = vector_json(mass_g(shape, *density_kg_m3) * gyration_mm2(shape));
  }
  const Json json{{"source", clump.source},
                  {"size_mm", vector_json(size_mm(shape))},
                  {"triangles", shape.surface.triangles.size()},
                  {"volume_mm3", kMm3PerM3 * shape.volume_m3},
                  {"density_kg_m3", density},
                  {"mass_g", mass},
                  {"moments_g_mm2", moments},
                  {"gyration_mm2", vector_json(gyration_mm2(shape))},
                  {"spheres", spheres_json(shape)},
                  {"volume_error", errors.volume_error},
                  {"volume_difference", errors.volume_difference},
                  {"inertia_error", errors.inertia_error},
                  {"surface_error_mean_mm", kMmPerM * errors.surface_error_mean_m},
                  {"surface_error_p95_mm", kMmPerM * errors.surface_error_p95_m},
                  {"sticks_out_mm", kMmPerM * errors.sticks_out_m},
                  {"falls_short_mm", kMmPerM * errors.falls_short_m},
                  {"repairs", clump.repairs},
                  {"warnings", warnings_json(clump)}};
  constexpr int kIndent = 2;
  // File names need not be UTF-8, JSON must be.
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
