#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"
#include "calibrate/result/candidates.h"
#include "calibrate/result/result_text.h"

namespace repose::calibrate::report {
namespace {

/// An assumed scatter counts as exactly known; otherwise the number of readings matters. The shared
/// part of the uncertainty counts as stated.
double bench_half_width(const ResultObservable& observable) {
  const double uncertainty = observable.measured_uncertainty;
  if (observable.sd_assumed) return half_width_95(uncertainty);
  const double shared = observable.systematic_uncertainty;
  const double by_scatter = std::sqrt(std::max(0., uncertainty * uncertainty - shared * shared));
  return std::hypot(half_width_95(by_scatter, bench_readings(observable) - 1),
                    half_width_95(shared));
}

/// The page's short table: measured and simulated values, the tolerance of their difference, and
/// the verdict.
Table brief_agreement_table(const JointResult& joint) {
  Table table{.name = {},
              .title =
                  "Measured and simulated means; ± is the half-width of the measured mean’s "
                  "95 % interval",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "measured", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "simulated", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    table.data.add({axis_of_observable(observable.name, observable.unit), cell(observable.measured),
                    cell(bench_half_width(observable)), cell(observable.verification->simulated),
                    name_of(observable.verification->verdict)});
  }
  return table;
}

Table brief_predictions_table(const JointResult& joint) {
  Table table{.name = {},
              .title =
                  "Held out: not fitted, but predicted from the fit; ± is the half-width of "
                  "the 95 % interval",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "measured", .unit = {}},
                                   {.name = "predicted", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const Prediction& prediction : joint.held_out) {
    table.data.add({axis_of_observable(prediction.name, prediction.unit), cell(prediction.measured),
                    cell(prediction.predicted),
                    cell((prediction.interval.high - prediction.interval.low) / 2),
                    name_of(prediction.verdict)});
  }
  return table;
}

/// All measured quantities, in full.
Table agreement_table(const JointResult& joint) {
  Table table{.name = "agreement",
              .title =
                  "Measured, fitted and simulated means; ± is the half-width of the 95 % "
                  "interval",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "measured", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "fit", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "fresh seeds", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "difference / σ", .unit = {}, .decimals = 1}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    const Agreement& checked = *observable.verification;
    table.data.add({axis_of_observable(observable.name, observable.unit), cell(observable.measured),
                    cell(bench_half_width(observable)), cell(observable.simulated),
                    cell(half_width_95(observable.simulated_uncertainty)), cell(checked.simulated),
                    cell(half_width_95(checked.simulated_uncertainty, checked.runs - 1)),
                    cell(checked.difference_sigma)});
  }
  return table;
}

/// For readings not simulated again: values from surfaces through the runs.
Table fitted_table(const JointResult& joint) {
  Table table{
      .name = "fitted",
      .title =
          "Measured means, and what surfaces through the runs give at the fitted parameters; "
          "± is the half-width of the 95 % interval",
      .data = {.columns = {{.name = "measured quantity", .unit = {}},
                           {.name = "measured", .unit = {}},
                           {.name = "±", .unit = {}},
                           {.name = "by the surface", .unit = {}},
                           {.name = "±", .unit = {}},
                           {.name = "difference / σ", .unit = {}, .decimals = 1}},
               .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    table.data.add({axis_of_observable(observable.name, observable.unit), cell(observable.measured),
                    cell(bench_half_width(observable)), cell(observable.simulated),
                    cell(half_width_95(observable.simulated_uncertainty)),
                    cell(observable.difference_sigma)});
  }
  return table;
}

Table reach_table(const JointResult& joint) {
  Table table{.name = "reach",
              .title = "Range that the simulation can reach within the bounds of the coefficients",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "measured", .unit = {}},
                                   {.name = "from", .unit = {}},
                                   {.name = "to", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    const std::string& unit = observable.unit;
    table.data.add({axis_of_observable(observable.name, unit), cell(observable.measured),
                    cell(readable(observable.reachable.low, unit)),
                    cell(readable(observable.reachable.high, unit))});
  }
  return table;
}

Table verdicts_table(const JointResult& joint) {
  Table table{.name = "agreement_verdicts",
              .title = "How it was decided whether they agree",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "simulated − measured", .unit = {}},
                                   {.name = "90 % from", .unit = {}},
                                   {.name = "90 % to", .unit = {}},
                                   {.name = "margin", .unit = {}},
                                   {.name = "margin is", .unit = {}},
                                   {.name = "p", .unit = "%", .decimals = 2},
                                   {.name = "detectable difference", .unit = {}},
                                   {.name = "runs", .unit = {}, .decimals = 0},
                                   {.name = "runs to decide", .unit = {}, .decimals = 0},
                                   {.name = "readings to decide", .unit = {}, .decimals = 0},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    const Agreement& checked = *observable.verification;
    std::optional<double> needed;
    std::optional<double> readings;
    if (checked.runs_to_decide) needed = *checked.runs_to_decide;
    if (checked.readings_to_decide) readings = *checked.readings_to_decide;
    table.data.add({axis_of_observable(observable.name, observable.unit),
                    cell(checked.simulated - observable.measured), cell(checked.difference.low),
                    cell(checked.difference.high), cell(checked.tolerance),
                    cell(margin_text(checked.tolerance_from)), cell(100 * checked.chance),
                    cell(checked.detectable), static_cast<double>(checked.runs), cell(needed),
                    cell(readings), name_of(checked.verdict)});
  }
  return table;
}

Table surrogate_table(const JointResult& joint) {
  Table table{.name = "surrogate_checks",
              .title =
                  "Predictions of the fitted curves for the runs of the last check, before these "
                  "entered the fit; ± is the half-width of the 95 % interval",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "predicted", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "fresh seeds", .unit = {}},
                                   {.name = "p", .unit = "%", .decimals = 2},
                                   {.name = "prediction", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    const SurrogateCheck& check = *observable.surrogate;
    table.data.add({axis_of_observable(observable.name, observable.unit), cell(check.predicted),
                    cell(half_width_95(check.uncertainty)), cell(check.simulated),
                    cell(100 * check.chance),
                    cell(std::string(check.misses ? "missed" : "holds"))});
  }
  return table;
}

Table scatter_table(const JointResult& joint) {
  Table table{.name = "reading_scatter",
              .title = "Scatter of single readings: standard deviations",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "bench", .unit = {}},
                                   {.name = "bench value is", .unit = {}},
                                   {.name = "predicted by the simulation", .unit = {}},
                                   {.name = "one simulated run", .unit = {}},
                                   {.name = "shared by all readings", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    const std::string shared = systematic_text(observable);
    table.data.add({axis_of_observable(observable.name, observable.unit),
                    cell(observable.measured_sd),
                    cell(std::string(observable.sd_assumed ? "assumed" : "measured")),
                    cell(observable.predicted_sd), cell(observable.simulated_sd),
                    shared.empty() ? "–" : shared});
  }
  return table;
}

std::string rounds_text(const JointResult& joint) {
  if (joint.is_of_table) {
    return "The fitted parameters were run again with fresh seeds. These runs have no part in the "
           "fit.";
  }
  return fmt::format(
      "The best fit was simulated again with fresh seeds, {}. All of these runs then entered the "
      "fit, whatever they showed. The last fit is reported; the check below is of its "
      "coefficients, "
      "or of the nearest ones that were simulated.",
      joint.agreement.rounds == 1 ? "once" : fmt::format("in {} rounds", joint.agreement.rounds));
}

std::optional<double> possible_end(const Prediction& prediction, bool is_high) {
  if (!prediction.possible) return std::nullopt;
  return is_high ? prediction.possible->high : prediction.possible->low;
}

Table predictions_table(const JointResult& joint) {
  Table table{.name = "held_out",
              .title = "Predictions of what was held out, in full",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "measured", .unit = {}},
                                   {.name = "standard uncertainty", .unit = {}},
                                   {.name = "predicted", .unit = {}},
                                   {.name = "95 % from", .unit = {}},
                                   {.name = "95 % to", .unit = {}},
                                   {.name = "difference / σ", .unit = {}, .decimals = 1},
                                   {.name = "p", .unit = "%", .decimals = 2},
                                   {.name = "margin", .unit = {}},
                                   {.name = "possible from", .unit = {}},
                                   {.name = "to", .unit = {}},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const Prediction& prediction : joint.held_out) {
    table.data.add({axis_of_observable(prediction.name, prediction.unit), cell(prediction.measured),
                    cell(prediction.measured_uncertainty), cell(prediction.predicted),
                    cell(prediction.interval.low), cell(prediction.interval.high),
                    cell(prediction.difference_sigma), cell(100 * prediction.chance),
                    cell(prediction.tolerance), cell(possible_end(prediction, false)),
                    cell(possible_end(prediction, true)), name_of(prediction.verdict)});
  }
  return table;
}

