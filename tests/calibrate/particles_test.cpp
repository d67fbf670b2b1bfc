// Particle files of other programs: reading each kind, errors in them, and the heap.
#include "calibrate/particles/particles.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/units.h"
#include "calibrate/particles/positions_angle.h"
#include "calibrate/particles/standing_heap.h"
#include "tests/support/error_of.h"
#include "tests/support/particle_files.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::dump_step;
using repose::testing::DumpLook;
using repose::testing::edem_moment;
using repose::testing::EdemLook;
using repose::testing::legacy_vtk;
using repose::testing::LegacyLook;
using repose::testing::moved;
using repose::testing::packed_cone;
using repose::testing::particle_table;
using repose::testing::Spheres;
using repose::testing::TableLook;
using repose::testing::TemporaryFolder;
using repose::testing::xml_vtk;
using repose::testing::XmlLook;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ParticleFiles : public ::testing::Test {
 protected:
  Particles read(const std::string& name, const std::string& text,
                 const ParticleReading& reading = {}) const {
    return read_particles(folder_.write(name, text), reading);
  }
  std::string fault(const std::string& name, const std::string& text,
                    const ParticleReading& reading = {}) const {
    return error_of([&] { read(name, text, reading); });
  }
  /// The same in any unit, to the precision of the file.
  static void expect_same(const Particles& read, const Spheres& spheres) {
    ASSERT_EQ(read.spheres.size(), spheres.size());
    for (std::size_t k = 0; k < spheres.size(); ++k) {
      ASSERT_LT((read.spheres[k].centre - spheres[k].centre).norm(), 2e-8) << k;
      ASSERT_NEAR(read.spheres[k].radius, spheres[k].radius, 2e-9) << k;
    }
  }

  TemporaryFolder folder_;
  Spheres heap_ = packed_cone(27, .01, .001);
};

TEST_F(ParticleFiles, TablesAreReadWhateverTheirHeaderIs) {
  const std::vector<TableLook> looks = {
      {.header = "x [mm],y [mm],z [mm],radius [mm]\n", .per_m = 1e3},
      {.header = "x_mm;y_mm;z_mm;r_mm\n", .between = ";", .per_m = 1e3, .has_decimal_comma = true},
      {.header = "id,Position X (m),Position Y (m),Position Z (m),Diameter (m)\n",
       .order = "ixyzd"},
      {.header = "radius_m,z_m,y_m,x_m\n", .order = "rzyx"},
      {.header = "\"Points:0\",\"Points:1\",\"Points:2\",\"Radius\"\n"},
      {.header = "pos_x\tpos_y\tpos_z\trad\n", .between = "\t"},
      {.header = "# x y z r\n", .between = " "},
      {.header = "#format x_y_z_r\nx  y  z  r\n", .between = "  "},
      {.header = "my engine, run 7\nwritten today\nname,X,Y,Z,R\n,mm,mm,mm,mm\n",
       .order = "-xyzr",
       .per_m = 1e3},
      {.header = "sep=;\nxc;yc;zc;diam;clump\n", .order = "xyzdg", .between = ";"},
  };
  for (const TableLook& look : looks) {
    SCOPED_TRACE(look.header);
    const Particles read_back = read("heap.csv", particle_table(heap_, look));
    expect_same(read_back, heap_);
    EXPECT_EQ(read_back.unit.empty(), look.header.find('m') == std::string::npos ||
                                          look.header.find("clump") != std::string::npos ||
                                          look.header.find("format") != std::string::npos);
    EXPECT_EQ(read_back.grains.empty(), look.order.find('g') == std::string::npos);
  }
}

TEST_F(ParticleFiles, DumpsAreReadWhateverTheirColumnsAre) {
  const std::vector<DumpLook> looks = {
      {},
      {.columns = "id type type x y z ix iy iz vx vy vz fx fy fz omegax omegay omegaz radius"},
      {.columns = "radius z y x id"},
      {.columns = "id type xs ys zs diameter"},
      {.columns = "id xu yu zu radius"},
      {.columns = "id xsu ysu zsu radius"},
      {.columns = "id mol x y z radius"},
      {.columns = "id id_multisphere x y z radius"},
      {.columns = "x y z radius", .before = "ITEM: UNITS\nsi\nITEM: TIME\n0.5\n"},
      {.columns = "element x y z xu yu zu radius"},
  };
  for (const DumpLook& look : looks) {
    SCOPED_TRACE(look.columns);
    const Particles read_back = read("dump.5000", dump_step(5000, heap_, look));
    expect_same(read_back, heap_);
    EXPECT_EQ(read_back.unit, look.before.empty() ? "" : "m");
    EXPECT_EQ(read_back.step, "5000");
    const bool has_clumps = look.columns.find("mol") != std::string::npos ||
                            look.columns.find("multisphere") != std::string::npos;
    EXPECT_EQ(read_back.grains.empty(), !has_clumps);
  }
}

