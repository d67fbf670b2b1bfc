#include "calibrate/result/result.h"

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/fit/propose.h"
#include "calibrate/result/result_text.h"
#include "tests/calibrate/made_up_result.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using test::joint_in;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

const std::string kName = "FOLDER/result.json";

std::vector<StudyResult> both() { return {test::joint_result(), test::published_result()}; }

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Result, OfBothMethodsComesBackFromItsText) {
  for (const StudyResult& result : both()) {
    const std::string text = to_json(result);
    EXPECT_TRUE(result_from_json(text, kName) == result);
    EXPECT_EQ(to_json(result_from_json(text, kName)), text);
  }
}

TEST(Result, NumbersThatDoNotExistAreNull) {
  StudyResult result = test::joint_result();
  joint_in(result).observables[0].verification->simulated = std::nan("");
  joint_in(result).parameters[0].interval.high = std::numeric_limits<double>::infinity();
  const std::string text = to_json(result);
  EXPECT_THAT(text, AllOf(HasSubstr("\"simulated\": null"), HasSubstr("0.35,\n        null")));
  StudyResult read = result_from_json(text, kName);
  EXPECT_TRUE(std::isnan(joint_in(read).observables[0].verification->simulated));
  EXPECT_TRUE(std::isnan(joint_in(read).parameters[0].interval.high));
  EXPECT_EQ(to_json(read), text);
}

TEST(Result, OfASurfaceThatIsNowhereLevelComesBack) {
  StudyResult result = test::joint_result();
  int changed = 0;
  for (ObservableSurface& observable : joint_in(result).regressions) {
    if (!observable.regression) continue;
    observable.regression->canonical->region = StationaryRegion{};
    ++changed;
  }
  ASSERT_GT(changed, 0);
  const std::string text = to_json(result);
  EXPECT_THAT(text, HasSubstr("\"in_box\": false"));
  EXPECT_TRUE(result_from_json(text, kName) == result);
}

TEST(Result, OfASurfaceThatDoesNotReachTheReadingComesBack) {
  StudyResult result = test::joint_result();
  int changed = 0;
  for (ObservableSurface& observable : joint_in(result).regressions) {
    if (!observable.regression || !observable.regression->target) continue;
    const double value = observable.regression->target->value;
    observable.regression->target = SurfaceTarget{.value = value,
                                                  .uncertainty = 0,
                                                  .is_reached = false,
                                                  .ranges = {},
                                                  .through_centre = {},
                                                  .points = {}};
    ++changed;
  }
  ASSERT_GT(changed, 0);
  const std::string text = to_json(result);
  EXPECT_THAT(text, HasSubstr("\"ranges\": {}"));
  EXPECT_TRUE(result_from_json(text, kName) == result);
}

TEST(Result, OfAnEarlierVersionHasNoShapeCheckAndIsRead) {
  StudyResult result = test::joint_result();
  joint_in(result).shape_check.reset();
  const std::string text = to_json(result);
  EXPECT_THAT(text, Not(HasSubstr("shape_check")));
  StudyResult read = result_from_json(text, kName);
  EXPECT_FALSE(joint_in(read).shape_check);
}

TEST(Result, KnowsWhichInputWasVaried) {
  StudyResult read = result_from_json(to_json(test::joint_result()), kName);
  const SensitivityCheck& stiffer = joint_in(read).stiffness_checks.at(0);
  EXPECT_EQ(stiffer.input, AssumedInput::stiffness);
  EXPECT_EQ(stiffer.value, .1);
  const ShapeCheck& shape = joint_in(read).shape_check.value();
  EXPECT_EQ(shape.readings.at(0).input, AssumedInput::spheres);
  EXPECT_EQ(shape.readings.at(0).value, 44);
  EXPECT_EQ(shape.readings.at(0).multiple, 4);
}

