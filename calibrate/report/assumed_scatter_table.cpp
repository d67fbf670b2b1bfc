#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {

void add_assumed_scatter(const JointResult& joint, std::vector<Block>& blocks) {
  const AssumedScatters& assumed = joint.assumed_scatters;
  if (assumed.readings.empty()) return;
  std::string readings;
  for (const AssumedScatter& one : assumed.readings) {
    readings += fmt::format("{}{} {:.2g} %", readings.empty() ? "" : ", ", one.observable,
                            100 * one.fraction);
  }
  Table table{.name = "assumed_scatter",
              .title = "With half and with twice the assumed scatter",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "scatter", .unit = {}},
                                   {.name = "95 % from", .unit = {}, .decimals = 3},
                                   {.name = "95 % to", .unit = {}, .decimals = 3},
                                   {.name = "verdict", .unit = {}}},
                       .rows = {}}};
  for (const ScatterDependence& coefficient : assumed.coefficients) {
    for (const auto& [scatter, one] :
         {std::pair{"half", &coefficient.half}, std::pair{"twice", &coefficient.twice}}) {
      table.data.add({label_of(coefficient.name), std::string(scatter), cell(one->interval.low),
                      cell(one->interval.high), name_of(one->verdict)});
    }
  }
  blocks.push_back(Heading{"What an assumed scatter decides"});
  blocks.push_back(Paragraph{fmt::format(
      "Nobody measured how single readings of these scatter; the fit assumes: {}. The same "
      "simulations were fitted again with half and with twice of that. Where a verdict changes, "
      "measure the scatter: five readings or more, each of them written down.",
      readings)});
  blocks.push_back(std::move(table));
}

}  // namespace repose::calibrate::report
