// LIGGGHTS as an engine: it runs our experiments; its results are read back and compared with ours.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/experiment/run_spec.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "calibrate/simulators/simulators.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/tilt.h"
#include "dem/state/state_file.h"
#include "dem/study/grain_source.h"
#include "tests/peers/exported.h"
#include "tests/peers/liggghts.h"
#include "tests/support/soft_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::testing {
namespace {

using calibrate::RunResult;

constexpr const char* kShort = R"([experiment.drop]
height_mm = 50
grains = 6
[experiment.tilt]
rate_deg_s = 10
[experiment.roll]
release_mm = 60
[experiment.heap]
tube_diameter_mm = 90
tube_height_mm = 220
plate_mm = 400
grains = 120
lift_speed_mm_s = 100
[experiment.fill]
tube_diameter_mm = 95
tube_height_mm = 95
[experiment.pendulum]
pairs = 2
[experiment.roll_on_grains]
rate_deg_s = 10
places = 2
)";

class LiggghtsSimulator : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    static const bool is_there = has_liggghts();
    if (!is_there) GTEST_SKIP() << kNoLiggghts;
  }

  dem::Study study(const std::string& grain = kSoftNuts) const {
    return dem::read_study(folder_.write(
        "study.toml",
        grain + "[contact]\nrolling_model = \"" + model() + "\"\n" + kRoughContacts + kShort));
  }
  virtual std::string model() const { return "elastic_plastic"; }

  /// Our run and theirs.
  static std::vector<RunResult> both(const dem::Study& study, const char* experiment,
                                     std::uint64_t seed = 1) {
    const calibrate::NamedGrain grain(dem::build_grain(study.grain));
    calibrate::RunSpec spec =
        spec_of(study, &dem::experiment_named(experiment), grain, calibrate::kHeapViews);
    std::vector<RunResult> runs = {simulate_experiment(spec, seed)};
    spec.simulator = calibrate::liggghts_simulator({.program = "liggghts", .timeout_s = {}});
    runs.push_back(simulate_experiment(spec, seed));
    for (const RunResult& run : runs) EXPECT_EQ(run.failure, "") << experiment;
    return runs;
  }

  TemporaryFolder folder_;
};

class LiggghtsLaws : public LiggghtsSimulator {
 protected:
  std::string model() const override { return GetParam(); }

  /// With procedure and material of the export tests. On a steeper plate, and with softer grains,
  /// grains with cdt creep and those with epsd hop, differently in the two programs.
  static dem::Study as_exported(dem::Study study) {
    const dem::Study shorter = short_study(study.model.rolling);
    study.model = shorter.model;
    study.experiments = shorter.experiments;
    study.experiments.at(&dem::experiment_named("tilt")).protocol = dem::TiltProtocol{};
    return study;
  }
};

// With epsd, sliding begins in both at the friction angle, atan(.4) = 21.80 degrees. With cdt the
// body trembles: its contacts stick again and again, and then the tangential damper of LIGGGHTS
// adds to a spring at Coulomb's limit, which holds the body up to .19 degrees longer, by .09 to .2
// in steps of 4 to 34 us. With `tangential_damping off`, set by hand, it slid at 21.78 degrees.
TEST_P(LiggghtsLaws, TiltIsReadAtItsOnset) {
  constexpr double kTolerance_deg = .1;
  const double held_deg = GetParam() == "elastic_plastic" ? 0 : .2;
  const auto runs = both(as_exported(study()), "tilt");
  const double onset_deg = std::atan(.4) * 180 / M_PI;
  EXPECT_NEAR(runs[0].value.value(), onset_deg, kTolerance_deg);
  EXPECT_GT(runs[1].value.value(), onset_deg - kTolerance_deg);
  EXPECT_LT(runs[1].value.value(), onset_deg + held_deg + kTolerance_deg);
  EXPECT_NEAR(runs[1].readings.at("half_mm_slip_deg"),
              runs[0].readings.at("half_mm_slip_deg") + held_deg / 2,
              kTolerance_deg + held_deg / 2);
}

// The same grains in the same poses: balls, whose dampers give the same rebound.
TEST_P(LiggghtsLaws, BallsReboundAndRollAlike) {
  const dem::Study balls = as_exported(study(kSoftBalls));
  const auto drops = both(balls, "drop");
  EXPECT_NEAR(drops[1].value.value(), drops[0].value.value(), .06 * drops[0].value.value());
  EXPECT_EQ(drops[1].readings.at("never_rose"), 0);
  const auto rolls = both(balls, "roll");
  EXPECT_NEAR(rolls[1].value.value(), rolls[0].value.value(), .05 * rolls[0].value.value() + 1);
}

INSTANTIATE_TEST_SUITE_P(Rolling, LiggghtsLaws,
                         ::testing::Values("relative_constant_torque", "elastic_plastic"));

