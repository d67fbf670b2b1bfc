#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/report/document.h"
#include "calibrate/report/heap_model.h"
#include "calibrate/report/measure_report.h"
#include "calibrate/report/page.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

TEST(Ridge, OfAPlaneIsStraight) {
  const std::vector<double> x = {0, 1, 2}, y = {0, 2};
  const std::vector<std::vector<double>> heights = {{0, 1, 2}, {2, 3, 4}};  // x + y
  const auto ridge = ridge_of(x, y, heights, 1.5);
  ASSERT_THAT(ridge, Not(IsEmpty()));
  for (const auto& [at_x, at_y] : ridge) EXPECT_NEAR(at_x + at_y, 1.5, 1e-12);
}

TEST(Ridge, IsEmptyWhereTheSurfaceIsNotOrDoesNotReach) {
  EXPECT_THAT(ridge_of({0, 1}, {0, 1}, {{0, 1}, {1, 2}}, 9), IsEmpty());
  const double nan = std::nan("");
  EXPECT_THAT(ridge_of({0, 1}, {0, 1}, {{nan, nan}, {nan, nan}}, 1), IsEmpty());
  EXPECT_THAT(ridge_of({}, {}, {}, 1), IsEmpty());
}

TEST(Wording, NumbersThatDoNotExistAreDashes) {
  EXPECT_EQ(shown(std::nullopt), "–");
  EXPECT_EQ(shown(std::nan("")), "–");
  EXPECT_EQ(shown(-1.5), "−1.5");
  EXPECT_EQ(shown(0.12345, 2), "0.12");
  EXPECT_EQ(shown(-1.5e-12), "−1.5·10⁻¹²");
  EXPECT_EQ(shown(1e300), "1·10³⁰⁰");
}

TEST(Wording, ShorteningKeepsLettersWhole) {
  std::string text;
  for (int k = 0; k < 200; ++k) text += "ß";
  for (std::size_t most = 20; most < 26; ++most) {
    const std::string cut = shortened(text, most);
    for (std::size_t k = 0; k < cut.size();) {
      const bool is_sharp_s = cut.compare(k, 2, "ß") == 0;
      ASSERT_TRUE(is_sharp_s || cut.compare(k, 3, "…") == 0) << "at " << k;
      k += is_sharp_s ? 2 : 3;
    }
  }
}

