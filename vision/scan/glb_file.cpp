#include "vision/scan/glb_file.h"

#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"

namespace repose::vision {

namespace {

using nlohmann::json;

constexpr std::string_view kGlbMagic = "glTF";
constexpr int kDeepest = 64;  // nested nodes; a file could contain itself endlessly
constexpr std::size_t kMostNodes = 100'000;
constexpr std::size_t kMostCorners = 40'000'000;

// Constants of the specification, sec. 3.6.2.2 and 3.7.2.1.
constexpr std::size_t kUint8 = 5121, kUint16 = 5123, kUint32 = 5125, kFloat = 5126;
constexpr std::size_t kPoints = 0, kTriangles = 4;

[[noreturn]] void refuse_glb(const std::string& what) { throw base::InputError({.value = what}); }

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  if (bytes.size() < at + sizeof word) refuse_glb("the file ends too soon");
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

std::size_t width_of(std::size_t component) {
  switch (component) {
    case kUint8:
      return 1;
    case kUint16:
      return 2;
    case kUint32:
    case kFloat:
      return 4;
    default:
      refuse_glb(fmt::format("numbers of the kind {} are not read: it is compressed", component));
  }
}

/// A non-negative integer: an index, a count or a number of bytes.
std::size_t whole(const json& number) {
  if (!number.is_number_unsigned()) refuse_glb("a number is not whole, or below 0");
  return number.get<std::size_t>();
}

std::size_t whole(const json& object, const char* key, std::size_t otherwise) {
  return object.contains(key) ? whole(object.at(key)) : otherwise;
}

/// An array in the file's binary part, with one or several components per item.
struct Numbers {
  std::string_view bytes;
  std::size_t count = 0;
  std::size_t stride = 0;
  std::size_t component = kFloat;

  template <typename Number>
  Number at(std::size_t item, std::size_t place) const {
    Number number{};
    std::memcpy(&number, bytes.data() + item * stride + place * sizeof number, sizeof number);
    return number;
  }
  std::uint32_t index(std::size_t item) const {
    if (component == kUint8) return at<std::uint8_t>(item, 0);
    if (component == kUint16) return at<std::uint16_t>(item, 0);
    return at<std::uint32_t>(item, 0);
  }
};

class GlbReader {
 public:
  explicit GlbReader(std::string_view bytes) {
    constexpr std::size_t kHead = 12, kChunkHead = 8;
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if (word_at(bytes, 4) != 2) refuse_glb("it is not of glTF's version 2");
    for (std::size_t at = kHead; at + kChunkHead <= bytes.size();) {
      const std::size_t length = word_at(bytes, at);
      const std::uint32_t kind = word_at(bytes, at + 4);
      if (bytes.size() - at - kChunkHead < length) refuse_glb("the file ends too soon");
      const std::string_view chunk = bytes.substr(at + kChunkHead, length);
      if (kind == kJson && tree_.is_null()) tree_ = json::parse(chunk);
      if (kind == kBinary && binary_.empty()) binary_ = chunk;
      at += kChunkHead + length;
    }
    if (!tree_.is_object()) refuse_glb("it has no JSON part");
  }

  TriangleSoup read_all() {
    const json& scene = tree_.at("scenes").at(whole(tree_, "scene", 0));
    for (const json& node : scene.value("nodes", json::array())) {
      add_node(whole(node), Eigen::Affine3d::Identity(), 0);
    }
    return std::move(soup_);
  }

 private:
  static Eigen::Affine3d placing_of(const json& node) {
    Eigen::Affine3d placing = Eigen::Affine3d::Identity();
    if (node.contains("matrix")) {
      const auto numbers = node.at("matrix").get<std::array<double, 16>>();
      placing.matrix() = Eigen::Matrix4d::Map(numbers.data());
      return placing;
    }
    if (node.contains("translation")) {
      const auto t = node.at("translation").get<std::array<double, 3>>();
      placing.translate(Eigen::Vector3d(t[0], t[1], t[2]));
    }
    if (node.contains("rotation")) {
      const auto q = node.at("rotation").get<std::array<double, 4>>();
      placing.rotate(Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized());
    }
    if (node.contains("scale")) {
      const auto s = node.at("scale").get<std::array<double, 3>>();
      placing.scale(Eigen::Vector3d(s[0], s[1], s[2]));
    }
    return placing;
  }

