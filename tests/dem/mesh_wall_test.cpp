#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/engine/simulation.h"
#include "dem/wall/facets.h"

namespace repose::testing {
namespace {

using dem::Mesh;
using dem::Vector;

/// A square of side 1 about the origin in z = 0, n x n squares of two triangles each; for x > 0 it
/// rises with the given slope.
Mesh folded_sheet(int n, double slope) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) {
      const double x = -.5 + static_cast<double>(i) / n;
      mesh.vertices.emplace_back(x, -.5 + static_cast<double>(j) / n, slope * std::max(x, 0.0));
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const int at = i * (n + 1) + j;
      mesh.triangles.push_back({at, at + 1, at + n + 1});
      mesh.triangles.push_back({at + 1, at + n + 2, at + n + 1});
    }
  }
  return mesh;
}

int contacts_within(const Mesh& mesh, const Vector& point, double distance) {
  const dem::MeshFacets facets(mesh);
  std::vector<int> near;
  facets.near(point, distance, near);
  int count = 0;
  for (const int facet : near) count += facets.closest(facet, point).distance < distance ? 1 : 0;
  return count;
}

dem::Grain rolled_over(const dem::WallShape& wall, const Vector& velocity) {
  const double radius = .01;
  const dem::ContactTable contacts(
      {{.name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 1e8, .poisson_ratio = .25}},
      {{.restitution = .6, .sliding_friction = .3}}, dem::RollingModel::none);
  dem::Wall sheet;
  sheet.shape = wall;
  dem::SimulationSetup setup{.kinds = {{dem::sphere_shape(radius), 0}},
                             .walls = {sheet},
                             .contacts = contacts,
                             .timestep_s = 5e-6};
  dem::Simulation simulation(setup);
  simulation.add({.position = {-.4, .033, .9999 * radius}, .velocity = velocity});
  simulation.advance(40000);
  return simulation.grain(0);
}

TEST(MeshWall, IsTouchedOnceWhereverThePointIsAboveFlatTriangles) {
  const Mesh sheet = folded_sheet(4, 0);
  const double on_edge = -.25;
  for (const double x : {-.3, on_edge, -.125, 0.0, .11}) {
    for (const double y : {-.3, on_edge, -.125, 0.0, .07}) {
      EXPECT_EQ(contacts_within(sheet, {x, y, .01}, .02), 1) << x << ", " << y;
    }
  }
}

TEST(MeshWall, IsTouchedOnceAtAConvexRidge) {
  const Mesh ridge = folded_sheet(4, -1);
  EXPECT_EQ(contacts_within(ridge, {.001, .03, .01}, .02), 1);
  EXPECT_EQ(contacts_within(ridge, {.002, -.25, .01}, .02), 1);
}

TEST(MeshWall, IsTouchedTwiceInAFold) {
  EXPECT_EQ(contacts_within(folded_sheet(4, 1), {-.005, .03, .01}, .02), 2);
}

TEST(MeshWall, IsTouchedOnceAtItsOuterEdgeAndCorner) {
  const Mesh sheet = folded_sheet(4, 0);
  EXPECT_EQ(contacts_within(sheet, {.505, .03, .01}, .02), 1);
  EXPECT_EQ(contacts_within(sheet, {.505, .505, .01}, .02), 1);
  EXPECT_EQ(contacts_within(sheet, {.53, .03, .01}, .02), 0);
}

TEST(MeshWall, IsTouchedFromBelowToo) {
  const dem::MeshFacets facets(folded_sheet(1, 0));
  const dem::Closest below = facets.closest(0, {-.2, -.2, -.01});
  EXPECT_NEAR(below.distance, .01, 1e-15);
  EXPECT_NEAR(below.normal.z(), -1, 1e-15);
}

TEST(MeshWall, LetsABallSlideAndRollOverItsEdgesAsOverAPlane) {
  const Vector velocity(1, .37, 0);
  const dem::Grain plane = rolled_over(dem::Plane{}, velocity);
  for (const int squares : {3, 16}) {
    const dem::Grain mesh = rolled_over(dem::MeshSurface{folded_sheet(squares, 0)}, velocity);
    EXPECT_LT((mesh.position - plane.position).norm(), 1e-9) << squares;
    EXPECT_LT((mesh.spin - plane.spin).norm(), 1e-6) << squares;
  }
}

TEST(MeshWall, RefusesMeshesThatAreNoSurface) {
  EXPECT_THROW(dem::MeshFacets(Mesh{}), base::InputError);
  Mesh line;
  line.vertices = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(2, 0, 0)};
  line.triangles = {{0, 1, 2}};
  EXPECT_THROW(dem::MeshFacets{line}, base::InputError);
  Mesh nan = folded_sheet(1, 0);
  nan.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(dem::MeshFacets{nan}, base::InputError);
}

}  // namespace
}  // namespace repose::testing