TEST_F(ParticleFiles, LegacyVtkIsReadInTextAndBinary) {
  int files = 0;
  for (const bool is_binary : {false, true}) {
    for (const bool is_grid : {false, true}) {
      for (const bool has_field : {false, true}) {
        const LegacyLook look{.is_binary = is_binary,
                              .is_grid = is_grid,
                              .has_field = has_field,
                              .is_double = is_grid != has_field,
                              .has_offsets = is_grid == has_field};
        SCOPED_TRACE(++files);
        const Particles read_back = read("heap.vtk", legacy_vtk(heap_, look));
        ASSERT_EQ(read_back.spheres.size(), heap_.size());
        expect_same(read_back, heap_);
      }
    }
  }
}

TEST_F(ParticleFiles, XmlVtkIsReadAppendedAndPackedToo) {
  using Form = XmlLook::Form;
  for (const Form form : {Form::ascii, Form::binary, Form::raw, Form::base64}) {
    for (const bool is_packed : {false, true}) {
      for (const bool is_long : {false, true}) {
        SCOPED_TRACE(fmt::format("{} {} {}", static_cast<int>(form), is_packed, is_long));
        const XmlLook look{.form = form,
                           .is_packed = is_packed && form != Form::ascii,
                           .has_long_header = is_long,
                           .is_polydata = is_packed};
        expect_same(read(is_packed ? "heap.vtp" : "heap.vtu", xml_vtk(heap_, look)), heap_);
      }
    }
  }
}

TEST_F(ParticleFiles, EdemExportsAreReadInRowsAndColumns) {
  int files = 0;
  for (const bool has_columns : {false, true}) {
    for (const std::string between : {",", ";", "\t"}) {
      for (const std::string size : {"Particle Radius", "Particle Diameter"}) {
        SCOPED_TRACE(++files);
        const EdemLook look{.has_columns = has_columns,
                            .between = between,
                            .size = size,
                            .unit = has_columns ? " (mm)" : "",
                            .per_m = has_columns ? 1e3 : 1.};
        const std::string text = "EXTRACTED DATA\n\n" +
                                 edem_moment("0.4", moved(heap_, {0, 0, 1}), look) +
                                 edem_moment("0.8", heap_, look);
        const Particles last = read("export.csv", text);
        expect_same(last, heap_);
        EXPECT_EQ(last.step, "0.8");
        EXPECT_EQ(last.steps, 2);
        EXPECT_EQ(last.unit, has_columns ? "mm" : "");
        expect_same(read("export.csv", text, {.step = .4}), moved(heap_, {0, 0, 1}));
      }
    }
  }
}

TEST_F(ParticleFiles, OfSeveralStepsTheLastIsTakenOrTheOneAskedFor) {
  const Spheres falling = moved(heap_, {0, 0, .1});
  const std::string dump = dump_step(100, falling) + dump_step(200, heap_);
  const Particles last = read("a.dump", dump);
  EXPECT_EQ(last.step, "200");
  EXPECT_EQ(last.steps, 2);
  expect_same(last, heap_);
  expect_same(read("a.dump", dump, {.step = 100}), falling);
  EXPECT_EQ(read("b.dump", dump_step(200, heap_) + dump_step(100, falling)).step, "200");
  EXPECT_THAT(fault("a.dump", dump, {.step = 150}),
              AllOf(HasSubstr("no time step 150"), HasSubstr("100, 200")));
  std::string table = "time,x,y,z,r\n";
  for (const auto& [time, spheres] : {std::pair<int, const Spheres*>(1, &falling), {2, &heap_}}) {
    for (const dem::ClumpSphere& one : *spheres) {
      table += fmt::format("{},{:.9f},{:.9f},{:.9f},{:.9f}\n", time, one.centre.x(), one.centre.y(),
                           one.centre.z(), one.radius);
    }
  }
  expect_same(read("a.csv", table), heap_);
  expect_same(read("a.csv", table, {.step = 1}), falling);
}

