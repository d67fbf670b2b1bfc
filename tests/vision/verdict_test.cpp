#include "vision/measure/verdict.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>

#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FlankFit good_flank() {
  FlankFit fit;
  fit.status = FlankStatus::ok;
  fit.angle_rad = 28 * kDegree;
  fit.least_squares.r2 = 0.99;
  return fit;
}

/// A heap of 30 grains with a sharp edge, seen by a level camera.
struct JudgedHeap {
  SelectedCandidate choice;
  MeasureOptions options;
  ReposeAngle result;

  JudgedHeap() {
    Reading& best = choice.best;
    best.score = 0.7;
    best.body.mask = cv::Mat1b(10, 10, 255);
    best.profile.crest_height = 150;
    best.grain = 5;
    best.left = best.right = good_flank();
    result.angle_rad = result.left.angle_rad = result.right.angle_rad = 28 * kDegree;
    result.uncertainty_rad = result.left.uncertainty_rad = 0.01;
    result.right.uncertainty_rad = 0.01;
  }
  /// A foot on the right, excluded from the line.
  void give_apron(double from, bool is_high, double change_rad = 0) {
    choice.best.right.apron = Apron{.from = from, .is_high = is_high};
    choice.best.right.apron_rad = change_rad;
    result.right.apron = FlankApron{.from = from};
  }
  ReposeAngle judged() {
    judge(result, choice, options);
    return result;
  }
};

TEST(Judge, AGoodPictureIsOkWithoutAWord) {
  const ReposeAngle result = JudgedHeap().judged();
  EXPECT_EQ(result.status, MeasureStatus::ok);
  EXPECT_EQ(result.confidence, 1);
  EXPECT_THAT(result.reason, IsEmpty());
  EXPECT_THAT(result.warnings, IsEmpty());
  EXPECT_TRUE(result.angle_rad);
}

struct Error {
  const char* name;
  std::function<void(JudgedHeap&)> make;
  const char* says;  ///< part of the reason, or the warning's code
};

std::ostream& operator<<(std::ostream& out, const Error& error) { return out << error.name; }

std::string name_of(const ::testing::TestParamInfo<Error>& error) { return error.param.name; }

class Refusal : public ::testing::TestWithParam<Error> {};

TEST_P(Refusal, SaysWhyAndWhatToDoAndGivesNoNumber) {
  JudgedHeap heap;
  GetParam().make(heap);
  const ReposeAngle result = heap.judged();
  EXPECT_EQ(result.status, MeasureStatus::refused);
  EXPECT_THAT(result.reason, HasSubstr(GetParam().says));
  EXPECT_THAT(result.reason, HasSubstr("Fix: "));
  EXPECT_FALSE(result.angle_rad || result.uncertainty_rad);
  EXPECT_FALSE(result.left.angle_rad || result.left.uncertainty_rad);
  EXPECT_FALSE(result.right.angle_rad || result.right.uncertainty_rad);
}

INSTANTIATE_TEST_SUITE_P(
    ErrorList, Refusal,
    ::testing::Values(
        Error{"no_body", [](JudgedHeap& c) { c.choice.best.body.mask.release(); },
              "no heap stands out"},
        Error{"no_flank",
              [](JudgedHeap& c) {
                c.choice.best.left = c.choice.best.right = FlankFit{};
                c.choice.best.left.reason = "this side falls off vertically";
              },
              "left: this side falls off vertically"},
        Error{"faint_edge", [](JudgedHeap& c) { c.choice.best.score = 0.1; }, "too uncertain"},
        Error{"disagreement", [](JudgedHeap& c) { c.choice.disagreement.mean_rad = 3 * kDegree; },
              "too uncertain"},
        Error{"crest_cut", [](JudgedHeap& c) { c.choice.best.profile.leaves_frame_top = true; },
              "crest is outside"},
        Error{"from_above", [](JudgedHeap& c) { c.choice.best.body.ground.bow = 0.15; },
              "the curved base implies"},
        Error{"one_layer", [](JudgedHeap& c) { c.choice.best.grain = 100; }, "hardly higher"},
        Error{"level", [](JudgedHeap& c) { c.choice.best.right.angle_rad = 2 * kDegree; },
              "right side is level"},
        Error{"wall", [](JudgedHeap& c) { c.choice.best.left.angle_rad = 70 * kDegree; },
              "too steep for loose grains"},
        Error{"ball", [](JudgedHeap& c) { c.choice.best.left.bend_rad = -20 * kDegree; },
              "left side is round"},
        Error{"stepped", [](JudgedHeap& c) { c.choice.best.left.window_spread_rad = 15 * kDegree; },
              "left side's angle changes by 15 degrees"},
        Error{"ragged", [](JudgedHeap& c) { c.choice.best.right.least_squares.r2 = 0.7; },
              "not a line"}),
    name_of);