  void add_node(std::size_t number, const Eigen::Affine3d& parent, int depth) {
    if (depth > kDeepest || ++nodes_ > kMostNodes) {
      refuse_glb("its nodes are within each other without end");
    }
    const json& node = tree_.at("nodes").at(number);
    const Eigen::Affine3d placing = parent * placing_of(node);
    if (node.contains("mesh")) {
      const json& mesh = tree_.at("meshes").at(whole(node.at("mesh")));
      for (const json& primitive : mesh.at("primitives")) add_primitive(primitive, placing);
    }
    for (const json& child : node.value("children", json::array())) {
      add_node(whole(child), placing, depth + 1);
    }
  }

  /// Lines, strips and fans do not occur in scans.
  void add_primitive(const json& primitive, const Eigen::Affine3d& placing) {
    const std::size_t mode = whole(primitive, "mode", kTriangles);
    if (mode != kPoints && mode != kTriangles) return;
    const std::size_t first = soup_.corners.size();
    const Numbers places = numbers(primitive.at("attributes").at("POSITION"), "VEC3", 3);
    if (places.component != kFloat) refuse_glb("its places are no floats: it is compressed");
    if (first + places.count > kMostCorners) refuse_glb("it holds more than 40 million points");
    for (std::size_t k = 0; k < places.count; ++k) {
      const Eigen::Vector3d place =
          placing *
          Eigen::Vector3d(places.at<float>(k, 0), places.at<float>(k, 1), places.at<float>(k, 2));
      soup_.corners.push_back({place.x(), place.y(), place.z()});
    }
    if (mode == kTriangles) add_triangles(primitive, first, places.count);
  }

  void add_triangles(const json& primitive, std::size_t first, std::size_t corners) {
    std::optional<Numbers> indices;
    if (primitive.contains("indices")) indices = numbers(primitive.at("indices"), "SCALAR", 1);
    if (indices && indices->component == kFloat) refuse_glb("a triangle's corners are no indices");
    const std::size_t count = indices ? indices->count : corners;
    for (std::size_t k = 0; k + 2 < count; k += 3) {
      std::array<std::uint32_t, 3> triangle{};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t corner = indices ? indices->index(k + i) : k + i;
        if (corner >= corners) refuse_glb("a triangle names a corner that is not there");
        triangle[i] = static_cast<std::uint32_t>(first + corner);
      }
      soup_.triangles.push_back(triangle);
    }
  }

  Numbers numbers(const json& accessor_number, const char* type, std::size_t components) const {
    const json& accessor = tree_.at("accessors").at(whole(accessor_number));
    if (accessor.at("type") != type) refuse_glb(fmt::format("an accessor is not of type {}", type));
    if (!accessor.contains("bufferView") || accessor.contains("sparse")) {
      refuse_glb("it is compressed (Draco, meshopt or sparse)");
    }
    const json& view = tree_.at("bufferViews").at(whole(accessor.at("bufferView")));
    if (whole(view.at("buffer")) != 0 || tree_.at("buffers").at(0).contains("uri")) {
      refuse_glb("its numbers are in another file");
    }
    Numbers found;
    found.component = whole(accessor.at("componentType"));
    found.count = whole(accessor.at("count"));
    const std::size_t width = components * width_of(found.component);
    found.stride = whole(view, "byteStride", width);
    const auto begin = whole(view, "byteOffset", 0);
    const auto length = whole(view.at("byteLength"));
    const auto offset = whole(accessor, "byteOffset", 0);
    if (begin > binary_.size() || length > binary_.size() - begin || offset > length) {
      refuse_glb("the file ends too soon");
    }
    found.bytes = binary_.substr(begin + offset, length - offset);
    const bool is_there =
        found.count == 0 || (found.stride >= width && found.bytes.size() >= width &&
                             (found.bytes.size() - width) / found.stride >= found.count - 1);
    if (!is_there) refuse_glb("an accessor counts more than its buffer holds");
    return found;
  }

  json tree_;
  std::string_view binary_;
  TriangleSoup soup_;
  std::size_t nodes_ = 0;
};

}  // namespace

bool is_glb(std::string_view bytes) { return bytes.starts_with(kGlbMagic); }

TriangleSoup parse_glb(std::string_view bytes) {
  try {
    return GlbReader(bytes).read_all();
  } catch (const json::exception& error) {
    refuse_glb(error.what());
  }
}

}  // namespace repose::vision
