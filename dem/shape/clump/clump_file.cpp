#include "dem/shape/clump/clump_file.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/scan/scan.h"

namespace repose::dem {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "repose clump";
constexpr int kVersion = 1;

/// The errors by key, for both writing and reading.
constexpr std::array<std::pair<const char*, double ClumpErrors::*>, 7> kErrors = {{
    {"volume_error", &ClumpErrors::volume_error},
    {"volume_difference", &ClumpErrors::volume_difference},
    {"inertia_error", &ClumpErrors::inertia_error},
    {"surface_error_mean_m", &ClumpErrors::surface_error_mean_m},
    {"surface_error_p95_m", &ClumpErrors::surface_error_p95_m},
    {"sticks_out_m", &ClumpErrors::sticks_out_m},
    {"falls_short_m", &ClumpErrors::falls_short_m},
}};

Json number_json(double number) {
  if (!std::isfinite(number)) {
    throw base::InputError({.where = "clump",
                            .value = "holds a number that is not finite and cannot be written",
                            .fix = "build the clump from a closed surface."});
  }
  return number;
}

Json vector_json(const Vector& vector) {
  return {number_json(vector.x()), number_json(vector.y()), number_json(vector.z())};
}

/// Takes values from a file and collects errors instead of stopping.
class Reader {
 public:
  explicit Reader(std::string name) : name_(std::move(name)) {}

  /// Keeps the first fifty errors.
  void error(const std::string& where, base::Fault fault) {
    fault.where = name_ + ": " + where;
    if (errors_.size() < kMaxErrors) errors_.push_back(std::move(fault));
  }

  /// The value of a key; null with an error if missing or `object` is not an object.
  const Json& value(const Json& object, const std::string& key) {
    static const Json kNull;
    if (object.is_object() && object.contains(key)) return object[key];
    error(key, {.value = "is missing", .fix = "write the file again with repose shape."});
    return kNull;
  }

  double number(const Json& json, const std::string& where) {
    if (json.is_number()) return json.get<double>();
    error(where, {.value = "is " + shown(json) + ", and",
                  .rule = "must be a number",
                  .fix = "give a finite number."});
    return 1;
  }

  double positive(const Json& json, const std::string& where) {
    const double read = number(json, where);
    if (!(read > 0))
      error(where, {.value = "is " + shown(json) + ", and",
                    .rule = "must be above 0",
                    .fix = "give its size."});
    return read;
  }

  Vector vector(const Json& json, const std::string& where) {
    if (!is_three(json, where)) return Vector::Ones();
    return {number(json[0], where), number(json[1], where), number(json[2], where)};
  }

  std::array<int, 3> corners(const Json& json, const std::string& where, std::size_t vertices) {
    std::array<int, 3> read{};
    if (!is_three(json, where)) return read;
    for (std::size_t i = 0; i < 3; ++i) {
      const bool is_index = json[i].is_number_integer() && json[i] >= 0 && json[i] < vertices;
      if (is_index) {
        read[i] = json[i].get<int>();
      } else {
        error(where, {.value = fmt::format("names corner {} of {}", shown(json[i]), vertices),
                      .fix = "count corners from 0."});
      }
    }
    return read;
  }

  std::string string(const Json& json, const std::string& where) {
    if (json.is_string()) return json.get<std::string>();
    error(where, {.value = "is " + shown(json) + ", and",
                  .rule = "must be text",
                  .fix = "put it in quotes."});
    return {};
  }

  /// A list, or an empty one.
  const Json& list(const Json& json, const std::string& where) {
    static const Json kEmpty = Json::array();
    if (json.is_array()) return json;
    error(where, {.value = "is " + shown(json) + ", and",
                  .rule = "must be a list",
                  .fix = "put it in brackets."});
    return kEmpty;
  }

  bool has_errors() const { return !errors_.empty(); }

  void throw_errors() const {
    if (!errors_.empty()) throw base::InputError(errors_);
  }

 private:
  static constexpr std::size_t kMaxErrors = 50;