TEST(Result, SaysWhyTheNumberOfSpheresWasNotChecked) {
  ShapeCheck shape;
  EXPECT_THAT(shape_check_text(shape), IsEmpty());
  shape.over_budget = {"roll", "heap"};
  EXPECT_THAT(shape_check_text(shape),
              HasSubstr("for roll, heap: it would take more than a fifth"));
  shape.not_made = "one sphere is exactly the shape of this particle";
  EXPECT_THAT(shape_check_text(shape), HasSubstr("was not checked: one sphere is exactly"));
}

TEST(Result, WithoutADampingItWasPerContact) {
  StudyResult result = test::joint_result();
  result.provenance.model->damping = "shared";
  result.provenance.model->damping_definition = "together";
  EXPECT_TRUE(result_from_json(to_json(result), kName) == result);
  const std::string older = with(to_json(result), "\"damping\": \"shared\"", "\"x\": 1");
  const ModelFacts read = result_from_json(older, kName).provenance.model.value();
  EXPECT_EQ(read.damping, "per_contact");
  EXPECT_THAT(read.damping_definition, HasSubstr("number of spheres"));
}

TEST(Result, NamesNeedNotBeUtf8) {
  StudyResult result = test::joint_result();
  result.provenance.study.file = "n\xFCsse.toml";
  EXPECT_EQ(result_from_json(to_json(result), kName).provenance.study.file,
            "n\xEF\xBF\xBDsse.toml");
}

TEST(Result, ErrorsSayWhatIsWrongAndWhere) {
  const std::string joint = to_json(test::joint_result());
  const std::string published = to_json(test::published_result());
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"", "parse error"},
      {"[1]", "all of it: must be an object"},
      {"{}", "method: is missing"},
      {with(joint, "\"joint\"", "\"best\""), "method: \"best\" must be joint or paper"},
      {with(joint, "\"determined\"", "\"sure\""),
       "parameters[0].verdict: \"sure\" must be one of determined, bounded, one-sided, "
       "undetermined"},
      {with(joint, "\"value\": 0.4", "\"value\": \"0.4\""),
       "parameters[0].value: must be a number or null"},
      {with(joint, "\"first_seed\": 7", "\"first_seed\": 7.5"),
       "provenance.first_seed: must be a whole number"},
      {with(joint, "\"observable\": \"drop\",\n      \"parameter\"",
            "\"observable\": \"roll\",\n      \"parameter\""),
       "responses[0].observable: \"roll\" is not known here"},
      {with(joint, "\"scatter\": [\n        0.5,\n", "\"scatter\": [\n"),
       "responses[0]: its lists"},
      {with(published, "\"levels\": [\n        0.0,\n", "\"levels\": [\n"), "sweeps: levels and"},
      {with(published, "\"r2\": 1.0", "\"r3\": 1.0"), "sweeps[0].r2: is missing"}};
  for (const auto& [text, message] : wrong) {
    EXPECT_THAT([&text = text] { result_from_json(text, kName); },
                ThrowsMessage<base::InputError>(
                    AllOf(HasSubstr(kName), HasSubstr(message), HasSubstr("Fix: "))));
  }
}

// However the text is damaged, it is either read or rejected.
TEST(Result, DamagedTextIsNeverMoreThanRefused) {
  for (const StudyResult& result : both()) {
    const std::string text = to_json(result);
    for (std::size_t k = 0; k < text.size(); k += 13) {
      for (const char* instead : {"", "[", "\"", "9"}) {
        std::string damaged = text;
        damaged.replace(k, 1, instead);
        try {
          result_from_json(damaged, kName);
        } catch (const base::InputError& refused) {
          EXPECT_THAT(refused.what(), HasSubstr("Fix: "));
        }
      }
    }
  }
}

TEST(Result, IsReadFromItsFolder) {
  const repose::testing::TemporaryFolder folder;
  EXPECT_FALSE(read_result(folder.path()));
  folder.write("result.json", to_json(test::joint_result()));
  EXPECT_TRUE(read_result(folder.path()) == test::joint_result());
}

