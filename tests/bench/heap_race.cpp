#include "tests/bench/heap_race.h"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "calibrate/experiment/heap_angle.h"
#include "calibrate/export/export.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/study/grain_source.h"
#include "dem/study/study.h"
#include "render/scene/scene.h"
#include "tests/bench/clock.h"
#include "tests/peers/exported.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace repose::bench {
namespace {

using calibrate::ExportTarget;

constexpr int kViews = 18;
/// Factor on the exported deck's step, which is half of our shortest. Gives the step at which heaps
/// are simulated with LIGGGHTS: .175 of the stable one.
constexpr double kLongerSteps = 5;

/// The same deck in longer steps; its runs keep their durations. It ends when its heap is at rest.
std::string in_longer_steps(const std::string& deck) {
  std::istringstream lines(deck);
  std::string longer;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string command, name, style;
    double number = 0;
    words >> command;
    if (command == "variable" && words >> name >> style >> number && name == "dt") {
      line = fmt::format("variable dt equal {:.17g}", kLongerSteps * number);
    } else if (command == "run" && words >> number) {
      line = fmt::format("run {:.0f}", std::ceil(number / kLongerSteps));
    }
    longer += line + '\n';
  }
  return longer;
}

/// The values that the study gives to its coefficients.
std::vector<calibrate::FittedValue> values_of(const dem::Study& study) {
  std::vector<calibrate::FittedValue> values;
  for (const calibrate::NamedCoefficient& named : calibrate::coefficients_of(study)) {
    if (named.coefficient.value) {
      values.push_back({.name = named.name, .value = *named.coefficient.value});
    }
  }
  return values;
}

/// CPU time of LIGGGHTS's own heap.
double time_theirs(const calibrate::StudyExport& decks) {
  const testing::TemporaryFolder folder;
  for (const calibrate::ExportedFile& file : decks.files) {
    const bool is_heap = file.name == "heap.lig";
    folder.write(file.name, is_heap ? in_longer_steps(file.text) : file.text);
  }
  const double theirs_s = testing::run_deck(folder, calibrate::liggghts_target(), "heap").cpu_s;
  if (!std::filesystem::exists(folder.path() / "heap.dump")) {
    throw std::runtime_error("LIGGGHTS ended before its heap was written");
  }
  return theirs_s;
}

}  // namespace

HeapTimes race_heaps(const std::vector<std::string>& settings, int rounds) {
  std::vector<std::string> all = {"contact.rolling_model=\"relative_constant_torque\""};
  all.insert(all.end(), settings.begin(), settings.end());
  const dem::Study study =
      dem::read_study(testing::source_folder() / "samples/hazelnut/study.toml", all);
  dem::Model model = dem::model_for(study, dem::experiment_of<dem::HeapProtocol>());
  model.grain = dem::build_grain(study.grain).shape;
  model.threads = 1;
  const auto protocol = study.protocol<dem::HeapProtocol>();
  const calibrate::StudyExport decks =
      calibrate::export_study(study, model.grain, values_of(study),
                              {.target = calibrate::liggghts_target(), .takes_approximate = true});
  HeapTimes times;
  for (int round = 0; round < rounds; ++round) {
    const double start = cpu_s();
    const dem::Repeat ours = dem::run_heap(model, protocol, static_cast<std::uint64_t>(round) + 1);
    const double done = cpu_s();
    times.ours_s.push_back(done - start);
    measure_views(calibrate::HeapViewSession(render::scene_of(*ours.state), {.views = kViews}), 1,
                  [](double /*fraction*/) { return true; });
    times.views_s.push_back(cpu_s() - done);
    times.grains = static_cast<int>(ours.readings.at("grains"));
    if (testing::has_program_for(calibrate::liggghts_target())) {
      times.theirs_s.push_back(time_theirs(decks));
    }
  }
  return times;
}

}  // namespace repose::bench
