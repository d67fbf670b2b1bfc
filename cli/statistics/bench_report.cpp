#include "cli/statistics/bench_report.h"

#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/common/page.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

std::vector<std::string> quantity_row(const calibrate::BenchQuantity& quantity) {
  const auto& [n, mean, sd, uncertainty] = quantity.repeats;
  return {
      quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit),
      fmt::format("{:.4g}", mean), sd ? fmt::format("{:.3g}", *sd) : kNothing, fmt::format("{}", n),
      uncertainty ? fmt::format("{:.4g} … {:.4g}", mean - *uncertainty, mean + *uncertainty)
                  : kNothing};
}

}  // namespace

std::string bench_table(const std::string& test, const calibrate::BenchResult& result,
                        int columns) {
  Table table({{.heading = ""},
               number_column("mean"),
               number_column("sd"),
               number_column("n"),
               number_column("95 % interval of the mean (Student)")});
  for (const calibrate::BenchQuantity& quantity : result.quantities) {
    table.add_row(quantity_row(quantity));
  }
  Page page(columns);
  page.add(fmt::format("{}: {}", test, result.source));
  page.add_gap();
  page.add(table);
  page.add_gap();
  for (const std::string& note : result.notes) page.add(note);
  return page.text();
}

std::string bench_json(const std::string& test, const calibrate::BenchResult& result) {
  Json quantities = Json::array();
  for (const calibrate::BenchQuantity& quantity : result.quantities) {
    const auto& [n, mean, sd, uncertainty] = quantity.repeats;
    Json json{{"name", quantity.name},
              {"unit", quantity.unit},
              {"n", n},
              {"mean", mean},
              {"sd", nullptr},
              {"interval", nullptr},
              {"values", quantity.values}};
    if (sd) json["sd"] = *sd;
    if (uncertainty) json["interval"] = {mean - *uncertainty, mean + *uncertainty};
    quantities.push_back(std::move(json));
  }
  const Json json{{"test", test},
                  {"equation", result.source},
                  {"quantities", std::move(quantities)},
                  {"notes", result.notes}};
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
