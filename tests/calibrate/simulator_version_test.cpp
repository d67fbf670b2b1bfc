#include "calibrate/experiment/simulator_version.h"

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/fingerprint.h"
#include "calibrate/experiment/simulate_experiment.h"
#include "dem/experiment/experiment_table.h"
#include "tests/support/soft_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;

/// Soft grains of two spheres, rough enough for a visible heap of 240: takes a few seconds.
const std::string kStudyOfAllExperiments =
    repose::testing::kSoftNuts + repose::testing::kRoughContacts + R"([experiment.drop]
height_mm = 50
grains = 2
[experiment.tilt]
rate_deg_s = 10
[experiment.roll]
release_mm = 20
[experiment.heap]
grains = 240
lift_speed_mm_s = 100
[experiment.drop_on_grains]
height_mm = 50
grains = 2
[experiment.tilt_on_grains]
rate_deg_s = 10
places = 2
[experiment.roll_on_grains]
rate_deg_s = 10
places = 2
[experiment.fill]
tube_diameter_mm = 95
tube_height_mm = 95
taps = 1
[experiment.pendulum]
pairs = 2
[experiment.draw_down]
length_mm = 350
depth_mm = 92
slot_mm = 160
fill_mm = 92
drop_mm = 175
)";

/// Expected for kSimulatorVersion from the runs above: fingerprints of all readings of the usual
/// experiments, and of those of the others.
constexpr std::string_view kSimulatorReadings = "760116b8-d7de-5b3d-81b4-4f61497c97dd";
constexpr std::string_view kOtherReadings = "f0fa1305-1b13-586d-bad1-a5ac10e6b6a0";

/// Ten digits; 0 below 1e-9, as there the libraries of two machines may differ.
std::string ten_digits(double value) {
  return fmt::format("{:.9e}", std::abs(value) < 1e-9 ? 0 : value);
}

std::string line_of(const RunResult& run) {
  std::string line = "value " + ten_digits(run.value.value());
  // Drawing and measuring differ in edge pixels between types of processor.
  const auto seen = [](double value) { return fmt::format("{:.2f}", value); };
  for (const auto& [name, value] : run.readings) {
    const bool is_seen = name == "upper_angle_deg" || name == "lower_angle_deg";
    line += ' ' + name + ' ';
    line += !value ? "nan" : is_seen ? seen(*value) : ten_digits(*value);
  }
  if (!run.views.empty()) line += " seen " + seen(value_of(run).value());
  return line;
}

/// Whether the study gives the key that the reading requires.
bool has_key(const dem::Study& study, const dem::ExperimentEntry& entry, std::string_view needed) {
  if (needed.empty()) return true;
  dem::Protocol protocol = study.experiments.at(&entry).protocol;
  for (const dem::ProtocolKey& key : entry.keys(protocol)) {
    if (key.name == needed) return dem::value_of(key).has_value();
  }
  return false;
}

TEST(SimulatorVersion, IsRaisedWhenWhatASimulationGivesHasChanged) {
  const TemporaryFolder folder;
  const dem::Study study = dem::read_study(folder.write("study.toml", kStudyOfAllExperiments));
  const NamedGrain grain(dem::build_grain(study.grain));
  std::vector<std::string> lines, others;
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    const RunResult run = simulate_experiment(spec_of(study, &entry, grain, kHeapViews), 1);
    EXPECT_TRUE(run.failure.empty()) << entry.name << ": " << run.failure;
    EXPECT_EQ(is_from_pictures(run), entry.is_pictured) << entry.name;
    std::vector<std::string> given, known;
    for (const auto& [name, value] : run.readings) given.push_back(name);
    for (const dem::Reading& reading : entry.readings) {
      if (has_key(study, entry, reading.needs)) known.emplace_back(reading.name);
    }
    EXPECT_THAT(given, ::testing::UnorderedElementsAreArray(known)) << "as its entry says";
    (entry.is_default ? lines : others).push_back(std::string(entry.name) + ' ' + line_of(run));
  }
  constexpr const char* kChanged =
      "what a simulation gives has changed: raise kSimulatorVersion and store the new hash above; "
      "or there is a new experiment: store the new hash\n";
  EXPECT_EQ(base::fingerprint(lines), kSimulatorReadings)
      << kChanged << ::testing::PrintToString(lines);
  EXPECT_EQ(base::fingerprint(others), kOtherReadings)
      << kChanged << ::testing::PrintToString(others);
}

}  // namespace
}  // namespace repose::calibrate
