#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

Table agreement_table(const JointResult& joint) {
  Table table{.name = "agreement",
              .title = "± is the standard uncertainty of the mean",
              .data = {.columns = {{.name = "measured quantity", .unit = {}},
                                   {.name = "measured", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "fit", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "fresh seeds", .unit = {}},
                                   {.name = "±", .unit = {}},
                                   {.name = "off", .unit = "σ", .decimals = 1},
                                   {.name = "within reach from", .unit = {}},
                                   {.name = "to", .unit = {}}},
                       .rows = {}}};
  for (const ResultObservable& observable : joint.observables) {
    const ObservableCheck& checked = observable.verification;
    table.data.add({axis_of_observable(observable.name, observable.unit), cell(observable.measured),
                    cell(observable.measured_uncertainty), cell(observable.simulated),
                    cell(observable.simulated_uncertainty), cell(checked.simulated),
                    cell(checked.uncertainty), cell(checked.difference_sigma),
                    cell(observable.reachable.low), cell(observable.reachable.high)});
  }
  return table;
}

}  // namespace

Chapter agreement_chapter(const JointResult& joint) {
  Chapter chapter{.id = "agreement", .title = "Bench and simulation", .blocks = {}};
  chapter.blocks.push_back(agreement_table(joint));
  chapter.blocks.push_back(Paragraph{
      "The fit was made from runs all over the bounds; then the coefficients found were simulated "
      "again with seeds that it had not seen. σ is the uncertainty of the difference: beyond 2 to "
      "3 bench and simulation disagree. Within reach is what the simulation can give between the "
      "bounds."});
  return chapter;
}

}  // namespace repose::calibrate::report
