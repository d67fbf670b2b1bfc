#include "calibrate/statistics/table/other_rows.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What remains of a table, and the messages.
struct Left {
  std::vector<int> lines;
  OtherRows other;
  std::string error;
};

Left left_of(const std::string& text, const std::vector<std::string>& readings = {"angle_deg"}) {
  Left left;
  Table table = parse_table("a.csv", text);
  base::Faults errors;
  left.other = take_other_rows(table, readings, Unlabelled::refused, errors);
  for (const TableRow& row : table.rows) left.lines.push_back(row.line);
  left.error = error_of([&] { errors.throw_if_any(); });
  return left;
}

TEST(OtherRows, LabelledStatisticsAreTakenOutInManyLanguages) {
  for (const std::string label : {"mean", "Mean:", "MITTELWERT", "St. Dev. (n-1)", "Stabw.",
                                  "écart-type", "Promedio", "Średnia", "平均", "Keskiarvo"}) {
    const Left left = left_of("sample,angle_deg\na,22.1\nb,22.9\nc,23.1\n" + label + ",7.7\n");
    EXPECT_EQ(left.lines, (std::vector{2, 3, 4})) << label;
    ASSERT_EQ(left.other.left_out.size(), 1U) << label;
    EXPECT_EQ(left.other.left_out[0].what, "line 5");
    EXPECT_THAT(left.other.left_out[0].why, HasSubstr(label));
    EXPECT_THAT(left.error, IsEmpty());
  }
}

TEST(OtherRows, BelowAMeanStandNoReadings) {
  const Left counted = left_of("sample,angle_deg\na,22.1\nb,22.9\nMittel,22.5\ns:,0.57\nn,2\n");
  EXPECT_EQ(counted.lines, (std::vector{2, 3}));
  EXPECT_EQ(counted.other.left_out.size(), 3U);
  EXPECT_THAT(counted.error, IsEmpty());
  EXPECT_THAT(left_of("sample,angle_deg\na,22.1\nb,22.9\nmean,22.5\nrest,23.1\n").error,
              AllOf(HasSubstr("a.csv:5: stands below a row labelled"), HasSubstr("Fix: move it")));
  EXPECT_EQ(left_of("sample,angle_deg\nn,22.1\ns,22.9\nk,23.4\n").lines.size(), 3U);
}

TEST(OtherRows, NamesOfLevelsAreNoStatistics) {
  EXPECT_EQ(left_of("level,angle_deg\nmin,22.1\nmax,22.9\nmin,23.4\nmax,24.6\n").lines.size(), 4U);
  EXPECT_EQ(left_of("sample,angle_deg\nmeander,22.1\nsdk,22.9\nmean 2,23.4\n").lines.size(), 3U);
}

TEST(OtherRows, MeanAndScatterWithoutALabelAreRefused) {
  EXPECT_THAT(left_of("angle_deg\n22.1\n22.9\n23.1\n22.7\n0.53\n").error,
              AllOf(HasSubstr("a.csv:5: lines 5 to 6 look like mean, scatter"),
                    HasSubstr("Fix: delete them")));
  EXPECT_THAT(left_of("angle_deg\n22.1\n22.9\n23.1\n22.700\n").error, HasSubstr("a.csv:5: this"));
  // In a language that the program does not know.
  EXPECT_THAT(left_of("n,angle_deg\n1,22.1\n2,22.9\n3,23.1\nmeán-x,22.7\n").error,
              HasSubstr("a.csv:5: this last row looks like mean"));
  EXPECT_THAT(left_of("drop_mm,rebound_mm\n500,125\n500,131\n500,120\n500,125.33\n0,5.51\n",
                      {"drop_mm", "rebound_mm"})
                  .error,
              HasSubstr("a.csv:5: lines 5 to 6"));
}

TEST(OtherRows, AReadingThatMayBeChanceCountsAndIsSaid) {
  const Left mean = left_of("angle_deg\n22.1\n22.9\n23.1\n22.7\n");
  EXPECT_EQ(mean.lines.size(), 4U);
  EXPECT_THAT(mean.error, IsEmpty());
  ASSERT_EQ(mean.other.notes.size(), 1U);
  EXPECT_THAT(mean.other.notes[0], HasSubstr("a.csv:5: equals the mean of the rows above"));
}

TEST(OtherRows, HowManyThereAreMayStandAboveTheirMean) {
  const Left left = left_of("sample,angle_deg\na,22.1\nb,22.9\nn,2\nmin,22.1\nmax,22.9\n");
  EXPECT_EQ(left.lines, (std::vector{2, 3}));
  EXPECT_THAT(left.error, IsEmpty());
}

TEST(OtherRows, ASlipOfThePenIsSaid) {
  EXPECT_THAT(left_of("angle_deg\n22\n23\n2.3\n22.5\n21\n22\n").other.notes,
              ElementsAre(HasSubstr("a.csv:4: angle_deg = 2.3 lies far from the other readings")));
  // Mean and scatter, both miscalculated, and the number of readings.
  EXPECT_THAT(left_of("angle_deg\n22.1\n22.9\n23.1\n21.5\n22.6\n0.73\n4\n").other.notes,
              ElementsAre(HasSubstr("a.csv:7"), HasSubstr("a.csv:8")));
  // Most grains do not rebound, some rebound far.
  EXPECT_THAT(left_of("x\n0\n0\n12.5\n0\n41\n0\n0\n55\n3\n0\n", {"x"}).other.notes, IsEmpty());
}

TEST(OtherRows, RadiansAndFractionsAreSaid) {
  EXPECT_THAT(left_of("angle_deg\n.40\n.41\n.38\n").other.notes,
              ElementsAre(HasSubstr("multiply them by 57.2958")));
  EXPECT_THAT(left_of("x_percent\n.51\n.49\n.52\n", {"x_percent"}).other.notes.front(),
              HasSubstr("multiply them by 100"));
  EXPECT_THAT(left_of("angle_deg\n1.4\n1.7\n1.2\n").other.notes, IsEmpty());
}

TEST(OtherRows, RepeatedReadingsAreNoStatistics) {
  // The last value is the minimum, the median and one of the readings.
  for (const char* text :
       {"angle_deg\n0.51\n48.10\n51.65\n0.51\n0.51\n0.51\n", "angle_deg\n22\n23\n22\n23\n",
        "angle_deg\n22.5\n22.5\n22.5\n22.5\n", "angle_deg\n22.1\n22.9\n23.1\n22.4\n"}) {
    const Left left = left_of(text);
    EXPECT_THAT(left.error, IsEmpty()) << text;
    EXPECT_THAT(left.other.left_out, IsEmpty()) << text;
  }
}

TEST(OtherRows, ARowOfUnitsIsTakenOutAndMustAgree) {
  for (const char* unit : {"deg", "[deg]", "°", "(°)"}) {
    const Left left = left_of(std::string("sample,angle_deg\n,") + unit + "\na,22.1\nb,22.9\n");
    EXPECT_EQ(left.lines, (std::vector{3, 4})) << unit;
    EXPECT_EQ(left.other.left_out.at(0).why, "units");
    EXPECT_THAT(left.error, IsEmpty());
  }
  EXPECT_THAT(left_of("angle_deg\nrad\n.38\n").error,
              AllOf(HasSubstr("a.csv:2: angle_deg is in \"rad\""), HasSubstr("deg by its name")));
}

}  // namespace
}  // namespace repose::calibrate