TEST(Result, SaysOfWhichStudyItIsEvenWhenTheRestIsUnknown) {
  const std::string text = to_json(test::published_result());
  for (const std::string& each : {text, with(text, "\"sweeps\"", "\"of another version\"")}) {
    EXPECT_EQ(study_in_result(each)->hash, "abc-1");
    EXPECT_EQ(study_in_result(each)->method, "paper");
  }
  EXPECT_FALSE(study_in_result("{}"));
  EXPECT_FALSE(study_in_result("no JSON"));
}

/// A tilting plate that slides at 50 degrees per unit of friction, fitted and checked.
struct MadeUpStudy {
  StudyRecord record;
  StudyProblem problem;
  StudyOutcome outcome;
};

MadeUpStudy plate_study() {
  MadeUpStudy made;
  made.record.method = "joint";
  made.record.budget = budget_named("quick");
  made.record.study.file = "folder/plate.toml";
  made.problem.notes = {"a note"};
  Problem& problem = made.problem.problem;
  problem.parameters = {{"friction", .1, .8, Prior{.4, .3}}};
  problem.experiments = {{"tilt", {0}, .5, false, {"value"}}};
  problem.observables = {{"tilt", "tilt", "value", "deg", 20, .9, 10, {}}};
  const auto run = [](const std::vector<Job>& jobs) {
    std::vector<Run> runs;
    for (const Job& job : jobs) {
      runs.push_back({job, {{"value", 50 * job.values[0]}, {"timestep_s", 1e-5}}, ""});
    }
    return runs;
  };
  StudyOutcome& outcome = made.outcome;
  outcome.runs = run(propose(problem, {}));
  outcome.fit = fit_jointly(problem, outcome.runs);
  const std::vector<double> best = {outcome.fit.parameters[0].value};
  outcome.surrogates.resize(1);
  outcome.check_rounds = 1;
  outcome.best = verify(problem, best, run(verification_jobs(problem, best, 2, 0)), &outcome.fit);
  outcome.notes = {"another note"};
  return made;
}

TEST(Result, SetsThatFailedTheirCheckAreNotAmongTheEquallyGoodOnes) {
  MadeUpStudy made = plate_study();
  Verification check = made.outcome.best;
  check.values = {.45};
  check.verdict = AgreementVerdict::disagrees;
  made.outcome.family = {{check, 1.5}};
  made.outcome.fit.equivalence_family = {{{.46}, 1.4}, {{.7}, 3}};
  const StudyResult result = result_of(made.record, made.problem, made.outcome);
  const auto& family = std::get<JointResult>(result.found).equivalence_family;
  ASSERT_THAT(family, SizeIs(1)) << "neither the set nor its neighbour";
  EXPECT_EQ(family[0].values[0], .7);
}

TEST(Result, OfAFinishedStudyHoldsWhatWasFoundAndWhatItBelongsTo) {
  const MadeUpStudy made = plate_study();
  StudyResult result = result_of(made.record, made.problem, made.outcome);
  const JointResult& joint = joint_in(result);
  ASSERT_THAT(joint.parameters, SizeIs(1));
  EXPECT_EQ(joint.parameters[0].value, made.outcome.fit.parameters[0].value);
  EXPECT_EQ(joint.parameters[0].bounds.high, .8);
  EXPECT_EQ(joint.parameters[0].known_before->mean, .4);
  EXPECT_EQ(joint.observables[0].verification->runs, 1) << "there is no chance in it";
  EXPECT_EQ(joint.verdict, AgreementVerdict::agrees);
  EXPECT_EQ(joint.observables[0].verification->tolerance, 2) << "an angle";
  EXPECT_EQ(joint.agreement.rounds, 1);
  EXPECT_EQ(joint.agreement.values[0], made.outcome.fit.parameters[0].value);
  EXPECT_THAT(joint.agreement.text, HasSubstr("reproduced, not tested"));
  ASSERT_TRUE(joint.degrees_of_freedom);
  EXPECT_LT(*joint.degrees_of_freedom, .7) << "one reading, a prior, one coefficient";
  EXPECT_EQ(joint.warnings[0], "a note");
  EXPECT_EQ(joint.warnings[1], "another note");
  EXPECT_EQ(joint.runs.size(), made.outcome.runs.size());
  ASSERT_TRUE(joint.regressions[0].regression);
  EXPECT_NEAR(joint.regressions[0].regression->r2, 1, 1e-9);
  EXPECT_THAT(joint.regressions[0].regression->runs, IsEmpty());
  EXPECT_EQ(result.provenance.study.file, "plate.toml");
  EXPECT_EQ(result.provenance.study.budget, "quick");
  EXPECT_EQ(result.provenance.model->shortest_timestep_s, (NamedValues{{"tilt", 1e-5}}));
  EXPECT_TRUE(result_from_json(to_json(result), kName) == result);
}