TEST_F(LiggghtsSimulator, HeapIsReadBackRenderedAndMeasuredAsOurs) {
  const dem::Study nuts = study();
  const calibrate::NamedGrain grain(dem::build_grain(nuts.grain));
  calibrate::RunSpec spec =
      spec_of(nuts, &dem::experiment_named("heap"), grain, calibrate::kHeapViews);
  spec.simulator = calibrate::liggghts_simulator({.program = "liggghts", .timeout_s = {}});
  const calibrate::RunStore store(folder_.path());
  const calibrate::SimulateOptions options{
      .folder = &store, .saves_state = true, .trajectory = {}, .report = {}};
  const RunResult heap = simulate_experiment(spec, 3, options);
  EXPECT_EQ(heap.failure, "");
  EXPECT_EQ(heap.picture_error, "");
  EXPECT_EQ(heap.views.size(), static_cast<std::size_t>(calibrate::kHeapViews));
  EXPECT_EQ(heap.readings.at("grains"), 120);
  EXPECT_EQ(heap.readings.at("grains_on_plate") + heap.readings.at("grains_off_plate"), 120);
  EXPECT_NEAR(value_of(heap).value(), heap.value.value(), 4);
  // Grains in the poses of a heap at rest: none overlaps deeply with another or with the plate.
  const dem::SavedState state = dem::read_state(store.state_file(spec, 3));
  dem::Simulation simulation(state.setup, state.checkpoint);
  EXPECT_EQ(simulation.grain_count(), heap.readings.at("grains_on_plate"));
  simulation.advance(1);
  EXPECT_LT(simulation.deepest_overlap(), .05);
  // Found again, but only by its own simulator.
  EXPECT_EQ(text_of(simulate_experiment(spec, 3, options)), text_of(heap));
  spec.simulator = calibrate::own_simulator();
  EXPECT_FALSE(store.find(spec, 3));
}

// Grains so soft that most fall through the plate.
TEST_F(LiggghtsSimulator, GrainsThatFallThroughThePlateAreCounted) {
  dem::Study balls = study(kSoftBalls);
  balls.model.grain_material.young_modulus_pa = 500;
  calibrate::RunSpec spec = spec_of(balls, &dem::experiment_named("heap"),
                                    calibrate::NamedGrain(dem::build_grain(balls.grain)), 0);
  spec.simulator = calibrate::liggghts_simulator({.program = "liggghts", .timeout_s = {}});
  const RunResult heap = simulate_experiment(spec, 1);
  EXPECT_FALSE(heap.value);
  EXPECT_THAT(heap.failure,
              ::testing::ContainsRegex("[0-9]+ of 120 grains were lost while the tube was filled"));
}

TEST_F(LiggghtsSimulator, GrainsThatFallOffThePlateAreCounted) {
  dem::Study balls = study(kSoftBalls);
  dem::Protocol& protocol = balls.experiments.at(&dem::experiment_named("heap")).protocol;
  protocol.as<dem::HeapProtocol>().plate_m = .15;
  calibrate::RunSpec spec = spec_of(balls, &dem::experiment_named("heap"),
                                    calibrate::NamedGrain(dem::build_grain(balls.grain)), 0);
  spec.simulator = calibrate::liggghts_simulator({.program = "liggghts", .timeout_s = {}});
  const RunResult heap = simulate_experiment(spec, 1);
  EXPECT_EQ(heap.failure, "");
  EXPECT_GT(heap.readings.at("grains_off_plate"), 5);
  EXPECT_EQ(heap.readings.at("grains_on_plate") + heap.readings.at("grains_off_plate"), 120);
}

// A grain finds no room if it would lie across the border of two processes: it is inserted later.
TEST_F(LiggghtsSimulator, SeveralProcessesPutAllGrainsIn) {
  if (run_program("mpirun", {}, {"--version"}).exit_code != 0) {
    GTEST_SKIP() << "mpirun is not installed; nothing was compared. Fix: apt-get install "
                    "openmpi-bin";
  }
  // Otherwise it refuses to run as root, the usual user in containers.
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  const dem::Study nuts = study();
  calibrate::RunSpec spec = spec_of(nuts, &dem::experiment_named("heap"),
                                    calibrate::NamedGrain(dem::build_grain(nuts.grain)), 0);
  spec.simulator =
      calibrate::liggghts_simulator({.program = "liggghts", .processes = 2, .timeout_s = {}});
  const RunResult heap = simulate_experiment(spec, 1);
  EXPECT_EQ(heap.failure, "");
  EXPECT_EQ(heap.readings.at("grains"), 120);
}

TEST_F(LiggghtsSimulator, TheSameSeedGivesTheSameHeapAndAnotherAnother) {
  const dem::Study balls = study(kSoftBalls);
  const calibrate::NamedGrain grain(dem::build_grain(balls.grain));
  calibrate::RunSpec spec = spec_of(balls, &dem::experiment_named("heap"), grain, 0);
  spec.simulator = calibrate::liggghts_simulator({.program = "liggghts", .timeout_s = {}});
  const auto value = [&](std::uint64_t seed) { return simulate_experiment(spec, seed).value; };
  const auto first = value(1);
  EXPECT_EQ(value(1), first);
  EXPECT_NE(value(2), first);
}

TEST_F(LiggghtsSimulator, OtherExperimentsAreReadBack) {
  const dem::Study nuts = study();
  const auto fills = both(nuts, "fill");
  EXPECT_NEAR(fills[1].value.value(), fills[0].value.value(), .08 * fills[0].value.value());
  EXPECT_NEAR(fills[1].readings.at("solid_fraction"), fills[1].value.value() / 850, 1e-6);
  const auto swings = both(nuts, "pendulum");
  EXPECT_NEAR(swings[1].value.value(), swings[0].value.value(), 1);
  const auto bodies = both(nuts, "roll_on_grains");
  EXPECT_NEAR(bodies[1].value.value(), bodies[0].value.value(), 3);
}

}  // namespace
}  // namespace repose::testing