TEST(Judge, AnOutlineHoldsWhereOnlyAFlankIsRefused) {
  JudgedHeap round;
  round.choice.best.left.bend_rad = -20 * kDegree;
  EXPECT_TRUE(round.judged().outline_valid);
  JudgedHeap on_legs = round;
  on_legs.choice.likeness.filled = 0.8;
  EXPECT_FALSE(on_legs.judged().outline_valid);
  on_legs.options.hints.heap = Box{.x = 0, .y = 0, .width = 9, .height = 9};
  EXPECT_TRUE(on_legs.judged().outline_valid);
  JudgedHeap faint = round;
  faint.choice.best.score = 0.1;
  EXPECT_FALSE(faint.judged().outline_valid);
}

class Flagged : public ::testing::TestWithParam<Error> {};

TEST_P(Flagged, KeepsTheNumberAndAsksForALook) {
  JudgedHeap heap;
  GetParam().make(heap);
  const ReposeAngle result = heap.judged();
  EXPECT_EQ(result.status, MeasureStatus::flagged);
  EXPECT_TRUE(result.angle_rad);
  EXPECT_THAT(result.warnings, Contains(Field(&Warning::code, GetParam().says)));
}

INSTANTIATE_TEST_SUITE_P(
    ErrorList, Flagged,
    ::testing::Values(
        Error{"weak_edge", [](JudgedHeap& c) { c.choice.best.score = 0.25; }, "weak_edge"},
        Error{"hollow", [](JudgedHeap& c) { c.choice.best.left.bend_rad = 12 * kDegree; },
              "bent_flank"},
        Error{"window", [](JudgedHeap& c) { c.choice.best.left.window_spread_rad = 4 * kDegree; },
              "window_sensitive"},
        Error{"wide", [](JudgedHeap& c) { c.result.uncertainty_rad = 6 * kDegree; },
              "wide_interval"},
        Error{"legs", [](JudgedHeap& c) { c.choice.likeness.filled = 0.8; }, "unlike_a_heap"},
        Error{"lopsided", [](JudgedHeap& c) { c.result.left.angle_rad = 45 * kDegree; },
              "unequal_flanks"},
        Error{"low", [](JudgedHeap& c) { c.choice.best.profile.crest_height = 30; }, "low_heap"},
        Error{"bow", [](JudgedHeap& c) { c.choice.best.body.ground.bow = 0.045; }, "base_bows"},
        Error{"behind", [](JudgedHeap& c) { c.choice.best.body.ground.behind = true; },
              "edge_behind"}),
    name_of);

class Noted : public ::testing::TestWithParam<Error> {};

TEST_P(Noted, LeavesTheNumberOk) {
  JudgedHeap heap;
  GetParam().make(heap);
  const ReposeAngle result = heap.judged();
  EXPECT_EQ(result.status, MeasureStatus::ok);
  EXPECT_THAT(result.warnings, ElementsAre(Field(&Warning::code, GetParam().says)));
  EXPECT_THAT(result.warnings.at(0).message, ::testing::EndsWith("."));
}

