#include "calibrate/report/tables.h"

#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/csv.h"

namespace repose::calibrate::report {
namespace {

using Json = nlohmann::ordered_json;

std::string six_digits(double value) { return fmt::format("{:.6g}", value); }

std::string csv_cell(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return six_digits(*number);
  if (const auto* text = std::get_if<std::string>(&cell)) return base::csv_cell(*text);
  return {};
}

Json json_cell(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) {
    return std::strtod(six_digits(*number).c_str(), nullptr);
  }
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  return nullptr;
}

const char* name_of(Look look) {
  switch (look) {
    case Look::runs:
      return "runs";
    case Look::dots:
      return "dots";
    case Look::points:
      return "points";
    case Look::fit:
      return "fit";
    case Look::band:
      return "band";
    case Look::scatter:
      return "scatter";
    case Look::measured:
      return "measured";
    case Look::best:
      return "best";
    case Look::limit:
      return "limit";
    case Look::line:
      return "line";
    case Look::grid:
      return "grid";
    case Look::ridge:
      break;
  }
  return "ridge";
}

const char* name_of(ChartKind kind) {
  switch (kind) {
    case ChartKind::plane:
      return "plane";
    case ChartKind::contour:
      return "contour";
    case ChartKind::heap:
      break;
  }
  return "heap";
}

/// Series, which stand in many rows one after the other: each with how often.
Json repeated(const Json& values) {
  Json runs = Json::array();
  for (const Json& value : values) {
    if (!runs.empty() && runs.back()[0] == value) {
      runs.back()[1] = runs.back()[1].get<int>() + 1;
    } else {
      runs.push_back(Json::array({value, 1}));
    }
  }
  return runs;
}

Json columns_json(const DataTable& table) {
  Json columns = Json::array();
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    Json values = Json::array();
    for (const std::vector<Cell>& row : table.rows) {
      values.push_back(k < row.size() ? json_cell(row[k]) : Json(nullptr));
    }
    if (k == 0) values = repeated(values);
    columns.push_back({{"name", table.columns[k].name},
                       {"unit", table.columns[k].unit},
                       {"values", std::move(values)}});
  }
  return columns;
}

Json chart_json(const Chart& chart) {
  Json layers = Json::array();
  for (const Layer& layer : chart.layers) {
    layers.push_back({{"series", layer.series}, {"look", name_of(layer.look)}});
  }
  return {{"name", chart.name},
          {"kind", name_of(chart.kind)},
          {"title", chart.title},
          {"x_title", chart.x_title},
          {"y_title", chart.y_title},
          {"z_title", chart.z_title},
          {"y_range", chart.y_range ? Json(*chart.y_range) : Json(nullptr)},
          {"whole_x", chart.has_whole_x},
          {"colour", chart.colour ? Json(*chart.colour) : Json(nullptr)},
          {"layers", std::move(layers)},
          {"columns", columns_json(chart.data)}};
}

/// Calls `use` with every chart and every table.
template <typename Use>
void for_each_shown(const Document& document, const Use& use) {
  for (const Chapter& chapter : document.chapters) {
    for (const Block& block : chapter.blocks) {
      if (const auto* table = std::get_if<Table>(&block)) use(*table);
      if (const auto* row = std::get_if<ChartRow>(&block)) {
        for (const Chart& chart : row->charts) use(chart);
      }
    }
  }
}

}  // namespace

std::vector<NamedTable> tables_of(const Document& document) {
  std::vector<NamedTable> tables;
  for_each_shown(document, [&](const auto& shown) {
    if (!shown.name.empty()) tables.push_back({shown.name, &shown.data});
  });
  return tables;
}

std::string csv_of(const DataTable& table) {
  std::string csv;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const Column& column = table.columns[k];
    if (k > 0) csv += ',';
    csv += base::csv_cell(column.unit.empty() ? column.name
                                              : fmt::format("{} [{}]", column.name, column.unit));
  }
  csv += '\n';
  for (const std::vector<Cell>& row : table.rows) {
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      if (k > 0) csv += ',';
      if (k < row.size()) csv += csv_cell(row[k]);
    }
    csv += '\n';
  }
  return csv;
}

std::string charts_json(const Document& document) {
  Json charts = Json::array();
  for_each_shown(document, [&](const auto& shown) {
    if constexpr (std::is_same_v<std::decay_t<decltype(shown)>, Chart>) {
      charts.push_back(chart_json(shown));
    }
  });
  const std::string json =
      Json{{"charts", std::move(charts)}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string safe;
  safe.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<') {
      safe += "\\u003c";
    } else {
      safe += letter;
    }
  }
  return safe;
}

}  // namespace repose::calibrate::report