void add_predictions(const JointResult& joint, Chapter& chapter) {
  if (joint.held_out.empty()) return;
  chapter.blocks.push_back(brief_predictions_table(joint));
  for (const Prediction& prediction : joint.held_out) {
    chapter.blocks.push_back(Paragraph{prediction_text(prediction) + '.'});
  }
  chapter.blocks.push_back(Paragraph{fmt::format(
      "These readings had no part in the fit. They {} {} sets of coefficients drawn "
      "from those that the fit leaves plausible; the interval holds what these differ by, and {}. "
      "Cannot tell: the coefficients are not known well enough to predict this reading "
      "within its margin.",
      !joint.is_of_table ? "were simulated at"
                         : "are what a surface through the table's runs gives at",
      !joint.is_of_table ? static_cast<int>(kDrawnSets) : joint.held_out.front().sets,
      !joint.is_of_table ? "chance" : "what is not known of the surface")});
}

Table candidates_table(const JointResult& joint) {
  Table table{.name = "rolling_models",
              .title = "Rolling models fitted to the same readings",
              .data = {.columns = {{.name = "rolling model", .unit = {}},
                                   {.name = "score of means", .unit = {}, .decimals = 1},
                                   {.name = "score of scatter", .unit = {}, .decimals = 1},
                                   {.name = "sum", .unit = {}, .decimals = 1},
                                   {.name = "bench and simulation", .unit = {}}},
                       .rows = {}}};
  for (const Candidate& candidate : joint.candidates) {
    table.data.add({candidate.name, cell(candidate.means), cell(candidate.scatter),
                    cell(candidate_score(candidate)), name_of(candidate.verdict)});
  }
  return table;
}