INSTANTIATE_TEST_SUITE_P(
    ErrorList, Noted,
    ::testing::Values(
        Error{"truncated",
              [](JudgedHeap& c) { c.choice.best.left.status = FlankStatus::truncated; },
              "flank_truncated"},
        Error{"absent", [](JudgedHeap& c) { c.choice.best.left.status = FlankStatus::absent; },
              "one_flank"},
        Error{"cut", [](JudgedHeap& c) { c.choice.best.left.frame_cut = true; },
              "flank_cut_by_frame"},
        Error{"apron", [](JudgedHeap& c) { c.give_apron(0.25, false); }, "apron_left_out"},
        Error{"grains", [](JudgedHeap& c) { c.choice.best.grain = 20; }, "few_grains"},
        Error{"tilt", [](JudgedHeap& c) { c.choice.best.body.ground.slope = 0.07; },
              "tilted_picture"},
        Error{"mirror", [](JudgedHeap& c) { c.choice.best.body.ground.mirrored = true; }, "mirror"},
        Error{"strays", [](JudgedHeap& c) { c.result.loose_particles = 3; }, "strays"},
        Error{"definitions",
              [](JudgedHeap& c) {
                c.result.definitions = {{"cone", "", 25 * kDegree}};
              },
              "definitions_differ"},
        Error{"hints",
              [](JudgedHeap& c) {
                c.options.hints.ground = Segment{{0, 9}, {9, 9}};
              },
              "hints"},
        Error{"unequal", [](JudgedHeap& c) { c.result.left.angle_rad = 20 * kDegree; },
              "unequal_flanks"}),
    name_of);

TEST(Judge, AHighApronIsFlaggedAndNamed) {
  JudgedHeap heap;
  heap.give_apron(0.4, true, 3 * kDegree);
  const ReposeAngle result = heap.judged();
  EXPECT_EQ(result.status, MeasureStatus::flagged);
  EXPECT_THAT(result.warnings, ElementsAre(Field(&Warning::code, "apron_left_out"),
                                           Field(&Warning::code, "high_apron")));
}

TEST(Judge, AHighApronThatDecidesTheAngleIsRefused) {
  JudgedHeap low, high;
  low.give_apron(0.3, false, 13 * kDegree);
  high.give_apron(0.4, true, 13 * kDegree);
  EXPECT_EQ(low.judged().status, MeasureStatus::ok);
  EXPECT_EQ(high.judged().status, MeasureStatus::refused);
}

/// A hollow flank whose definitions differ.
JudgedHeap hollow_heap(double bend_rad, double other_rad) {
  JudgedHeap heap;
  heap.choice.best.left.bend_rad = bend_rad;
  heap.result.uncertainty_rad = 1 * kDegree;
  heap.result.definitions = {{"whole_flank", "", other_rad}};
  return heap;
}

TEST(Judge, DefinitionsThatLieFarApartOnAHollowFlankAreFlagged) {
  // The angle is 28 +- 1 degrees: 24 is 3 beyond the interval.
  EXPECT_EQ(hollow_heap(5 * kDegree, 23.9 * kDegree).judged().status, MeasureStatus::flagged);
  EXPECT_EQ(hollow_heap(5 * kDegree, 32.1 * kDegree).judged().status, MeasureStatus::flagged);
  EXPECT_EQ(hollow_heap(5 * kDegree, 24.1 * kDegree).judged().status, MeasureStatus::ok);
  EXPECT_EQ(hollow_heap(0, 23.9 * kDegree).judged().status, MeasureStatus::ok)
      << "rounded crests and toes lower some of them on every heap";
  EXPECT_THAT(hollow_heap(5 * kDegree, 23.9 * kDegree).judged().warnings,
              ElementsAre(Field(&Warning::code, "definitions_differ")));
}

