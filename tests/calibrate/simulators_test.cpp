#include "calibrate/simulators/simulators.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/fingerprint.h"
#include "base/input_error.h"
#include "calibrate/experiment/run_spec.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/target_entry.h"
#include "dem/experiment/drop.h"
#include "dem/study/grain_source.h"
#include "tests/support/error_of.h"
#include "tests/support/soft_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::TemporaryFolder;

/// Makes only the programs of these tests available in PATH, plus the shell's builtins.
class OnlyPrograms {
 public:
  OnlyPrograms() : before_(std::getenv("PATH")) {
    const std::string path = folder_.path().string();
    ::setenv("PATH", path.c_str(), 1);
  }
  ~OnlyPrograms() { ::setenv("PATH", before_.c_str(), 1); }
  OnlyPrograms(const OnlyPrograms&) = delete;
  OnlyPrograms& operator=(const OnlyPrograms&) = delete;
  OnlyPrograms(OnlyPrograms&&) = delete;
  OnlyPrograms& operator=(OnlyPrograms&&) = delete;

  void add(const std::string& name, const std::string& script) const {
    const fs::path file = folder_.write(name, "#!/bin/sh\n" + script + "\n");
    fs::permissions(file, fs::perms::owner_exec, fs::perm_options::add);
  }

 private:
  std::string before_;
  TemporaryFolder folder_;
};

constexpr const char* kBanner = "echo 'LIGGGHTS (Version LIGGGHTS-PUBLIC 3.8.0, compiled by us)'";

dem::EngineChoice liggghts(int processes = 1) {
  return {.program = "liggghts", .processes = processes, .timeout_s = {}};
}

class SimulatorsTest : public ::testing::Test {
 protected:
  SimulatorsTest() {
    programs_.add("liggghts", kBanner);
    programs_.add("stdbuf", "shift; exec \"$@\"");
  }

  dem::Study study(const std::string& more, const std::string& contact = {}) const {
    return dem::read_study(
        folder_.write("study.toml", repose::testing::kSoftNuts + "[contact]\nrolling_model = \"" +
                                        (contact.empty() ? "relative_constant_torque" : contact) +
                                        "\"\n" + repose::testing::kRoughContacts + more));
  }

  /// Why the study's experiment is rejected; empty if it is not.
  static std::string refused(const dem::Study& study,
                             const dem::EngineChoice& choice = liggghts()) {
    const NamedGrain grain(dem::build_grain(study.grain));
    std::vector<base::Fault> faults;
    const auto simulator = liggghts_simulator(choice);
    for (const auto& [experiment, described] : study.experiments) {
      const auto found = simulator->refusals(spec_of(study, experiment, grain, 0));
      faults.insert(faults.end(), found.begin(), found.end());
    }
    return base::text_of(faults);
  }

  OnlyPrograms programs_;
  TemporaryFolder folder_;
};

TEST_F(SimulatorsTest, AreOursUnlessAStudyAsksForAnother) {
  EXPECT_EQ(simulator_for(study("[experiment.drop]\n")), own_simulator());
  const auto other = simulator_for(study("[experiment.drop]\n[engine]\nprogram = \"liggghts\"\n"));
  EXPECT_EQ(other->title(), "LIGGGHTS-PUBLIC 3.8.0");
}

TEST_F(SimulatorsTest, AnUnknownOneIsAnErrorThatNamesTheNearest) {
  EXPECT_THAT(
      error_of(
          [&] { simulator_for(study("[experiment.drop]\n[engine]\nprogram = \"ligghts\"\n")); }),
      AllOf(HasSubstr("engine.program = \"ligghts\" is not known"),
            HasSubstr("Rule: repose or liggghts"), HasSubstr("Fix: program = \"liggghts\".")));
}

TEST_F(SimulatorsTest, KeysOfTheEngineAreChecked) {
  const auto error = [&](const std::string& key) {
    return error_of([&] { study("[experiment.drop]\n[engine]\n" + key + "\n"); });
  };
  EXPECT_THAT(error("processes = 0"), HasSubstr("engine.processes = 0"));
  EXPECT_THAT(error("launcher = \"rsh\""), HasSubstr("mpirun or srun"));
  EXPECT_THAT(error("timeout_s = -1"), HasSubstr("engine.timeout_s"));
  EXPECT_THAT(error("command = \"run\""), HasSubstr("engine.command"));
  EXPECT_THAT(error("approximate = 1"), HasSubstr("engine.approximate"));
}