TEST(Result, WarnsOfAClumpOfAnotherShapeAndOfRollsThatHop) {
  MadeUpStudy made = plate_study();
  made.record.grain.source = "stick";
  made.record.grain.shape = dem::sphere_shape(5e-3);
  made.record.study.model.rolling = dem::RollingModel::elastic_plastic;
  for (auto& run : made.outcome.runs) run.readings["hop_mm"] = .04;
  const auto warnings = [&] {
    StudyResult result = result_of(made.record, made.problem, made.outcome);
    return joint_in(result).warnings;
  };
  const std::size_t usual = warnings().size();
  made.record.grain.errors.volume_error = .86;
  made.outcome.runs.back().readings["hop_mm"] = 3;
  const std::vector<std::string> more = warnings();
  EXPECT_THAT(more, SizeIs(usual + 2));
  EXPECT_THAT(more, Contains(HasSubstr("stick: 1 sphere is not its shape: 86 %")));
  EXPECT_THAT(more, Contains(AllOf(HasSubstr("hops along the flat by up to 3 mm"),
                                   HasSubstr("Fix: a gentler incline"))));
  made.record.study.model.rolling = dem::RollingModel::constant_torque;
  EXPECT_THAT(warnings(), SizeIs(usual + 1));
}

Verification disagreeing(const std::vector<int>& runs, double chance) {
  Verification check{.values = {}, .observables = {}, .chance = chance};
  check.verdict = AgreementVerdict::disagrees;
  for (const int count : runs) {
    Agreement& agreement = check.observables.emplace_back();
    agreement.observable = "test_" + std::to_string(check.observables.size());
    agreement.verdict = AgreementVerdict::disagrees;
    agreement.runs = count;
  }
  return check;
}

/// Four experiments: three agree, the last is undecided.
Verification inconclusive(const Agreement& open) {
  Verification check{.values = {}, .observables = {}, .chance = .98};
  check.verdict = AgreementVerdict::cannot_tell;
  for (const char* name : {"tilt", "roll", "heap"}) {
    Agreement& agreement = check.observables.emplace_back();
    agreement.observable = name;
    agreement.verdict = AgreementVerdict::agrees;
    agreement.runs = 9;
  }
  check.observables.push_back(open);
  return check;
}

