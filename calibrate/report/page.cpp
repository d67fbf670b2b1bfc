#include "calibrate/report/page.h"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <stdexcept>
#include <string_view>

#include <ctemplate/template.h>
#include <ctemplate/template_cache.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/base64.h"
#include "base/csv.h"
#include "base/text.h"
#include "calibrate/report/wording.h"

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

/// Run-length encoding of series names, which repeat in consecutive rows.
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

/// Defined by cmake/embed.cmake.
std::string_view embedded_file(std::string_view name);

namespace {

using Dictionary = ctemplate::TemplateDictionary;

/// A column's layout class: numbers right-aligned, sentences with more width.
const char* class_of(const DataTable& table, std::size_t column) {
  constexpr std::size_t kSentence = 60;
  const char* kind = "number";
  for (const std::vector<Cell>& row : table.rows) {
    const auto* text = column < row.size() ? std::get_if<std::string>(&row[column]) : nullptr;
    if (text == nullptr) continue;
    if (text->size() > kSentence) return "sentence";
    kind = "text";
  }
  return kind;
}

/// Position along the strip, 0 to 200.
double place_in_strip(double value, double min, double max) {
  constexpr double kLength = 200;
  return max > min ? std::clamp(kLength * (value - min) / (max - min), 0.0, kLength) : 0;
}

void fill_strip(const Table& table, const std::vector<Cell>& row, Dictionary& into) {
  std::array<double, 5> numbers{};
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const auto* number = std::get_if<double>(&row.at((*table.strip)[k]));
    if (number == nullptr) return;
    numbers[k] = *number;
  }
  const auto& [value, low, high, min, max] = numbers;
  Dictionary& strip = *into.AddSectionDictionary("STRIP");
  strip.SetValue("LOW", fmt::format("{:.1f}", place_in_strip(low, min, max)));
  strip.SetValue("HIGH", fmt::format("{:.1f}", place_in_strip(high, min, max)));
  strip.SetValue("VALUE", fmt::format("{:.1f}", place_in_strip(value, min, max)));
  strip.SetValue("ALT", fmt::format("{}, 95 % interval {} to {}, bounds {} to {}", shown(value),
                                    shown(low), shown(high), shown(min), shown(max)));
}

void fill(const Table& table, Dictionary& block) {
  Dictionary& into = *block.AddSectionDictionary("TABLE");
  if (!table.title.empty()) {
    into.AddSectionDictionary("CAPTION")->SetValue("TEXT", table.title);
  }
  std::vector<const char*> kinds;
  for (std::size_t k = 0; k < table.data.columns.size(); ++k) {
    const Column& column = table.data.columns[k];
    kinds.push_back(class_of(table.data, k));
    Dictionary& head = *into.AddSectionDictionary("HEAD");
    head.SetValue("CLASS", kinds.back());
    head.SetValue("TEXT", column.unit.empty() ? column.name
                                              : fmt::format("{} [{}]", column.name, column.unit));
  }
  if (table.strip) {
    Dictionary& head = *into.AddSectionDictionary("HEAD");
    head.SetValue("CLASS", "strip");
    head.SetValue("TEXT", "interval between the bounds");
  }
  for (const std::vector<Cell>& row : table.data.rows) {
    Dictionary& line = *into.AddSectionDictionary("ROW");
    for (std::size_t k = 0; k < row.size(); ++k) {
      Dictionary& cell = *line.AddSectionDictionary("CELL");
      cell.SetValue("CLASS", kinds.at(k));
      cell.SetValue("TEXT", shown(row[k], table.data.columns[k]));
    }
    if (table.strip) fill_strip(table, row, line);
  }
}

void fill(const ChartRow& row, Dictionary& block) {
  Dictionary& into = *block.AddSectionDictionary("CHARTS");
  for (const Chart& chart : row.charts) {
    Dictionary& figure = *into.AddSectionDictionary("CHART");
    figure.SetValue("NAME", chart.name);
    figure.SetValue("TITLE", chart.title + ".");
    figure.SetValue("TEXT", chart.caption);
    figure.SetValue("ALT", chart.title + ". " + chart.caption);
  }
}

