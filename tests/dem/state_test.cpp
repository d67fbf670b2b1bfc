#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/base64.h"
#include "base/input_error.h"
#include "dem/state/state_file.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::dem {
namespace {

using repose::testing::TemporaryFolder;
using repose::testing::text_of;
using ::testing::AllOf;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

ClumpShape peanut() {
  ClumpShape shape;
  shape.spheres = {{.centre = {.003, 0, 0}, .radius = .005},
                   {.centre = {-.003, 0, 0}, .radius = .004}};
  shape.volume_m3 = 7e-7;
  shape.gyration_m2 = {9e-6, 1.3e-5, 1.4e-5};
  shape.surface = {.vertices = {{0, 0, 0}, {.01, 0, 0}, {0, .01, 0}, {0, 0, .01}},
                   .triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  return shape;
}

ContactTable contacts() {
  const Material soft{"soft, \"nut\" <&>", 900, 1e7, .3}, steel{"steel", 7850, 2.1e11, .3};
  const PairCoefficients nut{.3, .4, .05}, plate{.5, .3, .02};
  return {
      {soft, steel}, {nut, plate, plate, nut}, RollingModel::elastic_plastic, DampingModel::shared};
}

Wall steel(WallShape shape) {
  Wall wall;
  wall.shape = std::move(shape);
  wall.material = 1;
  return wall;
}

std::vector<Wall> walls() {
  Wall pusher = steel(Box{{.01, .05, .05}});
  pusher.pose.position = {-.06, 0, .05};
  pusher.motions = {{.velocity = {.3, 0, 0}, .stop_s = .1}};
  return {steel(Plane{}), pusher, steel(Tube{.06, .002, .1})};
}

/// 30 clumps falling onto a plate within a tube, and a box that pushes them; one clump is removed.
Simulation heap(int threads) {
  SimulationSetup setup{.kinds = {{peanut(), 0}, {sphere_shape(.004), 0}},
                        .walls = walls(),
                        .contacts = contacts(),
                        .timestep_s = 2e-5,
                        .threads = threads,
                        .audit_steps = 1000000};
  Simulation simulation(setup);
  for (int k = 0; k < 30; ++k) {
    const int row = k / 3, layer = k / 9;
    const Quaternion turn(Eigen::AngleAxisd(k, Vector(1, .3 * k, 2).normalized()));
    simulation.add(
        {.kind = k % 4 == 3 ? 1 : 0,
         .position = {.02 * (k % 3 - 1) + .0003 * k, .02 * (row % 3 - 1), .01 + .019 * layer},
         .orientation = turn,
         .velocity = {0, 0, -.5},
         .spin = {0, 3, 0}});
  }
  simulation.remove(7);
  return simulation;
}

/// Two runs for which this is equal agree in every bit needed to continue.
std::string bits(const Simulation& simulation) { return state_text(simulation, "{}"); }

class StateFile : public ::testing::Test {
 protected:
  std::filesystem::path file() const { return folder_.path() / "state.vtp"; }
  /// A state as the text of its file.
  std::string saved(const std::string& provenance = "{}") const {
    Simulation simulation = heap(1);
    simulation.advance(1500);
    write_state(file(), simulation, provenance);
    return text_of(file());
  }
  std::string error(const std::string& text) const {
    folder_.write("state.vtp", text);
    return error_of([&] {
      const SavedState state = read_state(file());
      const Simulation simulation(state.setup, state.checkpoint);
    });
  }
  TemporaryFolder folder_;
};

TEST_F(StateFile, RunsGoOnBitForBitAtAnyNumberOfThreads) {
  for (const int threads : {1, 2}) {
    Simulation whole = heap(threads);
    whole.advance(6000);
    ASSERT_GT(whole.contacts().size(), 20U) << "nothing touches, nothing is tested";
    write_state(file(), whole, "{}");
    SavedState state = read_state(file());
    state.setup.threads = threads;
    Simulation resumed(state.setup, state.checkpoint);
    EXPECT_EQ(bits(resumed), bits(whole));
    whole.advance(2000);
    resumed.advance(2000);
    EXPECT_EQ(bits(resumed), bits(whole)) << threads << " threads";
  }
}

TEST_F(StateFile, WallsGoOnAsTheyWereToldTo) {
  Simulation whole = heap(1);
  whole.advance(2000);
  whole.set_motions(2, {{.velocity = {0, 0, .05}, .spin = {0, 0, 3}, .start_s = whole.time_s()}});
  whole.advance(2000);
  whole.remove_wall(1);
  write_state(file(), whole, "{}");
  const SavedState state = read_state(file());
  EXPECT_FALSE(state.setup.walls[1].is_present);
  Simulation resumed(state.setup, state.checkpoint);
  whole.advance(2000);
  resumed.advance(2000);
  EXPECT_EQ(bits(resumed), bits(whole));
  EXPECT_GT(resumed.wall(2).pose.position.z(), .003);
}

TEST_F(StateFile, BedsOfSpheresComeBackAndGoOn) {
  Wall bed = steel(SphereBed{
      .spheres = {{{0, 0, -.003}, .004}, {{.02, .01, -.003}, .003}}, .tile = .05, .from_x = -.4});
  SimulationSetup setup{.kinds = {{sphere_shape(.004), 0}},
                        .walls = {steel(Plane{}), bed},
                        .contacts = contacts(),
                        .timestep_s = 2e-5};
  Simulation whole(setup);
  whole.add({.position = {.05, .001, .0049}, .spin = {0, 3, 0}});
  whole.advance(10);
  ASSERT_FALSE(whole.contacts().empty());
  write_state(file(), whole, "{}");
  const SavedState state = read_state(file());
  Simulation resumed(state.setup, state.checkpoint);
  whole.advance(1000);
  resumed.advance(1000);
  EXPECT_EQ(bits(resumed), bits(whole));
  const auto& read = std::get<SphereBed>(state.setup.walls.at(1).shape);
  EXPECT_EQ(read.from_x, -.4);
  EXPECT_EQ(read.spheres.at(1).centre, Vector(.02, .01, -.003));
}

TEST_F(StateFile, ThreadsDoNotShowInIt) {
  Simulation one = heap(1), two = heap(2);
  one.advance(2000);
  two.advance(2000);
  EXPECT_EQ(bits(one), bits(two));
}

TEST_F(StateFile, EverythingComesBack) {
  Simulation simulation = heap(2);
  simulation.advance(2500);
  const std::string provenance = R"({"study": "nuts & <bolts>", "note": "π"})";
  write_state(file(), simulation, provenance);
  const SavedState state = read_state(file());
  EXPECT_EQ(state.provenance_json, provenance);
  const SimulationSetup& before = simulation.setup();
  EXPECT_EQ(state.setup.timestep_s, before.timestep_s);
  EXPECT_EQ(state.setup.floor_m, before.floor_m);
  EXPECT_EQ(state.setup.gravity, before.gravity);
  EXPECT_EQ(state.setup.audit_steps, before.audit_steps);
  ASSERT_EQ(state.setup.walls.size(), 3U);
  EXPECT_EQ(state.setup.walls[1].motions.at(0).stop_s, .1);
  EXPECT_EQ(std::get<Tube>(state.setup.walls[2].shape).thickness, .002);
  ASSERT_EQ(state.setup.kinds.size(), 2U);
  EXPECT_EQ(state.setup.kinds[0].shape.surface.triangles, peanut().surface.triangles);
  EXPECT_EQ(state.setup.contacts.material(0).name, "soft, \"nut\" <&>");
  EXPECT_EQ(state.setup.contacts.rolling(), RollingModel::elastic_plastic);
  EXPECT_EQ(state.setup.contacts.damping(), DampingModel::shared);
  EXPECT_EQ(state.checkpoint.step, 2500);
  ASSERT_EQ(state.checkpoint.grains.size(), 30U);
  EXPECT_FALSE(state.checkpoint.is_present[7]);
  EXPECT_EQ(state.checkpoint.contacts.size(), simulation.contacts().size());
}

TEST_F(StateFile, KeepsHowRestitutionGoesWithTheSpeed) {
  const auto setup_with = [](double exponent) {
    const Material wood{
        .name = "wood", .density_kg_m3 = 700, .young_modulus_pa = 1e8, .poisson_ratio = .3};
    SimulationSetup setup{
        .kinds = {{.shape = sphere_shape(.005), .material = 0}},
        .walls = {},
        .contacts = ContactTable({wood},
                                 {{.restitution = .4,
                                   .restitution_exponent = exponent,
                                   .restitution_speed_m_s = exponent > 0 ? 3. : 0.}},
                                 RollingModel::none)};
    setup.timestep_s = 1e-6;
    return setup;
  };
  write_state(file(), Simulation(setup_with(.1)), "{}");
  const SimulationSetup read = read_state(file()).setup;
  EXPECT_EQ(read.contacts.pair(0, 0).restitution_exponent, .1);
  EXPECT_EQ(read.contacts.pair(0, 0).restitution_speed_m_s, 3);
  EXPECT_TRUE(read.contacts.is_by_speed());
  write_state(file(), Simulation(setup_with(0)), "{}");
  EXPECT_FALSE(read_state(file()).setup.contacts.is_by_speed());
}

TEST_F(StateFile, PointsAreThePresentGrainsAndAreDrawn) {
  EXPECT_THAT(saved(), AllOf(HasSubstr("NumberOfPoints=\"29\" NumberOfVerts=\"29\""),
                             HasSubstr("Name=\"orientation\" NumberOfComponents=\"4\""),
                             HasSubstr("Name=\"velocity\" NumberOfComponents=\"3\"")));
}

TEST_F(StateFile, AnEmptySimulationIsAState) {
  const SimulationSetup setup{.kinds = {}, .walls = {}, .contacts = contacts(), .timestep_s = 1e-5};
  write_state(file(), Simulation(setup), "");
  const SavedState state = read_state(file());
  EXPECT_TRUE(state.checkpoint.grains.empty());
  EXPECT_EQ(state.setup.floor_m, setup.floor_m);
}

TEST_F(StateFile, NothingIsLeftBesideIt) {
  saved();
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("state.vtp"));
  EXPECT_THROW(write_state(folder_.path() / "none" / "x.vtp", heap(1), ""), base::InputError);
}

TEST_F(StateFile, CutShortFilesAreRefused) {
  const std::string whole = saved();
  for (const double fraction : {0., .001, .2, .5, .9, .999}) {
    const auto size = static_cast<std::size_t>(fraction * static_cast<double>(whole.size()));
    EXPECT_THAT(error(whole.substr(0, size)), AllOf(HasSubstr("state.vtp: "), HasSubstr("Fix: ")))
        << fraction;
  }
  EXPECT_EQ(error(whole), "");
}

TEST_F(StateFile, ForeignFilesAreRefused) {
  EXPECT_THAT(error("solid nut\n"), HasSubstr("Fix: "));
  EXPECT_THAT(error("<svg/>"), HasSubstr("no VTK PolyData file"));
  EXPECT_THAT(error("<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" "
                    "header_type=\"UInt64\"/>"),
              HasSubstr("no VTK PolyData file"));
  EXPECT_THAT(
      error("<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt64\"/>"),
      HasSubstr("has no <PolyData>"));
  EXPECT_THROW(read_state(folder_.path() / "none.vtp"), base::InputError);
  EXPECT_THROW(read_state(folder_.path()), base::InputError);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// As earlier versions wrote it: errors in it must still be detected.
std::string without_fingerprint(const std::string& text) {
  return text.substr(0, text.rfind("<!-- fingerprint "));
}

TEST_F(StateFile, AnyChangedByteIsSeen) {
  const std::string whole = saved();
  for (std::size_t at = 11; at < whole.size(); at += 199) {
    std::string text = whole;
    text[at] = text[at] == 'A' ? '/' : 'A';
    EXPECT_NE(error(text), "") << at;
  }
  EXPECT_EQ(error(without_fingerprint(whole)), "") << "states of earlier versions are read";
}

TEST_F(StateFile, SizesThatDoNotHoldTogetherAreRefused) {
  const std::string whole = without_fingerprint(saved());
  EXPECT_THAT(error(replaced(whole, "NumberOfPoints=\"29\"", "NumberOfPoints=\"999999999999\"")),
              HasSubstr("is for 29 points"));
  EXPECT_THAT(error(replaced(whole, "NumberOfPoints=\"29\"", "NumberOfPoints=\"-1\"")),
              HasSubstr("NumberOfPoints is not a whole number"));
  EXPECT_THAT(error(replaced(whole, "Name=\"velocity\" NumberOfComponents=\"3\"",
                             "Name=\"velocity\" NumberOfComponents=\"0\"")),
              HasSubstr("array velocity has"));
  EXPECT_THAT(error(replaced(whole, "Name=\"kind_sphere\"", "Name=\"other\"")),
              HasSubstr("array kind_sphere is missing"));
  EXPECT_THAT(error(replaced(whole, "Name=\"kind_sphere\"", "Name=\"wall_pose\"")),
              HasSubstr("kind_sphere is missing"));
  EXPECT_THAT(error(replaced(whole, "type=\"Float64\" Name=\"gravity\"",
                             "type=\"Float32\" Name=\"gravity\"")),
              HasSubstr("array gravity is of type Float32"));
}

/// Replaces the first numbers of an array that is one base64 block.
std::string with_numbers(const std::string& text, const std::string& array,
                         const std::string& base64) {
  const std::size_t start = text.find('>', text.find("Name=\"" + array + "\"")) + 1;
  return text.substr(0, start) + base64 + text.substr(text.find('<', start));
}

TEST_F(StateFile, EditedContentsAreRefused) {
  const std::string whole = without_fingerprint(saved());
  EXPECT_THAT(error(with_numbers(whole, "gravity", "not base64!")), HasSubstr("array gravity"));
  EXPECT_THAT(error(with_numbers(whole, "gravity", "====")), HasSubstr("array gravity"));
  EXPECT_THAT(error(with_numbers(whole, "gravity", "")), HasSubstr("array gravity"));
  // A header that announces 2^63 bytes.
  EXPECT_THAT(error(with_numbers(whole, "gravity", "AAAAAAAAAIA=")),
              HasSubstr("array gravity says"));
  // Eight bytes: the number -1, where audit steps or the time step must be above 0.
  const std::string minus_one = "CAAAAAAAAAD//////////w==";
  EXPECT_THAT(error(with_numbers(whole, "audit_steps", minus_one)), HasSubstr("audit_steps"));
  EXPECT_THAT(error(with_numbers(whole, "step", minus_one)), HasSubstr("array step"));
  EXPECT_THAT(error(with_numbers(whole, "timestep", minus_one)), HasSubstr("not a finite number"))
      << "NaN";
  EXPECT_THAT(error(with_numbers(whole, "repose_state_format", "CAAAAAAAAAACAAAAAAAAAA==")),
              HasSubstr("format is 2"));
  EXPECT_THAT(error(with_numbers(whole, "wall_motion", "AAAAAAAAAAA=")), HasSubstr("array wall_"));
  EXPECT_THAT(error(with_numbers(whole, "rolling_model", "AAAAAAAAAAA=")),
              HasSubstr("rolling_model"));
  EXPECT_THAT(error(with_numbers(whole, "damping", "AAAAAAAAAAA=")), HasSubstr("damping"));
}

/// Numbers encoded like an array of the file.
std::string base64_of(const std::vector<double>& numbers) {
  const std::uint64_t size = numbers.size() * sizeof(double);
  std::vector<std::byte> bytes(sizeof size + size);
  std::memcpy(bytes.data(), &size, sizeof size);
  std::memcpy(bytes.data() + sizeof size, numbers.data(), size);
  return base::base64_of(bytes);
}

TEST_F(StateFile, NumbersBeyondAllBoundsAreRefused) {
  const std::string whole = without_fingerprint(saved());
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  std::vector<double> motion(11, 0.);
  motion[2] = kInfinite;
  EXPECT_THAT(error(with_numbers(whole, "wall_motion", base64_of(motion))),
              HasSubstr("array wall_motion holds a value that is not a finite number"));
  EXPECT_THAT(error(with_numbers(whole, "timestep", base64_of({kInfinite}))),
              HasSubstr("array timestep holds a value that is not a finite number"));
  EXPECT_THAT(error(with_numbers(whole, "gravity", base64_of({0, 0, -1e200}))),
              HasSubstr("array gravity holds a number beyond 1e+12"));
}

TEST_F(StateFile, BedsThatCannotBeAreRefused) {
  Simulation simulation({.kinds = {{peanut(), 0}},
                         .walls = {steel(SphereBed{.spheres = {{{0, 0, 0}, .004}}, .tile = .05})},
                         .contacts = contacts(),
                         .timestep_s = 2e-5});
  simulation.add({});
  const std::string whole = without_fingerprint(state_text(simulation, "{}"));
  EXPECT_THAT(error(replaced(whole, "\"wall_bed_sphere\"", "\"wall_bed_spoon!\"")),
              HasSubstr("array wall_bed_sphere is missing"));
  const auto with_bed = [&](const std::vector<double>& bed) {
    return error(with_numbers(whole, "wall_bed_tile_from_to_spheres", base64_of(bed)));
  };
  EXPECT_THAT(with_bed({-.05, -1, 1, 1}), HasSubstr("holds a length of -0.05 m"));
  EXPECT_THAT(with_bed({.01, -1, 1, 1}), HasSubstr("holds a length of 0.004 m"));
  EXPECT_THAT(with_bed({.05, -1, 1, 9}), HasSubstr("ends after 4 values, too soon"));
  EXPECT_THAT(with_bed({.05, -1, 1, 0}), HasSubstr("more values than belong to it"));
}

TEST_F(StateFile, NoEditedByteCrashesTheReader) {
  const std::string whole = without_fingerprint(saved());
  std::size_t refused = 0;
  for (std::size_t at = 11; at < whole.size(); at += 199) {
    std::string text = whole;
    text[at] = text[at] == 'A' ? '/' : 'A';
    if (!error(text).empty()) ++refused;
  }
  EXPECT_GT(refused, 0U) << "others are other numbers, and fine ones";
}

TEST(Trajectory, IsASeriesOfStatesInTime) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder.path() / "film", .01, "{}");
  Simulation simulation = heap(1);
  for (int k = 0; k < 4; ++k) {
    writer.add(simulation);
    simulation.advance(500);  // 10 ms
  }
  EXPECT_THAT(writer.film().times_s, ElementsAre(0, DoubleEq(.01), DoubleEq(.02), DoubleEq(.03)));
  const std::string series = text_of(folder.path() / "film" / "trajectory.pvd");
  EXPECT_THAT(series, AllOf(HasSubstr("type=\"Collection\""),
                            HasSubstr("timestep=\"0\" part=\"0\" file=\"frame_00001.vtp\""),
                            HasSubstr("file=\"frame_00004.vtp\"")));
  EXPECT_EQ(read_state(folder.path() / "film" / "frame_00003.vtp").checkpoint.step, 1000);
}