TEST(Wording, FileStemsStayInTheirFolder) {
  EXPECT_EQ(file_stem("../../etc/passwd"), "etc_passwd");
  EXPECT_EQ(file_stem("<>"), "table");
  EXPECT_THAT(file_stem(std::string(10'000, 'a')), SizeIs(100));
}

TEST(Tables, CsvQuotesWhatItMust) {
  const DataTable table{.columns = {{.name = "a \"b\"", .unit = "mm"}, {.name = "c", .unit = {}}},
                        .rows = {{std::string("x,y\nz"), 1.0 / 3}, {std::monostate{}, -2.0}}};
  EXPECT_EQ(csv_of(table), "\"a \"\"b\"\" [mm]\",c\n\"x,y\nz\",0.333333\n,-2\n");
}

TEST(Page, TextsStayTexts) {
  const std::string hostile = "'\"><script>x</script>{{TITLE}}";
  Document document{
      .title = hostile, .kind = hostile, .state = hostile, .chapters = {}, .program = hostile};
  Chart chart = plane_chart("c", hostile, {.name = hostile, .unit = {}}, {.name = "y", .unit = {}});
  chart.caption = hostile;
  add_point(chart, hostile, Look::points, 1.0, 2.0);
  const Table table{.name = {},
                    .title = hostile,
                    .data = {.columns = {{.name = hostile, .unit = hostile}}, .rows = {{hostile}}}};
  document.chapters = {
      {.id = "a",
       .title = hostile,
       .blocks = {Paragraph{hostile}, Remark{hostile}, Heading{hostile}, Equation{hostile},
                  CodeText{hostile, hostile + "\n<pre>"}, table, ChartRow{{chart}},
                  PictureRow{{{.data_uri = "data:,", .alt = hostile, .caption = hostile}}}}}};
  const std::string html = html_of(document);
  const std::string page = html.substr(0, html.find("<script type=\"application/json\""));
  EXPECT_THAT(page, Not(HasSubstr("<script>")));
  EXPECT_THAT(page, Not(HasSubstr("'\"><")));
  EXPECT_THAT(page, HasSubstr("\n&lt;pre&gt;"));  // lines to be copied remain lines
  EXPECT_THAT(charts_json(document), Not(HasSubstr("<")));
}

vision::Picture grey_picture() {
  return {
      .width = 40, .height = 20, .bgr = std::vector<std::uint8_t>(std::size_t{40} * 20 * 3, 128)};
}

TEST(MeasureReport, DrawsEachAngleWithItsIntervalOnAxesThatFitThem) {
  std::vector<MeasuredPhotograph> pictures(2);
  for (std::size_t k = 0; k < 2; ++k) {
    pictures[k].file = "photos/heap.jpg";
    pictures[k].angle.status = vision::MeasureStatus::ok;
    pictures[k].angle.angle_rad = 0.4;
    pictures[k].angle.uncertainty_rad = k == 0 ? 0.1 : 1;  // 57 degrees would flatten the rest
  }
  const Report report = measure_report(pictures);
  ASSERT_THAT(report.tables, Not(IsEmpty()));
  const auto chart = std::find_if(report.tables.begin(), report.tables.end(),
                                  [](const CsvFile& file) { return file.name == "angles.csv"; });
  ASSERT_NE(chart, report.tables.end());
  EXPECT_THAT(chart->text, HasSubstr("ok,1: heap.jpg,22.9183,17.1887,28.6479\n"));
  EXPECT_THAT(report.html, HasSubstr("\"y_range\":[9.0,36.0]"));
}

TEST(MeasureReport, SaysMeanAndWhatWasLeftOut) {
  std::vector<MeasuredPhotograph> pictures(4);
  for (std::size_t k = 0; k < 2; ++k) {
    pictures[k].file = "photos/heap.jpg";
    pictures[k].angle.status = vision::MeasureStatus::ok;
    pictures[k].angle.angle_rad = 0.4 + 0.02 * static_cast<double>(k);
    pictures[k].angle.uncertainty_rad = 0.01;
    pictures[k].overlay = {.bytes = vision::jpeg_of(grey_picture(), 80), .width = 40, .height = 20};
  }
  pictures[2].file = "refused.jpg";
  pictures[2].angle.reason = "no <heap> in it";
  pictures[3].file = "gone.jpg";
  pictures[3].error = "there is no such file";
  const std::string html = measure_report(pictures).html;
  EXPECT_THAT(html, HasSubstr("Mean angle of repose 23.49°"));
  EXPECT_THAT(html, HasSubstr("Excluded: 2 refused or unreadable."));
  EXPECT_THAT(html, HasSubstr("no &lt;heap&gt; in it"));
  EXPECT_THAT(html, HasSubstr("there is no such file"));
  EXPECT_THAT(html, HasSubstr("data:image/jpeg;base64,/9j/"));
}

TEST(MeasureReport, WithoutANumberHasNoChart) {
  std::vector<MeasuredPhotograph> pictures(1);
  pictures[0].file = "refused.jpg";
  const Report report = measure_report(pictures);
  EXPECT_THAT(report.html, HasSubstr("No picture gave a usable number"));
  EXPECT_THAT(report.html, HasSubstr("{\"charts\":[]}"));
}

render::Scene heap_of(int grains) {
  render::Scene scene{.shapes = {dem::sphere_shape(0.01)}, .grains = {}, .walls = {}};
  for (int k = 0; k < grains; ++k) {
    dem::Pose pose;
    pose.position = {0.02 * (k % 50), 0.02 * ((k / 50) % 50), 0.02 * std::floor(k / 2500.)};
    scene.grains.push_back({.shape = 0, .number = k, .pose = pose});
  }
  return scene;
}

TEST(HeapModel, SpheresStaySpheres) {
  const Chart chart = heap_model(heap_of(3));
  int corners = 0, grains = 0;
  for (const std::vector<Cell>& row : chart.data.rows) {
    const std::string series = std::get<std::string>(row[0]);
    if (series == "grain") ++grains;
    if (series != "corner") continue;
    ++corners;
    const double x = std::get<double>(row[2]), y = std::get<double>(row[3]),
                 z = std::get<double>(row[4]);
    EXPECT_NEAR(std::hypot(x, y, z), 10, 1e-9);
  }
  EXPECT_EQ(grains, 3);
  EXPECT_EQ(corners, 66);  // an octahedron subdivided twice
}

TEST(HeapModel, OfLargeHeapsTheTopIsKept) {
  const Chart chart = heap_model(heap_of(7500));
  std::vector<double> heights_mm;
  for (const std::vector<Cell>& row : chart.data.rows) {
    if (std::get<std::string>(row[0]) == "grain") heights_mm.push_back(std::get<double>(row[4]));
  }
  EXPECT_THAT(heights_mm, AllOf(SizeIs(2500), Each(40.0)));
}

}  // namespace
}  // namespace repose::calibrate::report