TEST(Judge, FlanksThatTheirIntervalsLetDifferAreNoTrouble) {
  JudgedHeap heap;
  heap.result.left.angle_rad = 45 * kDegree;
  heap.result.left.uncertainty_rad = 18 * kDegree;
  EXPECT_EQ(heap.judged().status, MeasureStatus::ok);
}

TEST(Judge, WhatTheGrainsScatterExplainsIsNoBend) {
  JudgedHeap heap;
  heap.choice.best.left.bend_rad = 12 * kDegree;
  heap.choice.best.left.fit_error_rad = 1.5 * kDegree;
  EXPECT_EQ(heap.judged().status, MeasureStatus::ok);
}

TEST(Judge, AWindowWhoseChangeTheIntervalCoversIsNoTrouble) {
  JudgedHeap heap;
  heap.choice.best.left.window_spread_rad = 4 * kDegree;
  heap.result.left.uncertainty_rad = 3.5 * kDegree;
  EXPECT_EQ(heap.judged().status, MeasureStatus::ok);
}

TEST(Judge, WhoSaysThatItIsAHeapIsBelieved) {
  JudgedHeap heap;
  heap.choice.likeness.filled = 0.8;
  EXPECT_LE(heap.judged().confidence, 0.5);
  JudgedHeap told;
  told.choice.likeness.filled = 0.8;
  told.choice.is_pointed_at = true;
  EXPECT_EQ(told.judged().status, MeasureStatus::ok);
}

ReposeAngle judged_with(std::optional<double> base_bow, double pitch_deg) {
  JudgedHeap heap;
  heap.choice.best.body.ground.bow = base_bow;
  heap.options.camera_pitch_rad = pitch_deg * kDegree;
  return heap.judged();
}

TEST(Judge, ABowedBaseIsNoErrorWhenItsPitchIsGiven) {
  // By pitch_from_bow: 7 and 24 degrees.
  EXPECT_EQ(judged_with(0.045, 7).status, MeasureStatus::ok);
  EXPECT_EQ(judged_with(0.15, 24).status, MeasureStatus::ok);
}

TEST(Judge, ABaseThatBowsOtherwiseThanThePitchGivenIsFlagged) {
  for (const ReposeAngle& result :
       {judged_with(0, 17), judged_with(0.15, 5), judged_with(.15, 0)}) {
    EXPECT_EQ(result.status, MeasureStatus::flagged);
    EXPECT_THAT(result.warnings, ElementsAre(Field(&Warning::code, "pitch_disagrees")));
  }
}

TEST(Judge, ACameraThatLooksUpIsFlagged) {
  EXPECT_EQ(judged_with(std::nullopt, -20).status, MeasureStatus::flagged);
  EXPECT_THAT(judged_with(0, -15).warnings, ElementsAre(Field(&Warning::code, "pitch_disagrees")));
  EXPECT_EQ(judged_with(0, -3).status, MeasureStatus::ok);
}

TEST(Judge, ABaseThatIsNotSeenDisagreesWithNoPitch) {
  const ReposeAngle result = judged_with(std::nullopt, 17);
  EXPECT_EQ(result.status, MeasureStatus::ok);
  EXPECT_THAT(result.warnings, ::testing::IsEmpty());
}

TEST(Judge, ConfidenceFallsWithTheEdgeAndWithDisagreement) {
  const auto confidence = [](double score, double disagreement_deg) {
    JudgedHeap heap;
    heap.choice.best.score = score;
    heap.choice.disagreement.mean_rad = disagreement_deg * kDegree;
    return heap.judged().confidence;
  };
  EXPECT_GT(confidence(0.5, 0), confidence(0.4, 0));
  EXPECT_GT(confidence(0.5, 0), confidence(0.5, 1));
  EXPECT_GT(confidence(0.5, 1), confidence(0.5, 2));
  EXPECT_LE(confidence(1, 0), 1);
  EXPECT_EQ(confidence(0, 0), 0);
}

}  // namespace
}  // namespace repose::vision