TEST(Liggghts, ThatIsNotInstalledIsAnErrorThatSaysHowToGetIt) {
  const OnlyPrograms none;
  EXPECT_THAT(error_of([] { liggghts_simulator(liggghts()); }),
              AllOf(HasSubstr("is not installed, or does not start"),
                    HasSubstr("Fix: apt-get install liggghts")));
  const OnlyPrograms another;
  another.add("liggghts", "echo something else");
  EXPECT_THAT(error_of([] { liggghts_simulator(liggghts()); }), HasSubstr("not installed"));
}

TEST_F(SimulatorsTest, SeveralProcessesNeedTheirLauncher) {
  EXPECT_THAT(error_of([] { liggghts_simulator(liggghts(2)); }),
              AllOf(HasSubstr("engine.launcher = \"mpirun\" is not installed"),
                    HasSubstr("processes = 1")));
  programs_.add("mpirun", "echo mpirun 4");
  EXPECT_EQ(liggghts_simulator(liggghts(2))->title(), "LIGGGHTS-PUBLIC 3.8.0, 2 processes");
}

TEST_F(SimulatorsTest, TakesWhatLiggghtsHas) {
  EXPECT_EQ(refused(study("[experiment.drop]\n[experiment.tilt]\n[experiment.roll]\n"
                          "[experiment.heap]\n[experiment.fill]\n[experiment.pendulum]\n"
                          "[experiment.drop_on_grains]\n[experiment.tilt_on_grains]\n"
                          "[experiment.roll_on_grains]\n")),
            "");
  EXPECT_EQ(refused(study("[experiment.heap]\n", "elastic_plastic")), "");
}

TEST_F(SimulatorsTest, RefusesWhatLiggghtsHasNot) {
  const auto error = [&](const std::string& more, const std::string& rolling = {}) {
    return refused(study(more, rolling));
  };
  EXPECT_THAT(error("[experiment.draw_down]\n"),
              AllOf(HasSubstr("experiment.draw_down cannot be simulated with LIGGGHTS"),
                    HasSubstr("Fix: simulate it with our own engine")));
  EXPECT_THAT(error("[experiment.fill]\ntaps = 3\n"), HasSubstr("without taps"));
  EXPECT_THAT(error("[experiment.drop]\nlow_height_mm = 50\n"), HasSubstr("drop from one height"));
  EXPECT_THAT(error("[experiment.drop]\n[simulation]\ntimestep_s = 1e-6\n"),
              HasSubstr("would have no effect"));
  EXPECT_THAT(error("[experiment.drop]\n", "constant_torque"),
              AllOf(HasSubstr("particle_wall.rolling_friction"),
                    HasSubstr("has no exact counterpart"), HasSubstr("approximate = true")));
  dem::Study varied = study("[experiment.heap]\n");
  varied.model.size_cv = .05;
  EXPECT_THAT(refused(varied), HasSubstr("particle.size_sd_percent = 5"));
  dem::Study shared = study("[experiment.heap]\n");
  shared.model.damping = dem::DampingModel::shared;
  EXPECT_THAT(refused(shared), HasSubstr("contact.damping"));
}

TEST_F(SimulatorsTest, TakesAnApproximationThatIsAskedFor) {
  dem::EngineChoice choice = liggghts();
  choice.takes_approximate = true;
  EXPECT_EQ(refused(study("[experiment.roll]\n", "constant_torque"), choice), "");
}

TEST_F(SimulatorsTest, AFitIsRefusedWhereItsBoundsOrReadingsAre) {
  dem::Study sought = study(
      "[experiment.drop]\n[experiment.drop.also_measured]\n"
      "lowest_point_rise_mm = { mean = 10, sd = 1, n = 5 }\n");
  sought.particle_wall.restitution = {
      .value = .3, .min = .02, .max = .9, .known_mean = {}, .known_sd = {}};
  const auto grain = dem::build_grain(sought.grain).shape;
  const auto simulator = liggghts_simulator(liggghts());
  EXPECT_THAT(error_of([&] { check_for_fit(*simulator, sought, grain); }),
              AllOf(HasSubstr("particle_wall.restitution = 0.02"),
                    HasSubstr("accepts only values above .05"),
                    HasSubstr("also_measured.lowest_point_rise_mm is no reading")));
  sought = study("[experiment.drop]\n");
  EXPECT_THAT(check_for_fit(*simulator, sought, grain),
              ::testing::Contains(HasSubstr("damper may pull")));
}

