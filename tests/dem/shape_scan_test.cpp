#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <sys/stat.h>

#include "base/input_error.h"
#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/scan.h"
#include "tests/dem/shapes.h"
#include "tests/support/temporary_folder.h"

namespace repose::testing {
namespace {

using dem::Mesh;
using dem::Quaternion;
using dem::Scan;
using dem::ScanUnit;
using dem::Vector;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

constexpr double kSinglePrecision = 1e-11;  // of 24e-6 m^3, as kept by STL and assimp

auto refuses(const auto& matcher) { return ThrowsMessage<base::InputError>(matcher); }

std::string ascii_stl(const Mesh& mesh) {
  std::ostringstream text;
  text.precision(9);
  text << "solid grain\n";
  for (const auto& triangle : mesh.triangles) {
    text << "facet normal 0 0 1\nouter loop\n";
    for (const int corner : triangle) {
      text << "vertex " << mesh.vertices[static_cast<std::size_t>(corner)].transpose() << '\n';
    }
    text << "endloop\nendfacet\n";
  }
  text << "endsolid grain\n";
  return text.str();
}

std::string binary_stl(const Mesh& mesh) {
  std::string bytes(80, ' ');
  const auto append = [&](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(0.0F);
    for (const int corner : triangle) {
      for (const double x : mesh.vertices[static_cast<std::size_t>(corner)]) {
        append(static_cast<float>(x));
      }
    }
    append(std::uint16_t{0});
  }
  return bytes;
}

std::string obj(const Mesh& mesh) {
  std::ostringstream text;
  text.precision(9);
  for (const Vector& vertex : mesh.vertices) text << "v " << vertex.transpose() << '\n';
  for (const auto& t : mesh.triangles) {
    text << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  return text.str();
}

std::string ply(const Mesh& mesh, bool has_faces = true) {
  std::ostringstream text;
  text.precision(9);
  text << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
       << "\nproperty float x\nproperty float y\nproperty float z\n";
  if (has_faces) {
    text << "element face " << mesh.triangles.size()
         << "\nproperty list uchar int vertex_indices\n";
  }
  text << "end_header\n";
  for (const Vector& vertex : mesh.vertices) text << vertex.transpose() << '\n';
  for (const auto& t : mesh.triangles) {
    if (has_faces) text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  }
  return text.str();
}

Scan checked(const Mesh& mesh) { return dem::checked_surface(mesh, "grain"); }

double volume(const Scan& scan) { return dem::mass_properties(scan.surface).volume_m3; }

TEST(ReadScan, ReadsTheSameBodyFromEveryFormat) {
  const TemporaryFolder folder;
  const Mesh box_mm = box_surface(20, 30, 40);
  for (const auto& file :
       {folder.write("a.stl", ascii_stl(box_mm)), folder.write("b.STL", binary_stl(box_mm)),
        folder.write("c.obj", obj(box_mm)), folder.write("d.ply", ply(box_mm))}) {
    const Scan scan = dem::read_scan(file, ScanUnit::millimetre);
    EXPECT_EQ(scan.surface.vertices.size(), 8U) << file;
    EXPECT_NEAR(volume(scan), 24e-6, kSinglePrecision) << file;
    EXPECT_THAT(scan.repairs, IsEmpty()) << file;
  }
}

TEST(ReadScan, CutsFacesOfMoreCornersIntoTriangles) {
  const TemporaryFolder folder;
  const std::string corners =
      "0 0 0\n0 0 40\n0 30 0\n0 30 40\n20 0 0\n20 0 40\n20 30 0\n20 30 40\n";
  const std::string faces = "4 0 1 3 2\n4 4 6 7 5\n4 0 4 5 1\n4 2 3 7 6\n4 0 2 6 4\n4 1 5 7 3\n";
  const auto file = folder.write(
      "quads.ply",
      "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nelement face 6\nproperty list uchar int vertex_indices\nend_header\n" +
          corners + faces);
  EXPECT_NEAR(volume(dem::read_scan(file, ScanUnit::millimetre)), 24e-6, kSinglePrecision);
}

TEST(ReadScan, RefusesFacesOfTooManyCorners) {
  const TemporaryFolder folder;
  std::string corners, face = "f";
  for (int k = 1; k <= 257; ++k) {
    corners += "v " + std::to_string(k) + " 0 0\n";
    face += ' ' + std::to_string(k);
  }
  const auto file = folder.write("disc.obj", corners + face + '\n');
  EXPECT_THAT(
      [&] { dem::read_scan(file, ScanUnit::millimetre); },
      refuses(AllOf(HasSubstr("a face with 257 corners. Rule: at most 256"), HasSubstr("Fix:"))));
}

TEST(ReadScan, OpensNothingThatAScanRefersTo) {
  const TemporaryFolder folder;
  const std::string body = "usemtl shell\n" + obj(box_surface(20, 30, 40));
  folder.write("bad.mtl", std::string("newmtl shell\nKd not numbers\n"));
  ASSERT_EQ(::mkfifo((folder.path() / "pipe.mtl").c_str(), 0600), 0);  // opening it would block
  for (const char* library : {"bad.mtl", "pipe.mtl", "none.mtl", "../../../../etc/passwd"}) {
    const auto file = folder.write("nut.obj", "mtllib " + std::string(library) + '\n' + body);
    EXPECT_NEAR(volume(dem::read_scan(file, ScanUnit::millimetre)), 24e-6, kSinglePrecision)
        << library;
  }
}

TEST(ReadScan, TakesMetresWhenToldSoAndSuggestsTheOtherUnit) {
  const TemporaryFolder folder;
  const auto in_m = folder.write("m.stl", binary_stl(box_surface(0.02, 0.03, 0.04)));
  EXPECT_NEAR(volume(dem::read_scan(in_m, ScanUnit::metre)), 24e-6, kSinglePrecision);
  EXPECT_THAT([&] { dem::read_scan(in_m, ScanUnit::millimetre); },
              refuses(AllOf(HasSubstr("is 0.04 mm long"), HasSubstr("unit is probably m."))));
  const auto in_mm = folder.write("mm.stl", binary_stl(box_surface(20, 30, 40)));
  EXPECT_THAT([&] { dem::read_scan(in_mm, ScanUnit::metre); },
              refuses(HasSubstr("unit is probably mm.")));
}

TEST(ReadScan, SaysWhatIsWrongWithAFile) {
  const TemporaryFolder folder;
  const std::string whole = binary_stl(box_surface(20, 30, 40));
  const auto read = [&](const std::string& name, const std::string& content) {
    return [&, file = folder.write(name, content)] { dem::read_scan(file, ScanUnit::millimetre); };
  };
  EXPECT_THAT([&] { dem::read_scan(folder.path() / "none.stl", ScanUnit::metre); },
              refuses(HasSubstr("there is no such file")));
  EXPECT_THAT([&] { dem::read_scan(folder.path(), ScanUnit::metre); },
              refuses(HasSubstr("is a folder")));
  EXPECT_THAT(read("a.jpg", "x"), refuses(HasSubstr("is not named as an STL, OBJ or PLY file")));
  EXPECT_THAT(read("empty.stl", ""), refuses(HasSubstr("is empty")));
  EXPECT_THAT(read("short.stl", "solid"), refuses(HasSubstr("Fix:")));
  EXPECT_THAT(read("cut.stl", whole.substr(0, whole.size() / 2)), refuses(HasSubstr("Fix:")));
  EXPECT_THAT(read("text.ply", "hello"), refuses(HasSubstr("Fix:")));
  EXPECT_THAT(read("points.ply", ply(box_surface(20, 30, 40), false)),
              refuses(HasSubstr("Screened Poisson")));
}

TEST(ReadScan, RefusesCoordinatesThatAreNoPlaces) {
  const TemporaryFolder folder;
  for (const double bad : {std::nan(""), 1e30, -HUGE_VAL}) {
    Mesh mesh = box_surface(20, 30, 40);
    mesh.vertices[3].y() = bad;
    const auto file = folder.write("bad.stl", binary_stl(mesh));
    EXPECT_THAT([&] { dem::read_scan(file, ScanUnit::millimetre); },
                refuses(HasSubstr("finite coordinates")))
        << bad;
  }
}

TEST(CheckedSurface, JoinsCornersThatAreApartByRounding) {
  Mesh apart = taken_apart(nut_surface());
  // A tenth of the distance within which vertices are merged.
  for (std::size_t i = 0; i < apart.vertices.size(); ++i) {
    apart.vertices[i].x() += (i % 3 == 0 ? 1 : -1) * 1.6e-8;
  }
  const Scan scan = checked(apart);
  EXPECT_TRUE(dem::is_watertight(scan.surface));
  EXPECT_EQ(scan.surface.vertices.size(), nut_surface().vertices.size());
}

TEST(CheckedSurface, TurnsASurfaceRoundThatIsInsideOutAndSaysSo) {
  const Scan scan = checked(inside_out(nut_surface()));
  EXPECT_GT(volume(scan), 0);
  EXPECT_THAT(scan.repairs, ElementsAre(HasSubstr("inside out")));
}

TEST(CheckedSurface, MendsTrianglesThatFaceTheWrongWay) {
  Mesh mixed = nut_surface();
  for (const std::size_t t : {5U, 6U, 700U})
    std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
  const Scan scan = checked(mixed);
  EXPECT_TRUE(dem::is_watertight(scan.surface));
  EXPECT_DOUBLE_EQ(volume(scan), dem::mass_properties(nut_surface()).volume_m3);
  EXPECT_THAT(scan.repairs, ElementsAre(HasSubstr("faced the wrong way: 3")));
}

TEST(CheckedSurface, FillsSmallHolesAndSaysSo) {
  Mesh holed = nut_surface();
  holed.triangles.erase(holed.triangles.begin() + 3000, holed.triangles.begin() + 3020);
  holed.triangles.erase(holed.triangles.begin() + 500);
  const Scan scan = checked(holed);
  EXPECT_TRUE(dem::is_watertight(scan.surface));
  EXPECT_NEAR(volume(scan) / dem::mass_properties(nut_surface()).volume_m3, 1, 1e-3);
  EXPECT_THAT(scan.repairs, ElementsAre(HasSubstr("holes filled: 2")));
}

TEST(CheckedSurface, RefusesToGuessLargeHoles) {
  Mesh open = box_surface(0.02, 0.03, 0.04);
  open.triangles.pop_back();
  EXPECT_THAT(
      [&] { checked(open); },
      refuses(AllOf(HasSubstr("grain: is not closed: its holes (1)"), HasSubstr("Close Holes"))));
}

TEST(CheckedSurface, CutsOutFinsWhereMoreThanTwoTrianglesMeet) {
  Mesh finned = nut_surface();
  const auto& triangle = finned.triangles[4000];
  finned.vertices.push_back(1.001 * finned.vertices[static_cast<std::size_t>(triangle[0])]);
  finned.triangles.push_back(
      {triangle[0], triangle[1], static_cast<int>(finned.vertices.size()) - 1});
  const Scan scan = checked(finned);
  EXPECT_TRUE(dem::is_watertight(scan.surface));
  EXPECT_NEAR(volume(scan) / dem::mass_properties(nut_surface()).volume_m3, 1, 1e-3);
  EXPECT_THAT(scan.repairs, ElementsAre(HasSubstr("cut out"), HasSubstr("filled")));
}

TEST(CheckedSurface, DropsLooseFlakesButDoesNotChooseBetweenBodies) {
  const Mesh nut = nut_surface();
  const Mesh flake =
      moved(box_surface(1e-4, 1e-4, 1e-4), Quaternion::Identity(), Vector(0, 0, 0.02));
  const Scan scan = checked(together(nut, flake));
  EXPECT_EQ(scan.surface.triangles.size(), nut.triangles.size());
  EXPECT_THAT(scan.repairs,
              ElementsAre(AllOf(HasSubstr("loose pieces removed"), HasSubstr(": 1"))));

  const Mesh second = moved(nut, Quaternion::Identity(), Vector(0, 0, 0.04));
  EXPECT_THAT([&] { checked(together(nut, second)); },
              refuses(HasSubstr("holds 2 separate bodies")));
}

TEST(CheckedSurface, RefusesASurfaceThatCrossesItself) {
  Mesh pushed_through = nut_surface();
  // Pushes the tip through the opposite side.
  pushed_through.vertices.back().x() = -0.03;
  EXPECT_THAT([&] { checked(pushed_through); },
              refuses(AllOf(HasSubstr("crosses itself"), HasSubstr("Fix: MeshLab"))));
}

TEST(CheckedSurface, DoesNotTakeTouchingForCrossing) {
  EXPECT_NO_THROW(checked(box_surface(0.02, 0.03, 0.04)));
  EXPECT_NO_THROW(checked(corner_tetrahedron(0.02, 0.03, 0.04)));
}

TEST(CheckedSurface, RefusesAMoebiusStrip) {
  Mesh strip;
  constexpr int kSteps = 30;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = 2 * M_PI * i / kSteps;
    const Vector out(std::cos(turn), std::sin(turn), 0);
    const Vector across = std::cos(turn / 2) * out + std::sin(turn / 2) * Vector::UnitZ();
    strip.vertices.push_back(0.02 * out + 0.004 * across);
    strip.vertices.push_back(0.02 * out - 0.004 * across);
  }
  for (int i = 0; i < kSteps; ++i) {
    const int a = 2 * i, b = a + 1, last = i + 1 == kSteps ? 1 : 0;
    const int c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  EXPECT_THAT([&] { checked(strip); }, refuses(HasSubstr("has no inside")));
}

TEST(CheckedSurface, RefusesSheetsAndNothing) {
  const Mesh sheet = box_surface(0.02, 0.03, 0);
  EXPECT_THROW(checked(sheet), base::InputError);
  EXPECT_THROW(checked({}), base::InputError);
  EXPECT_THROW(checked({.vertices = {Vector::Zero()}, .triangles = {{0, 0, 0}}}), base::InputError);
}

TEST(CheckedSurface, NamesAllErrorsAtOnce) {
  Mesh open = box_surface(20, 30, 40);
  open.triangles.pop_back();
  const Mesh faulty = together(open, moved(open, Quaternion::Identity(), Vector(5, 6, 7)));
  EXPECT_THAT([&] { checked(faulty); },
              refuses(AllOf(HasSubstr("mm long"), HasSubstr("2 separate bodies"),
                            HasSubstr("is not closed"), HasSubstr("crosses itself"))));
}

}  // namespace
}  // namespace repose::testing
