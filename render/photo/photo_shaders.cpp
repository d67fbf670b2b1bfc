#include "render/photo/photo_shaders.h"

#include <fmt/format.h>

namespace repose::render::shaders {
namespace {

/// Noise that is the same on every driver: interpolated integer hashes.
const char* const kNoise = R"(
uint mixed(uint h) {
  h ^= h >> 16; h *= 0x7feb352du; h ^= h >> 15; h *= 0x846ca68bu; return h ^ (h >> 16);
}
float lattice(ivec3 p) {
  uint h = mixed(uint(p.x) ^ mixed(uint(p.y) ^ mixed(uint(p.z))));
  return float(h >> 8) * (1.0 / 16777216.0);
}
// Between 0 and 1, mean one half.
float noise(vec3 p) {
  ivec3 i = ivec3(floor(p));
  vec3 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  vec4 a = vec4(lattice(i), lattice(i + ivec3(0, 1, 0)), lattice(i + ivec3(0, 0, 1)),
                lattice(i + ivec3(0, 1, 1)));
  vec4 b = vec4(lattice(i + ivec3(1, 0, 0)), lattice(i + ivec3(1, 1, 0)),
                lattice(i + ivec3(1, 0, 1)), lattice(i + ivec3(1, 1, 1)));
  vec4 x = mix(a, b, f.x);
  vec2 y = mix(x.xz, x.yw, f.y);
  return mix(y.x, y.y, f.z);
}
)";

/// Light that reaches a point: lamp and surroundings, each with shadows, and the table's
/// reflection.
const char* const kLighting = R"(
uniform sampler2DShadow key_map, sky_map;
uniform mat3 key_axes, sky_axes;    // right, down, away from the light
uniform float map_radius;           // what the maps show
uniform float key_share;
uniform float shadow_shift;         // metres along the normal: a face does not shade itself

float seen(sampler2DShadow map, mat3 light_axes, vec3 point, vec3 normal) {
  vec3 q = light_axes * (point + shadow_shift * normal) / map_radius;
  if (any(greaterThan(abs(q.xy), vec2(0.99)))) return 1.0;
  return texture(map, vec3(0.5 * q.xy + 0.5, 0.5 * q.z * 0.25 + 0.5));
}
vec3 to_light(mat3 light_axes) { return -vec3(light_axes[0].z, light_axes[1].z, light_axes[2].z); }

// x: lamp's, y: of all around, each as a fraction of what white paper facing it gets.
vec2 lit(vec3 point, vec3 normal) {
  float key = dot(normal, to_light(key_axes));
  float sky = dot(normal, to_light(sky_axes));
  return vec2(key > 0.0 ? key * seen(key_map, key_axes, point, normal) : 0.0,
              sky > 0.0 ? 2.0 * sky * seen(sky_map, sky_axes, point, normal) : 0.0);
}
vec3 shaded(vec3 albedo, vec3 point, vec3 normal, vec2 light, float floor_z) {
  float bounce = 0.06 * (0.6 - 0.4 * normal.z);
  float around = (1.0 - key_share) * (light.y + bounce);
  return albedo * (1.75 * key_share * light.x * vec3(1.03, 1.0, 0.95) +
                   1.5 * around * vec3(0.97, 1.0, 1.05));
}
)";

const char* const kBodyInputs = R"(#version 330 core
in vec3 point, face, own;
flat in vec4 luck;
out vec4 colour;
uniform vec3 lens;            // on the stage
uniform vec3 into_picture;
uniform bool has_lens;
uniform bool is_shell;
uniform vec3 base, spot;      // linear
uniform vec3 blunt_end;       // m
uniform float spread, pattern, gloss, floor_z;
)";