TEST(AgreementText, SaysWhatAgreesBeforeWhatDoesNot) {
  Agreement drop;
  drop.observable = "drop";
  drop.verdict = AgreementVerdict::cannot_tell;
  drop.runs = 9;
  drop.difference = {-3, 4};
  drop.tolerance = 1;
  EXPECT_EQ(agreement_text(inconclusive(drop), 3),
            "three of four experiments agree (tilt, roll, heap); the drop is inconclusive: its "
            "readings scatter too much for its margin; no difference is shown (as large ones "
            "arise by chance in 98 % of cases)");
  drop.runs = 1;
  drop.detectable = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(agreement_text(inconclusive(drop), 3), HasSubstr("its readings scatter too much"))
      << "of an experiment without chance one run is enough, and a fit may follow its reading";
  drop.difference = {-.5, .5};
  EXPECT_THAT(agreement_text(inconclusive(drop), 3), HasSubstr("some of its runs gave no reading"));
  drop.difference.low = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(agreement_text(inconclusive(drop), 3),
              HasSubstr("too few of its runs gave a reading"));
  drop.difference = {-3, 4};
  drop.runs_to_decide = 40;
  EXPECT_THAT(agreement_text(inconclusive(drop), 3),
              HasSubstr("the drop is inconclusive: it was simulated too few times;"));
  Verification two = inconclusive(drop);
  two.observables[2].verdict = AgreementVerdict::cannot_tell;
  two.observables[2].difference = {-3, 4};
  two.observables[2].runs_to_decide = 30;
  EXPECT_THAT(agreement_text(two, 3),
              HasSubstr("two of four experiments agree (tilt, roll); heap, drop are inconclusive: "
                        "they were simulated too few times;"));
  two.verdict = AgreementVerdict::disagrees;
  EXPECT_THAT(agreement_text(two, 3), HasSubstr("(tilt, roll); bench and simulation disagree:"));
}

TEST(SummarySentences, BeginWithWhatWasPredictedAndSayThatOnlyWholeSetsFit) {
  StudyResult result = test::joint_result();
  JointResult& joint = test::joint_in(result);
  const std::vector<std::string> sentences = summary_sentences(joint);
  ASSERT_EQ(sentences.size(), 3U);
  EXPECT_THAT(sentences[0], AllOf(HasSubstr("Held out of the fit: roll is predicted as"),
                                  HasSubstr("and was measured as")));
  EXPECT_THAT(sentences[1], HasSubstr("In simulations with fresh seeds, " + joint.agreement.text));
  EXPECT_THAT(sentences[2],
              AllOf(HasSubstr("1 of 2 coefficients is determined"),
                    HasSubstr("1 is undetermined: these measurements hardly constrain it.")));
  EXPECT_TRUE(has_open_coefficients(joint));
  joint.parameters[0].verdict = Verdict::undetermined;
  EXPECT_THAT(summary_sentences(joint)[2],
              HasSubstr("2 are undetermined: only certain combinations of them and of the others"));
  joint.parameters[0].verdict = Verdict::determined;
  joint.held_out.clear();
  joint.parameters[1].verdict = Verdict::determined;
  EXPECT_FALSE(has_open_coefficients(joint));
  joint.verdict = AgreementVerdict::disagrees;
  EXPECT_THAT(summary_sentences(joint),
              ::testing::ElementsAre(HasSubstr("Do not use these coefficients"),
                                     "Both coefficients are determined by these measurements."));
}

TEST(GoodSets, BeginWithTheFittedValues) {
  StudyResult result = test::joint_result();
  const std::vector<EquivalentSet> sets = good_sets(test::joint_in(result));
  ASSERT_EQ(sets.size(), 3U);
  EXPECT_EQ(sets[0].values, (std::vector<double>{.4, .3}));
  EXPECT_EQ(sets[0].chi2, 0);
  EXPECT_EQ(sets[0].verdict, AgreementVerdict::cannot_tell);
  EXPECT_EQ(sets[2].values, (std::vector<double>{.39, .7}));
}

TEST(AgreementText, SaysWhetherReadingsDifferOrAreMissing) {
  EXPECT_EQ(agreement_text(disagreeing({0}, 1), 2),
            "bench and simulation disagree: no run gave a reading of test_1");
  EXPECT_THAT(agreement_text(disagreeing({6}, .01), 2),
              AllOf(HasSubstr("by chance in 1 % of cases"), HasSubstr("it is test_1 that differs"),
                    Not(HasSubstr("no run"))));
  EXPECT_THAT(
      agreement_text(disagreeing({0, 6}, .01), 2),
      AllOf(HasSubstr("it is test_2 that differs"), HasSubstr("no run gave a reading of test_1")));
  EXPECT_THAT(agreement_text(disagreeing({}, .01), 2), HasSubstr("no single experiment"));
}