void fill(const PictureRow& row, Dictionary& block) {
  Dictionary& into = *block.AddSectionDictionary("PICTURES");
  for (const ShownPicture& picture : row.pictures) {
    Dictionary& figure = *into.AddSectionDictionary("PICTURE");
    figure.SetValue("SOURCE", picture.data_uri);
    figure.SetIntValue("WIDTH", picture.width);
    figure.SetIntValue("HEIGHT", picture.height);
    figure.SetValue("ALT", picture.alt);
    figure.SetValue("TEXT", picture.caption);
    if (picture.picture_width > 0) {
      const auto& [left, width, height] = picture.area;
      figure.AddSectionDictionary("PIXELS")->SetValue(
          "PLACE", fmt::format("{} {} {:.6f} {:.6f} {:.6f}", picture.picture_width,
                               picture.picture_height, left, width, height));
      figure.AddSectionDictionary("PIXEL");
    }
    if (!picture.command.empty()) {
      figure.AddSectionDictionary("COMMAND")->SetValue("LINE", picture.command);
    }
  }
}

void fill_text(const char* section, const std::string& text, Dictionary& block) {
  block.AddSectionDictionary(section)->SetValue("TEXT", text);
}
void fill(const Heading& heading, Dictionary& block) { fill_text("HEADING", heading.text, block); }
void fill(const Paragraph& text, Dictionary& block) { fill_text("PARAGRAPH", text.text, block); }
void fill(const Equation& text, Dictionary& block) { fill_text("EQUATION", text.text, block); }
void fill(const Remark& remark, Dictionary& block) { fill_text("REMARK", remark.text, block); }
void fill(const SurfaceViewer& viewer, Dictionary& block) {
  fill_text("SURFACE", viewer.caption, block);
}
void fill(const CodeText& code, Dictionary& block) {
  Dictionary& into = *block.AddSectionDictionary("CODE");
  into.SetValue("LABEL", code.label);
  into.SetValue("TEXT", code.text);
}

void add_link(const std::string& id, const std::string& title, Dictionary& menu) {
  Dictionary& link = *menu.AddSectionDictionary("LINK");
  link.SetValue("ID", id);
  link.SetValue("TEXT", title);
}

ctemplate::TemplateString without_copy(std::string_view text) { return {text.data(), text.size()}; }

}  // namespace

std::string html_of(const Document& document) {
  Dictionary page("report");
  page.SetValue("TITLE", document.title);
  page.SetValue("KIND", document.kind);
  page.SetValue("PROGRAM", document.program);
  if (!document.state.empty()) {
    page.AddSectionDictionary("STATE")->SetValue("TEXT", document.state);
  }
  bool is_appendix = false;
  Dictionary* appendix = nullptr;  // whose chapters have their own menu
  for (const Chapter& chapter : document.chapters) {
    const bool begins_appendix = chapter.is_appendix && !is_appendix;
    is_appendix = chapter.is_appendix;
    Dictionary& section = *page.AddSectionDictionary("CHAPTER");
    if (begins_appendix) {
      add_link("appendix", "Appendix", page);
      appendix = section.AddSectionDictionary("APPENDIX");
    }
    add_link(chapter.id, chapter.title, is_appendix ? *appendix : page);
    section.SetValue("ID", chapter.id);
    section.SetValue("TITLE", chapter.title);
    for (const Block& block : chapter.blocks) {
      Dictionary& into = *section.AddSectionDictionary("BLOCK");
      std::visit([&](const auto& shown) { fill(shown, into); }, block);
    }
  }
  const std::string data = charts_json(document);
  page.SetValueWithoutCopy("DATA", without_copy(data));
  page.SetValueWithoutCopy("STYLE", without_copy(embedded_file("report/page/report.css")));
  page.SetValueWithoutCopy("SCRIPT", without_copy(embedded_file("report/page/report.js")));
  page.SetValueWithoutCopy("INFLATE", without_copy(embedded_file("report/page/inflate.js")));
  // The header contains the build time, and is not needed.
  constexpr std::size_t kGzipHeader = 10;
  const std::string_view plotly = embedded_file("plotly.min.js.gz").substr(kGzipHeader);
  const std::string packed = base::base64_of(std::as_bytes(std::span(plotly)));
  page.SetValueWithoutCopy("PLOTLY", without_copy(packed));

  ctemplate::TemplateCache templates;
  const std::string_view html = embedded_file("report/page/report.html");
  std::string result;
  if (!templates.StringToTemplateCache("report", html.data(), html.size(),
                                       ctemplate::DO_NOT_STRIP) ||
      !templates.ExpandWithData("report", ctemplate::DO_NOT_STRIP, &page, nullptr, &result)) {
    throw std::runtime_error("the report's template is damaged. Fix: rebuild repose.");
  }
  return base::as_utf8(result);  // file names need not be UTF-8, but the page is declared as such
}

}  // namespace repose::calibrate::report
