#include "calibrate/export/stl.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dem/experiment/draw_down.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"

namespace repose::calibrate {
namespace {

/// Gathers triangles.
class Stl {
 public:
  void add(const dem::Vector& a, const dem::Vector& b, const dem::Vector& c) {
    const dem::Vector normal = (b - a).cross(c - a).normalized();
    text_ += fmt::format("facet normal {} {} {}\nouter loop\n", normal.x(), normal.y(), normal.z());
    for (const dem::Vector& corner : {a, b, c}) {
      text_ += fmt::format("vertex {} {} {}\n", corner.x(), corner.y(), corner.z());
    }
    text_ += "endloop\nendfacet\n";
  }
  /// A flat quadrilateral face, with vertices in order.
  void add(const dem::Vector& a, const dem::Vector& b, const dem::Vector& c, const dem::Vector& d) {
    add(a, b, c);
    add(a, c, d);
  }
  std::string text(const char* name) const {
    return fmt::format("solid {0}\n{1}endsolid {0}\n", name, text_);
  }

 private:
  std::string text_;
};

/// Adds a sheet from pane to pane, between two positions along the upper box.
void add_sheet(const dem::DrawDownProtocol& protocol, double from_x, double to_x, Stl& stl) {
  const double side = .5 * protocol.depth_m, height = dem::upper_floor_m(protocol);
  stl.add({from_x, -side, height}, {to_x, -side, height}, {to_x, side, height},
          {from_x, side, height});
}

}  // namespace

std::string incline_stl(const dem::RollProtocol& protocol, double reach_m) {
  const dem::Incline slope = dem::incline_of(protocol);
  const double length = 4 * (protocol.release_m + 10 * reach_m);
  const double half_foot = 2 * length;
  Stl stl;
  stl.add({0, half_foot, 0}, -length * slope.down, {0, -half_foot, 0});
  return stl.text("incline");
}

std::string tube_stl(const dem::HeapProtocol& protocol, int sides) {
  const double inner = .5 * protocol.tube_diameter_m;
  const double outer = inner + protocol.tube_thickness_m;
  const auto at = [&](int side, double radius, double height) {
    const double turn = 2 * std::numbers::pi * side / sides;
    return dem::Vector(radius * std::cos(turn), radius * std::sin(turn), height);
  };
  const double top = protocol.tube_height_m;
  Stl stl;
  for (int k = 0; k < sides; ++k) {
    stl.add(at(k + 1, inner, 0), at(k, inner, 0), at(k, inner, top), at(k + 1, inner, top));
    stl.add(at(k, outer, 0), at(k + 1, outer, 0), at(k + 1, outer, top), at(k, outer, top));
    stl.add(at(k, inner, 0), at(k + 1, inner, 0), at(k + 1, outer, 0), at(k, outer, 0));
    stl.add(at(k, outer, top), at(k + 1, outer, top), at(k + 1, inner, top), at(k, inner, top));
  }
  return stl.text("tube");
}

std::string plate_stl(const dem::HeapProtocol& protocol) {
  const double half = .5 * protocol.plate_m;
  const double below = -protocol.plate_thickness_m;
  const std::array<dem::Vector, 4> top = {
      {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}}};
  Stl stl;
  stl.add(top[0], top[1], top[2], top[3]);
  for (std::size_t k = 0; k < top.size(); ++k) {
    const dem::Vector& from = top[k];
    const dem::Vector& to = top[(k + 1) % top.size()];
    const dem::Vector down(0, 0, below);
    stl.add(from, from + down, to + down, to);
  }
  return stl.text("plate");
}

std::string slotted_floor_stl(const dem::DrawDownProtocol& protocol) {
  const double end = .5 * protocol.length_m, lip = .5 * protocol.slot_m;
  Stl stl;
  add_sheet(protocol, -end, -lip, stl);
  add_sheet(protocol, lip, end, stl);
  return stl.text("floor");
}

std::string gate_stl(const dem::DrawDownProtocol& protocol) {
  const double lip = .5 * protocol.slot_m;
  Stl stl;
  add_sheet(protocol, -lip, lip, stl);
  return stl.text("gate");
}

}  // namespace repose::calibrate