TEST_F(SimulatorsTest, RunsOfAnotherProgramAreNeverTakenForOurs) {
  programs_.add("mpirun", "echo mpirun 4");
  const dem::Study both = study("[experiment.drop]\n[experiment.heap]\n");
  const NamedGrain grain(dem::build_grain(both.grain));
  const auto key = [&](const char* name, std::shared_ptr<const Simulator> simulator) {
    RunSpec spec = spec_of(both, &dem::experiment_named(name), grain, 0);
    spec.simulator = std::move(simulator);
    return key_of(spec, 1);
  };
  const auto one = liggghts_simulator(liggghts(1)), two = liggghts_simulator(liggghts(2));
  EXPECT_NE(key("heap", one), key("heap", own_simulator()));
  // Grains take different paths if sums are taken in a different order.
  EXPECT_NE(key("heap", one), key("heap", two));
  EXPECT_EQ(key("drop", one), key("drop", two));
}

TEST_F(SimulatorsTest, ARunThatFailsStopsWithWhatItPrinted) {
  programs_.add("liggghts", std::string(kBanner) + "; [ $2 = /dev/null ] || exit 1");
  const dem::Study tilt = study("[experiment.tilt]\n");
  RunSpec spec =
      spec_of(tilt, &dem::experiment_named("tilt"), NamedGrain(dem::build_grain(tilt.grain)), 0);
  spec.simulator = liggghts_simulator(liggghts());
  const RunStore store(folder_.path());
  EXPECT_THAT(
      error_of([&] {
        simulate_experiment(spec, 1, {.folder = &store, .trajectory = {}, .report = {}});
      }),
      AllOf(HasSubstr("LIGGGHTS-PUBLIC 3.8.0 failed: exit code 1"), HasSubstr("compiled by us")));
  EXPECT_TRUE(fs::exists(store.work_folder(spec, 1) / "tilt.lig"));
  EXPECT_FALSE(store.find(spec, 1));
}

TEST_F(SimulatorsTest, AProgramThatLeavesNoReadingIsAnError) {
  const dem::Study tilt = study("[experiment.roll]\n");
  RunSpec spec =
      spec_of(tilt, &dem::experiment_named("roll"), NamedGrain(dem::build_grain(tilt.grain)), 0);
  spec.simulator = liggghts_simulator(liggghts());
  EXPECT_THAT(error_of([&] { simulate_experiment(spec, 1); }),
              HasSubstr("ended without the line \"reading: still_moved_m\""));
}

/// What a fake LIGGGHTS prints for a heap of balls, and what it leaves of it.
struct FakeHeap {
  int put_in = 30;
  int filled = 30;
  int under_plate = 0;
  double filled_m = .1;
  int left = 30;
  int announced = 30;
  std::string remark = {};
};

/// A pyramid of balls of 18 mm, 4 x 4, 3 x 3, 2 x 2 and 1, without the first ones of the lowest
/// layer.
std::string rows_of_pyramid(int count) {
  constexpr int kBalls = 30;
  constexpr double kRadius = .009;
  std::string rows;
  int number = 0;
  for (int side = 4; side > 0; --side) {
    const double height = kRadius + (4 - side) * kRadius * std::sqrt(2.);
    for (int k = 0; k < side * side; ++k) {
      const auto place = [&](int at) { return kRadius * (2 * at - side + 1); };
      if (++number <= kBalls - count) continue;
      rows += fmt::format("{} 1 {:.6f} {:.6f} {:.6f} {}\n", number, place(k % side),
                          place(k / side), height, kRadius);
    }
  }
  return rows;
}

class LostGrains : public SimulatorsTest {
 protected:
  /// The heap made by such a program.
  RunResult heap_of(const FakeHeap& heap) const {
    const std::string dump = fmt::format(
        "ITEM: TIMESTEP\n9\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ff ff ff\n-1 1\n-1 1\n"
        "-1 1\nITEM: ATOMS id type x y z radius\n{}",
        heap.announced, rows_of_pyramid(heap.left));
    const std::string said = fmt::format(
        "reading: inserted_grains {}\nreading: filled_spheres {}\nreading: filled_m {}\n"
        "reading: spheres_under_plate {}\nreading: moved_m 0\nreading: steps 1000\n{}\n",
        heap.put_in, heap.filled, heap.filled_m, heap.under_plate, heap.remark);
    programs_.add("liggghts", std::string(kBanner) + "\n[ $2 = /dev/null ] && exit\necho '" + said +
                                  "'\necho '" + dump + "' > heap.dump");
    const dem::Study balls = dem::read_study(
        folder_.write("study.toml", repose::testing::kSoftBalls + repose::testing::kRoughContacts +
                                        "[contact]\nrolling_model = \"elastic_plastic\"\n"
                                        "[experiment.heap]\ntube_diameter_mm = 90\n"
                                        "tube_height_mm = 220\nplate_mm = 400\ngrains = 30\n"));
    RunSpec spec = spec_of(balls, &dem::experiment_named("heap"),
                           NamedGrain(dem::build_grain(balls.grain)), 0);
    spec.simulator = liggghts_simulator(liggghts());
    return simulate_experiment(spec, 1);
  }
};