TEST(Trajectory, ASecondSimulationIsShownAfterTheFirst) {
  const TemporaryFolder folder;
  TrajectoryWriter writer(folder.path(), .01, "{}");
  Simulation first = heap(1);
  first.advance(1000);  // 20 ms
  writer.add(first);
  writer.add(heap(1));
  EXPECT_THAT(text_of(folder.path() / "trajectory.pvd"), HasSubstr("timestep=\"0.03\""));
}

TEST(Trajectory, GoesOnFromAnotherWriter) {
  const TemporaryFolder folder;
  Simulation simulation = heap(1);
  TrajectoryWriter before(folder.path(), .01, "{}");
  before.add(simulation);
  simulation.advance(500);
  TrajectoryWriter(folder.path(), .01, "{}", before.film()).add(simulation);
  EXPECT_THAT(text_of(folder.path() / "trajectory.pvd"),
              AllOf(HasSubstr("timestep=\"0\" part=\"0\" file=\"frame_00001.vtp\""),
                    HasSubstr("timestep=\"0.01\" part=\"0\" file=\"frame_00002.vtp\"")));
}

TEST(Trajectory, ImpossibleOnesAreRefused) {
  const TemporaryFolder folder;
  folder.write("file", std::string("in the way"));
  EXPECT_THROW(TrajectoryWriter(folder.path(), 0, ""), base::InputError);
  EXPECT_THROW(TrajectoryWriter(folder.path() / "file", 1, ""), base::InputError);
}

}  // namespace
}  // namespace repose::dem