  static std::string shown(const Json& json) {
    constexpr std::size_t kLongest = 40;
    const std::string text = json.dump(-1, ' ', true, Json::error_handler_t::replace);
    return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
  }

  bool is_three(const Json& json, const std::string& where) {
    if (json.is_array() && json.size() == 3) return true;
    error(where, {.value = "is " + shown(json) + ", and",
                  .rule = "must be three numbers",
                  .fix = "[x, y, z]."});
    return false;
  }

  std::string name_;
  std::vector<base::Fault> errors_;
};

std::string item(const char* list, std::size_t index) {
  return std::string(list) + '[' + std::to_string(index) + ']';
}

void read_spheres(const Json& root, Reader& reader, ClumpShape& shape) {
  const Json& spheres = reader.list(reader.value(root, "spheres"), "spheres");
  if (spheres.empty())
    reader.error("spheres", {.value = "there are none", .fix = "give at least one."});
  for (std::size_t i = 0; i < spheres.size(); ++i) {
    const std::string where = item("spheres", i);
    shape.spheres.push_back(
        {.centre = reader.vector(reader.value(spheres[i], "centre_m"), where + ".centre_m"),
         .radius = reader.positive(reader.value(spheres[i], "radius_m"), where + ".radius_m")});
  }
}

void check_hangs_together(const ClumpShape& shape, Reader& reader) {
  const int groups = sphere_groups(shape.spheres);
  if (groups == 1) return;
  reader.error("spheres",
               {.value = fmt::format("they fall into {} groups that do not touch each other; other "
                                     "grains could pass between them",
                                     groups),
                .fix = "correct the sphere that was moved, or fill the body with more spheres."});
}

void read_gyration(const Json& root, Reader& reader, ClumpShape& shape) {
  shape.gyration_m2 = reader.vector(reader.value(root, "gyration_m2"), "gyration_m2");
  constexpr double kRounding = 1e-9;
  const double sum = shape.gyration_m2.sum(), largest = shape.gyration_m2.maxCoeff();
  if (!(shape.gyration_m2.minCoeff() > 0) || largest > (sum - largest) * (1 + kRounding)) {
    reader.error("gyration_m2", {.value = "no body has these principal moments: each must be above "
                                          "0 and none larger than the other two together",
                                 .fix = "write the file again with repose shape."});
  }
}

/// Lengths given in mm instead of m are valid numbers, but give grains a thousand times too large.
void check_sizes(const ClumpShape& shape, const std::string& name) {
  const double reach = shape.reach_m();
  if (!(2 * reach >= kSmallestGrain_m && reach <= kLargestGrain_m)) {
    throw base::InputError(
        {.where = name,
         .value = fmt::format("spheres: they reach {:.4g} m from the centre", reach),
         .rule =
             fmt::format("grains are from {:g} to {:g} m long", kSmallestGrain_m, kLargestGrain_m),
         .fix = "the file counts in m; divide lengths in mm by 1000."});
  }
  // The body may be slender and longer than its spheres, but must plausibly be the same body.
  constexpr double kFourThirdsPi = 4.0 / 3 * std::numbers::pi;
  const double ball_m3 = kFourThirdsPi * reach * reach * reach;
  const double moments = shape.gyration_m2.sum() / (reach * reach);
  const bool is_one_body = shape.volume_m3 > 1e-7 * ball_m3 && shape.volume_m3 < 4 * ball_m3 &&
                           moments > 1e-3 && moments < 20;
  if (is_one_body) return;
  throw base::InputError(
      {.where = name,
       .value = fmt::format(
           "spheres: they reach {:.4g} m, which does not fit to volume_m3 = {:.4g} and gyration_m2",
           reach, shape.volume_m3),
       .rule = "lengths in m, volumes in m^3, moments in m^2",
       .fix = "write the file again with repose shape."});
}

void read_surface(const Json& root, Reader& reader, Mesh& surface) {
  const Json& json = reader.value(root, "surface");
  const Json& vertices = reader.list(reader.value(json, "vertices_m"), "surface.vertices_m");
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    surface.vertices.push_back(reader.vector(vertices[i], item("surface.vertices_m", i)));
  }
  const Json& triangles = reader.list(reader.value(json, "triangles"), "surface.triangles");
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    surface.triangles.push_back(
        reader.corners(triangles[i], item("surface.triangles", i), vertices.size()));
  }
}

}  // namespace