const char* const kBodyMain = R"(
vec3 shell() {
  float reach = length(blunt_end);
  vec3 axis = blunt_end / reach;
  float along = dot(own, axis) / reach;                 // 1 at the blunt end, below -1 at the tip
  vec3 across = own / reach - along * axis;
  vec3 a = abs(axis.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
  vec3 u = normalize(cross(axis, a)), v = cross(axis, u);
  float r = length(across);
  vec2 turn = vec2(dot(across, u), dot(across, v)) / max(r, 1e-3);
  vec3 own_place = 40.0 * luck.xyz;
  // Streaks from end to end, mottles, and a fine grain.
  float streaks = noise(vec3(7.0 * turn, 1.3 * along) + own_place) +
                  0.5 * noise(vec3(17.0 * turn, 1.7 * along) + own_place.yzx) +
                  0.25 * noise(vec3(37.0 * turn, 3.0 * along) + own_place.zxy) - 0.875;
  float mottles = noise(own / reach * 3.0 + own_place.zyx) - 0.5;
  float tone = 1.0 + spread * 3.46 * (luck.x - 0.5) +
               pattern * (0.55 * streaks + 0.30 * mottles - 0.16 * smoothstep(0.5, -1.2, along));
  vec3 tint = mix(vec3(1.0), vec3(1.07, 0.98, 0.88), 2.0 * (luck.y - 0.5));
  vec3 albedo = base * tint * max(tone, 0.2);
  float edge = 0.70 + 0.05 * (luck.z - 0.5) + 0.10 * (noise(vec3(3.0 * turn, 1.0) + own_place) - 0.5);
  float cap = pattern * smoothstep(edge - 0.02, edge + 0.03, along);
  float grit = noise(own / reach * 22.0 + own_place) * 0.35 + 0.8;
  albedo = mix(albedo, spot * tint * grit, 0.9 * cap);
  // A darker seam where the husk sat.
  float seam = exp(-pow((along - edge) / 0.03, 2.0));
  return albedo * (1.0 - 0.30 * pattern * seam);
}
vec3 metal() {
  vec2 p = point.xy * 1e3;  // brushed along x
  float brushed = noise(vec3(0.06 * p.x, 2.6 * p.y, 3.0)) + 0.6 * noise(vec3(0.02 * p.x, 0.9 * p.y, 7.0));
  float stains = noise(vec3(0.012 * p, 11.0)) + 0.5 * noise(vec3(0.05 * p, 5.0));
  return base * (0.86 + 0.10 * brushed + 0.08 * stains);
}
void main() {
  vec3 normal = normalize(face);
  vec3 view = has_lens ? normalize(lens - point) : -into_picture;
  if (dot(normal, view) < 0.0 && !is_shell) normal = -normal;
  vec3 albedo = is_shell ? shell() : metal();
  vec2 light = lit(point, normal);
  vec3 radiance = shaded(albedo, point, normal, light, floor_z);
  // Schlick's fresnel and a Blinn-Phong lobe, normalised.
  vec3 half_way = normalize(view + to_light(key_axes));
  float power = mix(8.0, 60.0, gloss);
  float lobe = (power + 8.0) / 25.1 * pow(max(dot(normal, half_way), 0.0), power);
  float fresnel = 0.04 + 0.96 * pow(1.0 - max(dot(view, half_way), 0.0), 5.0);
  float rim = pow(1.0 - max(dot(normal, view), 0.0), 4.0);
  radiance += 8.0 * gloss * key_share * light.x * fresnel * lobe;
  radiance += gloss * (1.0 - key_share) * light.y * (0.03 + 0.12 * rim);
  colour = vec4(radiance, 1.0);
}
)";

const char* const kRoomInputs = R"(#version 330 core
in vec2 place;
out vec4 colour;
uniform mat3 axes;
uniform vec3 eye;
uniform bool is_perspective;
uniform vec2 scale, shift, aperture, depth_map;
uniform float focus;
uniform vec3 distortion;
uniform vec3 into_room;      // level, away from the camera
uniform float floor_z, front, back, height;
uniform float before;         // how far before the scene parallel rays begin
uniform vec3 table, backdrop;
)";

