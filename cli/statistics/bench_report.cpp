#include "cli/statistics/bench_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/common/terminal.h"

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kNothing = "–";

std::string quantity_line(const calibrate::BenchQuantity& quantity, std::size_t width) {
  const auto& [n, mean, sd, uncertainty] = quantity.repeats;
  const std::string name =
      quantity.unit.empty() ? quantity.name : fmt::format("{} [{}]", quantity.name, quantity.unit);
  const std::string interval =
      uncertainty ? fmt::format("{:.4g} … {:.4g}", mean - *uncertainty, mean + *uncertainty)
                  : kNothing;
  return fmt::format("{}{:>11.4g}{}{:>6}{}\n", padded(name, width), mean,
                     right_aligned(sd ? fmt::format("{:.3g}", *sd) : kNothing, 11), n,
                     right_aligned(interval, 27));
}

}  // namespace

std::string bench_table(const std::string& test, const calibrate::BenchResult& result,
                        int columns) {
  constexpr std::size_t kNameWidth = 24;
  constexpr int kNarrowest = 40;
  std::string text = fmt::format("{}: {}\n\n", test, result.source);
  text += fmt::format("{}{:>11}{:>11}{:>6}{}\n", padded("", kNameWidth), "mean", "sd", "n",
                      right_aligned("95 % of the mean (Student)", 27));
  for (const calibrate::BenchQuantity& quantity : result.quantities) {
    text += quantity_line(quantity, kNameWidth);
  }
  text += '\n';
  for (const std::string& note : result.notes) {
    for (const std::string& line :
         wrapped(note, static_cast<std::size_t>(std::max(kNarrowest, columns)))) {
      text += line + '\n';
    }
  }
  return text;
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
