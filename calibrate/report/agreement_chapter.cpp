#include <cmath>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

Table agreement_table(const StudyFolder& study) {
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
  for (const JsonView& observable : study.result["observables"].items()) {
    const JsonView checked = observable["verification"];
    std::vector<double> reach = observable["reachable"].numbers();
    reach.resize(2, std::nan(""));
    table.data.add(
        {axis_of_observable(observable["name"].text(), observable["unit"].text()),
         cell(observable["measured"].number()), cell(observable["measured_uncertainty"].number()),
         cell(observable["simulated"].number()), cell(observable["simulated_uncertainty"].number()),
         cell(checked["simulated"].number()), cell(checked["uncertainty"].number()),
         cell(checked["difference_sigma"].number()), cell(reach[0]), cell(reach[1])});
  }
  return table;
}

}  // namespace

Chapter agreement_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "agreement", .title = "Bench and simulation", .blocks = {}};
  chapter.blocks.push_back(agreement_table(study));
  chapter.blocks.push_back(Paragraph{
      "The fit was made from runs all over the bounds; then the coefficients found were simulated "
      "again with seeds that it had not seen. σ is the uncertainty of the difference: beyond 2 to "
      "3 bench and simulation disagree. Within reach is what the simulation can give between the "
      "bounds."});
  return chapter;
}

}  // namespace repose::calibrate::report