std::string warning_of_shape(const ClumpFile& clump) {
  if (!(clump.errors.volume_error >= kMuchMissed)) return {};
  const std::size_t spheres = clump.shape.spheres.size();
  return fmt::format(
      "{}: {} {} not its shape: {:.0f} % of its volume is missing or sticks out (volume error), "
      "where up to {:.0f} % may pass. It rolls, tips, rebounds and packs as another grain. Fix: "
      "more spheres, or a volume error of 5 %.",
      clump.source, spheres, spheres == 1 ? "sphere is" : "spheres are",
      100 * clump.errors.volume_error, 100 * kMuchMissed);
}

std::string clump_json(const ClumpFile& clump) {
  Json spheres = Json::array(), errors = Json::object();
  for (const ClumpSphere& sphere : clump.shape.spheres) {
    spheres.push_back(
        {{"centre_m", vector_json(sphere.centre)}, {"radius_m", number_json(sphere.radius)}});
  }
  for (const auto& [key, member] : kErrors) errors[key] = number_json(clump.errors.*member);
  Json vertices = Json::array(), triangles = Json::array();
  for (const Vector& vertex : clump.shape.surface.vertices) vertices.push_back(vector_json(vertex));
  for (const auto& triangle : clump.shape.surface.triangles) triangles.push_back(triangle);
  const Json json{{"format", kFormat},
                  {"version", kVersion},
                  {"source", clump.source},
                  {"repairs", clump.repairs},
                  {"volume_m3", number_json(clump.shape.volume_m3)},
                  {"gyration_m2", vector_json(clump.shape.gyration_m2)},
                  {"spheres", spheres},
                  {"errors", errors},
                  {"surface", {{"vertices_m", vertices}, {"triangles", triangles}}}};
  // File names need not be UTF-8, JSON must be.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

ClumpFile parse_clump_json(const std::string& text, const std::string& name) {
  Json root;
  try {
    root = Json::parse(text);
  } catch (const Json::exception& error) {
    throw base::InputError({.where = name,
                            .value = fmt::format("is not JSON ({})", error.what()),
                            .fix = "write it again with repose shape."});
  }
  if (!root.is_object() || !root.contains("format") || root["format"] != kFormat) {
    throw base::InputError(
        {.where = name, .value = "is not a clump file", .fix = "make one with repose shape."});
  }
  if (!root.contains("version") || root["version"] != kVersion) {
    throw base::InputError({.where = name,
                            .value = fmt::format("is of another version than {}", kVersion),
                            .fix = "write it again with this program's repose shape."});
  }
  Reader reader(name);
  ClumpFile clump;
  clump.source = reader.string(reader.value(root, "source"), "source");
  for (const Json& repair : reader.list(reader.value(root, "repairs"), "repairs")) {
    clump.repairs.push_back(reader.string(repair, "repairs"));
  }
  clump.shape.volume_m3 = reader.positive(reader.value(root, "volume_m3"), "volume_m3");
  read_gyration(root, reader, clump.shape);
  read_spheres(root, reader, clump.shape);
  const Json& errors = reader.value(root, "errors");
  for (const auto& [key, member] : kErrors) {
    clump.errors.*member = reader.number(reader.value(errors, key), std::string("errors.") + key);
  }
  read_surface(root, reader, clump.shape.surface);
  if (!reader.has_errors()) check_hangs_together(clump.shape, reader);
  reader.throw_errors();
  return clump;
}

ClumpFile read_clump_file(const std::filesystem::path& file) {
  ClumpFile clump = parse_clump_json(base::read_whole_file(file), file.string());
  check_sizes(clump.shape, file.string());
  return clump;
}

}  // namespace repose::dem