TEST_F(ParticleFiles, UnitsAreToldOrAskedFor) {
  const std::string bare = particle_table(heap_, {.header = "x,y,z,r\n", .per_m = 1e3});
  EXPECT_THAT(read("a.csv", bare).unit, IsEmpty());
  expect_same(read("a.csv", bare, {.unit = "mm"}), heap_);
  const std::string told = particle_table(heap_, {.header = "x_mm,y_mm,z_mm,r_mm\n", .per_m = 1e3});
  expect_same(read("a.csv", told, {.unit = "mm"}), heap_);
  EXPECT_THAT(fault("a.csv", told, {.unit = "m"}), HasSubstr("says that its unit is mm"));
  const std::string half = particle_table(heap_, {.header = "x_mm,y_mm,z_mm,r\n", .per_m = 1e3});
  EXPECT_THAT(fault("a.csv", half), HasSubstr("r has no unit, and others are in mm"));
  EXPECT_THAT(fault("a.csv", "x [furlong],y [m],z [m],r [m]\n1,1,1,1\n"),
              HasSubstr("no unit of length"));
  const std::string places =
      particle_table(heap_, {.header = "x_mm,y_mm,z_mm\n", .order = "xyz", .per_m = 1e3});
  EXPECT_THAT(fault("a.csv", places), HasSubstr("no column radius or diameter"));
  expect_same(read("a.csv", places, {.diameter_mm = 2}), heap_);
  EXPECT_THAT(fault("a.csv", told, {.diameter_mm = 2}), HasSubstr("is given"));
}

TEST_F(ParticleFiles, FaultsNameThePlace) {
  EXPECT_THAT(fault("a.csv", ""), HasSubstr("is empty"));
  EXPECT_THAT(fault("a.csv", "1,2,3,4\n"), HasSubstr("no line names columns x, y and z"));
  EXPECT_THAT(fault("a.csv", "x,y,z,r\n"), HasSubstr("no rows"));
  EXPECT_THAT(fault("a.csv", "x,y,z,r\n1,nan,3,4\n"), AllOf(HasSubstr("a.csv:2"), HasSubstr("y")));
  EXPECT_THAT(fault("a.csv", "x,y,z,r\n1,2,3,4\n1,2,3,0\n"),
              AllOf(HasSubstr("a.csv:3: r is 0"), HasSubstr("above 0")));
  EXPECT_THAT(fault("a.csv", "x,y,z,r,pos x\n1,2,3,4,5\n"), HasSubstr("may both be meant"));
  EXPECT_THAT(fault("a.csv", "x,y,z,r\n1,2,3\n"), HasSubstr("3 cells"));
  EXPECT_THAT(fault("a.txt", "x y z r\n1 2 3 4\n1 2 3\n"), HasSubstr("a.txt:3: r is missing"));
  EXPECT_THAT(fault("a.csv", "PK\x03\x04"), HasSubstr("spreadsheet"));
  EXPECT_THAT(fault("a.csv", "\x1F\x8B\x08"), HasSubstr("compressed"));
  EXPECT_THAT(fault("a.dump", "ITEM: NUMBER OF ATOMS\n1\n"), HasSubstr("no ITEM: TIMESTEP"));
  Spheres lost = heap_;
  lost[2].centre.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fault("a.dump", dump_step(1, lost)),
              AllOf(HasSubstr("a.dump:12"), HasSubstr("y is nan"), HasSubstr("unstable")));
  EXPECT_THAT(fault("a.dump", dump_step(1, heap_, {.columns = "id x y z"})),
              HasSubstr("no column radius"));
  EXPECT_THAT(fault("a.vtk", "# vtk DataFile Version 3.0\n\nASCII\nDATASET STRUCTURED_POINTS\n"),
              HasSubstr("STRUCTURED_POINTS"));
  EXPECT_THAT(fault("a.vtu", "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\"/>"),
              HasSubstr("ImageData"));
  const std::string uneven =
      "TIME:,1\nQ01 : Particle Position X:,1,2\nQ02 : Particle Position Y:,1\n";
  EXPECT_THAT(fault("a.csv", uneven), HasSubstr("has 2 numbers"));
}