TEST_F(LostGrains, NoneAreMissingWhereAllLieOnThePlate) {
  const RunResult heap = heap_of({});
  EXPECT_EQ(heap.failure, "");
  EXPECT_EQ(heap.readings.at("grains"), 30);
  EXPECT_EQ(heap.readings.at("grains_on_plate"), 30);
  EXPECT_EQ(heap.readings.at("grains_off_plate"), 0);
}

TEST_F(LostGrains, ThatFellOffThePlateAreCounted) {
  const RunResult heap = heap_of({.left = 28, .announced = 28});
  EXPECT_EQ(heap.failure, "");
  EXPECT_EQ(heap.readings.at("grains"), 30);
  EXPECT_EQ(heap.readings.at("grains_on_plate"), 28);
  EXPECT_EQ(heap.readings.at("grains_off_plate"), 2);
}

TEST_F(LostGrains, OfTheFillingAreARunWithoutAReading) {
  EXPECT_THAT(heap_of({.filled = 27}).failure,
              AllOf(HasSubstr("3 of 30 grains were lost while the tube was filled"),
                    HasSubstr("Fix: stiffer grains (young_modulus_pa is 1e+06")));
  EXPECT_THAT(heap_of({.put_in = 26, .filled = 26}).failure,
              AllOf(HasSubstr("put 26 of 30 grains into the tube"), HasSubstr("grains = 26")));
}

TEST_F(LostGrains, OfAFillAreARunWithoutAReading) {
  const auto fill_of = [&](const std::string& said) {
    programs_.add("liggghts",
                  std::string(kBanner) + "\n[ $2 = /dev/null ] && exit\necho '" + said + "'");
    const dem::Study nuts = study("[experiment.fill]\n");
    RunSpec spec =
        spec_of(nuts, &dem::experiment_named("fill"), NamedGrain(dem::build_grain(nuts.grain)), 0);
    spec.simulator = liggghts_simulator(liggghts());
    return simulate_experiment(spec, 1);
  };
  const std::string full = "reading: grains 80\nreading: bulk_density_kg_m3 500\n";
  // Two spheres per grain.
  EXPECT_EQ(fill_of(full + "reading: poured_grains 100\nreading: poured_spheres 200\n").value, 500);
  EXPECT_THAT(fill_of(full + "reading: poured_grains 100\nreading: poured_spheres 193\n").failure,
              HasSubstr("4 of 100 grains were lost"));
  EXPECT_THAT(fill_of("The grains do not reach the rim.").failure,
              HasSubstr("do not reach the tube's rim. Fix: a lower tube"));
}

TEST_F(LostGrains, ThroughThePlateAreARunWithoutAReading) {
  EXPECT_THAT(heap_of({.under_plate = 2, .left = 28, .announced = 28}).failure,
              HasSubstr("2 grains or more went through the plate"));
}

TEST_F(LostGrains, ThatAreAllAreARunWithoutAReading) {
  EXPECT_THAT(heap_of({.remark = "All grains left the plate."}).failure,
              HasSubstr("all 30 grains left the plate. Fix: a larger plate"));
  EXPECT_THAT(heap_of({.remark = "The grains hang in the tube."}).failure,
              HasSubstr("grains hang in the tube"));
}

TEST_F(LostGrains, OverTheRimAreARunWithoutAReading) {
  EXPECT_THAT(heap_of({.filled_m = .25}).failure,
              AllOf(HasSubstr("30 grains fill the tube to 250 mm, over its rim at 220 mm"),
                    HasSubstr("Fix: fewer grains")));
}

TEST_F(LostGrains, ThatTheDumpAnnouncesAreAnError) {
  EXPECT_THAT(error_of([&] { heap_of({.left = 28}); }), HasSubstr("is cut short: 28 rows of 30"));
}

}  // namespace
}  // namespace repose::calibrate
