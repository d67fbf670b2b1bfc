#include "cli/calibrate/calibrate_command.h"

#include <memory>

#include "cli/calibrate/calibrate.h"

namespace repose::cli {
namespace {

constexpr const char* kCalibrateNotes = R"(
STUDY is a study file in which contact coefficients have bounds instead of a
value, as in restitution = { min = 0.1, max = 0.6 }, and experiments state what
was measured. All unknowns are fitted to all measurements at once; each gets an
interval and a verdict: determined, bounded, one-sided, or undetermined by these
data. The best fit is then simulated with fresh seeds; these runs enter the fit too,
and a verdict says whether bench and simulation agree: agrees, disagrees, or
cannot tell.

Simulations are saved in --out: the same command resumes an interrupted study,
and a study with other bounds or measurements reuses them. The same study gives
the same result with any number of --jobs.

Methods:
  joint     all unknowns fitted to all measurements at once, with intervals
  paper     a published calibration procedure: point estimates, for comparison

Budgets:
  quick     14 minutes on one core for the fit
  standard  125 minutes on one core for the fit
  paper     at most 62 simulations, the number of a published calibration
The minutes are estimates for heaps of a few hundred grains; verification is
extra. --dry-run times one run of each experiment, for at most 20 seconds each,
and reports what each budget would simulate and how long it takes. It needs the
bench readings, and saves nothing.

--rolling-models constant_torque,elastic_plastic calibrates the study with each
of them, in folders of their own, and says which one explains the bench readings
best: their means, and how much they scatter.

Examples:
  repose calibrate study.toml --dry-run
  repose calibrate study.toml
  repose calibrate study.toml --rolling-models constant_torque,elastic_plastic
  repose calibrate study.toml --budget standard --jobs 8 --out hazelnut
)";

}  // namespace

Command calibrate_command() {
  const auto given = std::make_shared<CalibrateArguments>();
  return {
      .name = "calibrate",
      .summary = "Calibrate a study's coefficients",
      .options = {{"study", "STUDY.toml", "Study file", &given->study, true},
                  {"--budget", "quick|standard|paper", "Limit on the simulations (quick)",
                   &given->budget},
                  {"--method", "joint|paper", "Method of calibration (joint)", &given->method},
                  {"--rolling-models", "A,B", "Fit the study with each, and compare them",
                   &given->rolling_models},
                  {"--set", "KEY=VALUE", "Replace a value of the study; repeatable",
                   &given->settings},
                  {"--jobs", "N", "Simulations in parallel (all cores)", &given->jobs},
                  {"--out", "FOLDER", "Output folder (STUDY_calibration)", &given->out_folder},
                  {"--dry-run", "", "Only estimate how long each budget takes", &given->is_dry_run},
                  {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kCalibrateNotes,
      .missing = "no study file given. Fix: repose calibrate STUDY.toml.",
      .fields = kCalibrateFields,
      .run = [given] { return run_calibrate(*given); }};
}

}  // namespace repose::cli