TEST(AgreementText, WhatTheCoefficientsUseUpIsReproducedNotTested) {
  Verification check;
  check.verdict = AgreementVerdict::agrees;
  EXPECT_THAT(agreement_text(check, .4),
              AllOf(HasSubstr("reproduced, not tested"), HasSubstr("0.4 degrees of freedom")));
  EXPECT_THAT(agreement_text(check, 1), Not(HasSubstr("not tested")));
  check.verdict = AgreementVerdict::cannot_tell;
  EXPECT_THAT(agreement_text(check, 0), HasSubstr("reproduced, not tested"));
}

TEST(AgreementText, ADifferenceTooSmallToMatterIsSaidAllTheSame) {
  Verification check;
  check.verdict = AgreementVerdict::agrees;
  check.chance = .02;
  EXPECT_THAT(agreement_text(check, 1),
              AllOf(HasSubstr("within its margin; "), HasSubstr("more than chance makes"),
                    HasSubstr("in 2 % of cases")));
  check.chance = .2;
  EXPECT_THAT(agreement_text(check, 1), Not(HasSubstr("more than chance")));
}

TEST(CoarseText, SaysWhatIsAssumedBeforeThereIsARunOfTheStudysOwnGrains) {
  StudyResult result = test::joint_result();
  JointResult& joint = joint_in(result);
  EXPECT_THAT(coarse_text(joint),
              AllOf(HasSubstr("8 of 12 runs of drop"), HasSubstr("2 more of these gave no reading"),
                    Not(HasSubstr("assumed"))));
  for (SurrogateQuality& surrogate : joint.surrogates) surrogate.coarse->runs = surrogate.runs;
  EXPECT_THAT(coarse_text(joint), HasSubstr("12 of 12 runs of drop"));
  EXPECT_THAT(coarse_text(joint), HasSubstr("which is assumed: none of the study's own"));
}

TEST(CoarseText, SaysThatNoRunHadTheStudysOwnGrains) {
  StudyResult result = test::joint_result();
  JointResult& joint = joint_in(result);
  for (SurrogateQuality& surrogate : joint.surrogates) surrogate.full_size = 1.46;
  EXPECT_THAT(coarse_text(joint),
              AllOf(HasSubstr("no run of drop had the study's own grains"),
                    HasSubstr("full runs and checks were of grains 1.46 times as large"),
                    HasSubstr("beside those 1.46 times as large"), Not(HasSubstr("assumed"))));
  for (SurrogateQuality& surrogate : joint.surrogates) surrogate.coarse->runs = surrogate.runs;
  EXPECT_THAT(coarse_text(joint), HasSubstr("which is assumed: none of these"));
  for (SurrogateQuality& surrogate : joint.surrogates) surrogate.coarse.reset();
  EXPECT_THAT(coarse_text(joint), HasSubstr("no run of drop had the study's own grains"));
}

TEST(AgreementText, AVerdictThatRestsOnABoundSaysWhatTheBoundIs) {
  ResultParameter parameter;
  parameter.verdict = Verdict::one_sided;
  parameter.bounds = {.1, .8};
  parameter.interval = {.4, .8};
  EXPECT_THAT(bounds_text(parameter), AllOf(HasSubstr("0.8"), HasSubstr("does not say")));
  parameter.bounds_are = BoundsOrigin::known;
  EXPECT_THAT(bounds_text(parameter), HasSubstr("known beforehand"));
  parameter.bounds_are = BoundsOrigin::convenience;
  EXPECT_THAT(bounds_text(parameter), HasSubstr("convenience"));
  parameter.verdict = Verdict::bounded;
  EXPECT_EQ(bounds_text(parameter), "");
}

}  // namespace
}  // namespace repose::calibrate