/// A truncated file is rejected; if it has several steps, an earlier one can be selected.
TEST_F(ParticleFiles, ACutFileIsRefused) {
  const Spheres few(heap_.begin(), heap_.begin() + 20);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.dump", dump_step(1, few)},
      {"a.vtk", legacy_vtk(few, {})},
      {"b.vtk", legacy_vtk(few, {.is_binary = true, .has_field = true, .is_double = true})},
      {"a.vtu", xml_vtk(few, {})},
      {"b.vtu", xml_vtk(few, {.form = XmlLook::Form::binary, .is_packed = true})},
      {"c.vtu", xml_vtk(few, {.form = XmlLook::Form::raw})},
      {"d.vtu", xml_vtk(few, {.form = XmlLook::Form::base64, .has_long_header = true})}};
  for (const auto& [name, text] : files) {
    ASSERT_EQ(read(name, text).spheres.size(), few.size());
    for (std::size_t parts = 0; parts < 40; ++parts) {
      const std::size_t size = text.size() * parts / 40;
      EXPECT_THAT(fault(name, text.substr(0, size)), HasSubstr(name)) << size;
    }
  }
  const std::string two = dump_step(1, few) + dump_step(2, few);
  EXPECT_THAT(fault("a.dump", two.substr(0, two.size() - 300)),
              AllOf(HasSubstr("time step 2 is cut short"), HasSubstr("before, 1")));
}

class StandingHeapTest : public ::testing::Test {
 protected:
  static StandingHeap stand(const Spheres& spheres, const HeapPlacement& placement = {},
                            std::vector<std::int64_t> grains = {}) {
    Particles particles;
    particles.spheres = spheres;
    particles.grains = std::move(grains);
    particles.unit = "m";
    return standing_heap("heap.csv", particles, placement);
  }
  static std::string fault(const Spheres& spheres, const HeapPlacement& placement = {}) {
    return error_of([&] { stand(spheres, placement); });
  }

  const Spheres heap_ = packed_cone(27, .03, .002);
};

TEST_F(StandingHeapTest, FindsThePlate) {
  const StandingHeap heap = stand(moved(heap_, {.1, -.2, .35}));
  EXPECT_NEAR(heap.plate, .35, 1e-6);
  EXPECT_FALSE(heap.is_plate_given);
  EXPECT_EQ(heap.grains, heap_.size());
  const StandingHeap low = stand(moved(heap_, {0, 0, -.35}), {.plate = -.35});
  EXPECT_NEAR(low.plate, -.35, 1e-6);
  EXPECT_THAT(fault(heap_, {.plate = -.1}), HasSubstr("is 0.1 above it"));
  EXPECT_THAT(fault(heap_, {.plate = 1}), HasSubstr("below the plate"));
}

TEST_F(StandingHeapTest, KnowsWhatIsUp) {
  Spheres lying = heap_, hanging = heap_;
  for (dem::ClumpSphere& sphere : lying) {
    sphere.centre = {sphere.centre.x(), sphere.centre.z(), sphere.centre.y()};
  }
  for (dem::ClumpSphere& sphere : hanging) sphere.centre.z() = .5 - sphere.centre.z();
  EXPECT_THAT(fault(lying), HasSubstr("if y is up"));
  EXPECT_EQ(stand(lying, {.up = Up::y}).grains, heap_.size());
  EXPECT_THAT(fault(hanging), HasSubstr("if -z is up"));
  EXPECT_NEAR(stand(hanging, {.up = Up::minus_z}).plate, .5, 1e-6);
}

TEST_F(StandingHeapTest, LeavesOutWhatIsNotOfTheHeap) {
  Spheres more = moved(heap_, {0, 0, .1});
  more.push_back({.centre = {.2, 0, .002}, .radius = .002});  // on the floor
  more.push_back({.centre = {.3, 0, .002}, .radius = .002});
  more.push_back({.centre = {0, 0, .2}, .radius = .002});      // in the air
  more.push_back({.centre = {.08, 0, .102}, .radius = .002});  // on the plate
  const StandingHeap heap = stand(more);
  EXPECT_NEAR(heap.plate, .1, 1e-6);
  EXPECT_EQ(heap.below_plate, 2U);
  EXPECT_EQ(heap.in_the_air, 1U);
  EXPECT_EQ(heap.grains, heap_.size() + 1);
}