const char* const kRoomMain = R"(
float undistorted(float seen_r) {
  float r = seen_r;
  for (int k = 0; k < 12; ++k) {
    float inside = min(r, distortion.z), r2 = inside * inside;
    float slope = 1.0 + 3.0 * distortion.x * r2 + 5.0 * distortion.y * r2 * r2;
    float there = inside * (1.0 + distortion.x * r2 + distortion.y * r2 * r2) + (r - inside) * slope;
    r -= (there - seen_r) / slope;
  }
  return r;
}
vec3 table_albedo(vec2 p) {
  float fine = noise(vec3(p * 900.0, 1.0)), coarse = noise(vec3(p * 35.0, 2.0));
  float wide = noise(vec3(p * 6.0, 4.0));
  return table * (0.80 + 0.18 * fine + 0.14 * coarse + 0.12 * wide);
}
vec3 paper(vec3 p) {
  vec3 right = vec3(into_room.y, -into_room.x, 0.0);
  vec2 q = vec2(dot(p, right), p.z - floor_z);
  float fibres = noise(vec3(q * 260.0, 3.0)), wide = noise(vec3(q * 3.0, 9.0));
  float fall = 1.0 - 0.22 * smoothstep(0.0, height, q.y) + 0.05 * dot(q, vec2(-0.5, 0.2)) / height;
  return backdrop * (0.97 + 0.04 * fibres + 0.05 * (wide - 0.5)) * fall;
}
void main() {
  vec2 q = (place - shift) / scale;
  vec3 start, way;  // in the camera's axes
  if (is_perspective) {
    float r = length(q);
    if (distortion.xy != vec2(0.0) && r > 0.0) q *= undistorted(r) / r;
    start = vec3(aperture * focus, 0.0);
    way = vec3(q - aperture, 1.0);
  } else {
    start = vec3(q, -before);
    way = vec3(0.0, 0.0, 1.0);
  }
  start = transpose(axes) * start + eye;
  way = transpose(axes) * way;
  float away = dot(into_room, way), here = dot(into_room, start);
  float t_back = away > 0.0 ? (back - here) / away : 1e9;
  float t_front = away > 0.0 && here < front ? (front - here) / away : 1e9;
  float t_floor = (floor_z - start.z) / way.z;
  float t = t_back;
  vec3 point = start + t_back * way, normal = -into_room, albedo = backdrop;
  float z_front = start.z + t_front * way.z;
  if (t_front < 1e8 && z_front < floor_z) {          // the table's front edge
    t = t_front;
    point = start + t * way;
    albedo = 0.75 * table_albedo(point.xz);
  } else if (t_floor > 0.0 && t_floor < t_back && abs(way.z) > 1e-7 && start.z > floor_z) {
    t = t_floor;
    point = start + t * way;
    normal = vec3(0.0, 0.0, 1.0);
    albedo = table_albedo(point.xy);
  } else {
    albedo = paper(point);
  }
  if (t == t_back) {  // far from the scene: no shadow falls there, and it has lights of its own
    colour = vec4(albedo * 1.1, 1.0);
  } else {
    colour = vec4(shaded(albedo, point, normal, lit(point, normal), floor_z), 1.0);
  }
  float depth = is_perspective ? depth_map.x + depth_map.y / t
                               : depth_map.x * (t - before) + depth_map.y;
  gl_FragDepth = clamp(0.5 + 0.5 * depth, 0.0, 1.0);
}
)";

}  // namespace

const std::string& body_vertex() {
  static const std::string source = R"(
in vec3 position, normal;
in vec4 row_x, row_y, row_z, chance;
out vec3 point, face, own;
flat out vec4 luck;
void main() {
  vec4 p = vec4(position, 1.0);
  point = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
  face = vec3(dot(row_x.xyz, normal), dot(row_y.xyz, normal), dot(row_z.xyz, normal));
  own = position;
  luck = chance;
  gl_Position = in_picture(point);
}
)";
  return source;
}

const std::string& body_fragment() {
  static const std::string source =
      fmt::format("{}{}{}{}", kBodyInputs, kNoise, kLighting, kBodyMain);
  return source;
}

const std::string& room_vertex() {
  static const std::string source = R"(#version 330 core
out vec2 place;
void main() {
  place = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(place, 0.0, 1.0);
}
)";
  return source;
}

const std::string& room_fragment() {
  static const std::string source =
      fmt::format("{}{}{}{}", kRoomInputs, kNoise, kLighting, kRoomMain);
  return source;
}

const std::string& shadow_vertex() {
  static const std::string source = R"(#version 330 core
in vec3 position;
in vec4 row_x, row_y, row_z;
uniform mat3 light_axes;
uniform float map_radius;
void main() {
  vec4 p = vec4(position, 1.0);
  vec3 q = light_axes * vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p)) / map_radius;
  gl_Position = vec4(q.xy, 0.25 * q.z, 1.0);
}
)";
  return source;
}

const std::string& shadow_fragment() {
  static const std::string source = R"(#version 330 core
void main() {}
)";
  return source;
}

const std::string& add_vertex() { return room_vertex(); }

const std::string& add_fragment() {
  static const std::string source = R"(#version 330 core
uniform sampler2D pass;
out vec4 colour;
void main() { colour = texelFetch(pass, ivec2(gl_FragCoord.xy), 0); }
)";
  return source;
}

}  // namespace repose::render::shaders