/// The models that this rolling model was compared with.
void add_candidates(const JointResult& joint, Chapter& chapter) {
  if (joint.candidates.size() < 2) return;
  chapter.blocks.push_back(candidates_table(joint));
  chapter.blocks.push_back(Paragraph{fmt::format(
      "The study was also fitted with other rolling models. Of these, {}. The score is the "
      "sum of two parts, and the lower the better: the χ² with the probability of all differences "
      "of means together, and how much more single readings scatter than the bench’s, by the "
      "likelihood ratio of equal variances. It ranks these models on these readings; it is no "
      "probability that one of them is right.",
      candidates_text(joint.candidates))});
}

}  // namespace

Chapter agreement_chapter(const JointResult& joint) {
  Chapter chapter{.id = "agreement", .title = "Bench and simulation", .blocks = {}};
  add_predictions(joint, chapter);
  if (joint.verdict) {
    chapter.blocks.push_back(Paragraph{titled(joint.agreement.text) + '.'});
    chapter.blocks.push_back(brief_agreement_table(joint));
    chapter.blocks.push_back(Paragraph{rounds_text(joint)});
  } else {
    chapter.blocks.push_back(
        Paragraph{"Not checked in simulations: " + joint.agreement.text + '.'});
    chapter.blocks.push_back(fitted_table(joint));
  }
  if (const std::string freedom = freedom_text(joint); !freedom.empty()) {
    chapter.blocks.push_back(Paragraph{titled(freedom) + '.'});
  }
  if (const std::string model = model_error_text(joint); !model.empty()) {
    chapter.blocks.push_back(Paragraph{titled(model) + '.'});
  }
  if (const std::string coarse = coarse_text(joint); !coarse.empty()) {
    chapter.blocks.push_back(Paragraph{titled(coarse) + '.'});
  }
  if (!joint.verdict) return chapter;
  chapter.blocks.push_back(Paragraph{
      "Agrees: the difference is shown to be within the margin. Disagrees: it is more than "
      "chance makes. Cannot tell: neither is shown. All numbers behind these verdicts are in the "
      "appendix, under “Range, checks and scatter”."});
  add_assumed_scatter(joint, chapter.blocks);
  add_stiffness_and_shape(joint, chapter);
  add_candidates(joint, chapter);
  return chapter;
}

Chapter checks_chapter(const JointResult& joint) {
  Chapter chapter{.id = "checks", .title = "Range, checks and scatter", .blocks = {}};
  if (!joint.verdict) {
    chapter.title = "Range and scatter";
    if (!joint.held_out.empty()) chapter.blocks.push_back(predictions_table(joint));
    chapter.blocks.push_back(reach_table(joint));
    chapter.blocks.push_back(scatter_table(joint));
    return chapter;
  }
  chapter.blocks.push_back(agreement_table(joint));
  chapter.blocks.push_back(Paragraph{"σ is the standard uncertainty of the difference."});
  chapter.blocks.push_back(verdicts_table(joint));
  chapter.blocks.push_back(Paragraph{
      "p is the probability of so large a difference by chance. Agrees: two one-sided tests at 5 % "
      "show that the difference is within the margin. It is stated in the study, or else the least "
      "of 10 % of the measured value, 10 % of the range of readings that the bounds of the "
      "coefficients allow, and 2° for angles; how sure the bench is plays no part in it. In p, "
      "what "
      "the fit could follow of the bench's chance is taken into account. Disagrees: the "
      "differences "
      "of all experiments together have a probability below 5 %, and so has this one by itself. "
      "Cannot tell: neither is shown. The detectable difference is the true difference that such a "
      "check detects in four of five cases. No number of runs to decide means that it is decided, "
      "or "
      "that the bench readings are too uncertain for any number of runs to decide; likewise for "
      "readings."});
  if (!joint.held_out.empty()) chapter.blocks.push_back(predictions_table(joint));
  add_stiffness_and_shape_tables(joint, chapter);
  chapter.blocks.push_back(reach_table(joint));
  chapter.blocks.push_back(surrogate_table(joint));
  chapter.blocks.push_back(scatter_table(joint));
  chapter.blocks.push_back(
      Paragraph{"A run that averages several grains scatters less than a single bench reading, by "
                "the square root of their number. Several readings of one experiment enter with "
                "their covariance, so that what they share counts only once."});
  return chapter;
}

}  // namespace repose::calibrate::report