TEST_F(StandingHeapTest, RefusesWhatIsNoSingleHeapAtRest) {
  Spheres two = heap_;
  const Spheres second = moved(heap_, {.2, 0, 0});
  two.insert(two.end(), second.begin(), second.end());
  EXPECT_THAT(fault(two), HasSubstr("two heaps"));
  Spheres raining = heap_;
  for (int k = 0; k < static_cast<int>(heap_.size()) / 4; ++k) {
    const int column = k % 9, row = k / 9 % 9, layer = k / 81;
    raining.push_back({.centre = {.01 * column, .01 * row, .1 + .01 * layer}, .radius = .002});
  }
  EXPECT_THAT(fault(raining), HasSubstr("not at rest"));
  Spheres small = heap_;
  for (dem::ClumpSphere& sphere : small) sphere.radius /= 2;
  EXPECT_THAT(fault(small), HasSubstr("hardly touch"));
}

TEST_F(StandingHeapTest, ClumpsHangTogetherByTheirNumber) {
  Spheres pairs;
  std::vector<std::int64_t> numbers;
  for (std::size_t k = 0; k < heap_.size(); ++k) {
    for (const double side : {-.001, .001}) {
      pairs.push_back({.centre = heap_[k].centre + side * dem::Vector::UnitX(), .radius = .002});
      numbers.push_back(static_cast<std::int64_t>(k));
    }
  }
  const StandingHeap heap = stand(pairs, {}, numbers);
  EXPECT_EQ(heap.grains, heap_.size());
  EXPECT_EQ(heap.spheres, 2 * heap_.size());
}

/// Many sizes are drawn as size classes, each within tolerance.
TEST_F(StandingHeapTest, ManySizesMakeFewShapes) {
  Spheres mixed = heap_;
  for (std::size_t k = 0; k < mixed.size(); ++k) {
    mixed[k].radius *= 1 + .02 * std::sin(static_cast<double>(k));
  }
  const StandingHeap heap = stand(mixed);
  EXPECT_LT(heap.scene.shapes.size(), 20U);
  for (std::size_t k = 0; k < heap.scene.grains.size(); ++k) {
    const auto shape = static_cast<std::size_t>(heap.scene.grains[k].shape);
    const double drawn = heap.scene.shapes[shape].spheres.front().radius;
    EXPECT_NEAR(drawn / mixed[static_cast<std::size_t>(heap.scene.grains[k].number)].radius, 1,
                .0026);
  }
}

/// The cone's angle is the one it was packed at.
TEST(PositionsAngle, OfAPackedConeIsTheCones) {
  const TemporaryFolder folder;
  for (const double angle_deg : {22., 31.}) {
    const auto file =
        folder.write("heap.csv", particle_table(packed_cone(angle_deg, .04, .002),
                                                {.header = "x_mm,y_mm,z_mm,r_mm\n", .per_m = 1e3}));
    const MeasuredPositions measured = measure_positions(file, {}, {});
    ASSERT_TRUE(measured.angle.angle_rad) << measured.angle.reason;
    EXPECT_NEAR(*measured.angle.angle_rad / kDegree, angle_deg, 1.2);
    EXPECT_LT(std::abs(*measured.angle.angle_rad / kDegree - angle_deg),
              *measured.angle.uncertainty_rad / kDegree + .5);
    ASSERT_TRUE(measured.between_views_rad && measured.sizes.height_mm && measured.sizes.base_mm);
    EXPECT_NEAR(measured.sizes.height_mm->value, 40, 3);
    EXPECT_NEAR(measured.sizes.base_mm->value, 80 / std::tan(angle_deg * kDegree), 8);
    EXPECT_EQ(measured.views.size(), 9U);
  }
}

/// The angle needs no unit, and is the same to .1 degrees with one; sizes need one.
TEST(PositionsAngle, NeedsNoUnit) {
  const TemporaryFolder folder;
  const Spheres cone = packed_cone(27, .03, .002);
  const auto bare = folder.write("bare.dump", dump_step(1, cone));
  const MeasuredPositions measured = measure_positions(bare, {}, {});
  ASSERT_TRUE(measured.angle.angle_rad) << measured.angle.reason;
  EXPECT_FALSE(measured.sizes.height_mm);
  EXPECT_THAT(measured.sizes.reason, HasSubstr("unit"));
  const MeasuredPositions told =
      measure_positions(bare, {.reading = {.unit = "cm"}, .placement = {}}, {});
  ASSERT_TRUE(told.angle.angle_rad && told.sizes.height_mm);
  EXPECT_NEAR(*told.angle.angle_rad, *measured.angle.angle_rad, .1 * kDegree);
  EXPECT_NEAR(told.sizes.height_mm->value, .3, .03);
}

}  // namespace
}  // namespace repose::calibrate
