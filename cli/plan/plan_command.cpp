#include "cli/plan/plan_command.h"

#include <memory>

#include "cli/plan/plan.h"

namespace repose::cli {
namespace {

constexpr const char* kPlanNotes = R"(
Which experiments would determine the coefficients that a study seeks? Simulates
every experiment that repose offers, those of the study as it describes them and
the others in the usual way, all over the bounds of the coefficients, and prints
  - what each experiment tells: by how many of its uncertainties its mean
    reading changes while a coefficient goes from bound to bound
  - the smallest set of experiments that would determine what is open, and the
    95 % interval of each coefficient to be expected with it
  - what to add to the study for them
Experiments that the study has readings of count as done; none need have any.

Simulations are saved in --out: an interrupted plan is resumed by the same
command, and repose calibrate uses them too.

Examples:
  repose plan study.toml
  repose plan study.toml --experiments pendulum,fill,draw_down --readings 20
)";

}  // namespace

Command plan_command() {
  const auto given = std::make_shared<PlanArguments>();
  return {
      .name = "plan",
      .summary = "Find out which experiments to do",
      .options =
          {{"study", "STUDY.toml", "Study file", &given->study, true},
           {"--set", "KEY=VALUE", "Replace a value of the study; repeatable", &given->settings},
           {"--experiments", "A,B,...", "Experiments that you could do (all)", &given->experiments},
           {"--readings", "N", "Readings of each experiment to be done (10)", &given->readings},
           {"--minutes", "M", "Simulate for about M minutes of one core (15)", &given->minutes},
           {"--jobs", "N", "Simulations in parallel (all cores)", &given->jobs},
           {"--out", "FOLDER", "Output folder (STUDY_calibration)", &given->out_folder},
           {"--json", "FILE|-", "The plan, for programs", &given->json_file}},
      .notes = kPlanNotes,
      .missing = "no study file given. Fix: repose plan STUDY.toml.",
      .run = [given] { return run_plan(*given); }};
}

}  // namespace repose::cli
