#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/distributions.h"
#include "calibrate/bench/bench_readings.h"
#include "calibrate/study/study_problem.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/grain_source.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The row that the video of a drop gives.
FilmReading reading_of(double drop_mm, double rebound_mm, double uncertainty_mm) {
  FilmReading film{
      .experiment = "drop", .file = "a.mp4", .status = "ok", .value = {}, .reason = {}};
  read_row(*dem::experiment_of<dem::DropProtocol>(), dem::DropProtocol{.height_m = .1},
           {{"drop_mm", {drop_mm, uncertainty_mm}}, {"rebound_mm", {rebound_mm, uncertainty_mm}}},
           film);
  return film;
}

/// The drop's observable, as the fit sees it, after these videos.
Observable drop_after(const std::vector<FilmReading>& films) {
  const TemporaryFolder folder;
  std::string text = test::kSphereStudy;
  const std::string mean = "mean = 25, sd = 1, n = 5";
  text.replace(text.find(mean), mean.size(), "videos = [\"*.mp4\"]");
  const dem::Study study = with_films(dem::read_study(folder.write("study.toml", text)), films);
  return problem_of(study, dem::build_grain(study.grain), budget_named("quick"))
      .problem.observables.at(0);
}

TEST(BenchFilms, GiveTheValueOfTheExperimentsSheet) {
  const FilmReading film = reading_of(100.4, 36, 2);
  EXPECT_EQ(film.value, 36);
  EXPECT_EQ(film.uncertainty, 2);
  EXPECT_EQ(film.status, "ok");
  EXPECT_THAT(film.reason, IsEmpty());
}

TEST(BenchFilms, OfAnotherFallThanTheStudysAreRefused) {
  EXPECT_TRUE(reading_of(102.9, 36, 2).value) << "within 1 % and its interval";
  const FilmReading film = reading_of(103.1, 36, 2);
  EXPECT_FALSE(film.value);
  EXPECT_EQ(film.status, "refused");
  EXPECT_THAT(film.reason, AllOf(HasSubstr("drop_mm = 103.1"), HasSubstr("height_mm = 100"),
                                 HasSubstr("Fix: write height_mm = 103.1")));
}

TEST(BenchFilms, AreRepeatsThatScatterAsTheyDo) {
  const Observable drop = drop_after(
      {reading_of(100, 30, 1),
       reading_of(100, 36, 1),
       reading_of(100, 42, 1),
       {.experiment = "drop", .file = "b.mp4", .status = "refused", .value = {}, .reason = {}}});
  EXPECT_DOUBLE_EQ(drop.mean, 36);
  EXPECT_EQ(drop.n, 3);
  EXPECT_DOUBLE_EQ(*drop.sd, 6);
}

TEST(BenchFilms, ThatAgreeByChanceAreNoSurerThanEachIs) {
  const Observable drop =
      drop_after({reading_of(100, 36, base::kNormal95), reading_of(100, 36.1, base::kNormal95)});
  EXPECT_NEAR(*drop.sd, 1, 1e-9);
}

// All videos show a fall .8 % too long, so the rebounds may be too, however many there are.
TEST(BenchFilms, WhatFilmsShareIsToldByTheFallThatTheyShow) {
  const std::vector<FilmReading> films = {reading_of(100.9, 30, .1), reading_of(100.7, 36, .1),
                                          reading_of(100.8, 42, .1)};
  const Observable drop = drop_after(films);
  ASSERT_EQ(drop.systematic.size(), 1U);
  EXPECT_EQ(drop.systematic[0].name, "film");
  EXPECT_NEAR(drop.systematic_sd, .008 * 36, 1e-9);
  EXPECT_THAT(drop.systematic[0].note, HasSubstr("+0.8 % off"));
  std::vector<FilmReading> many;
  for (int k = 0; k < 100; ++k) many.insert(many.end(), films.begin(), films.end());
  EXPECT_NEAR(drop_after(many).systematic_sd, .008 * 36, 1e-9);
  EXPECT_NEAR(drop_after({reading_of(100.9, 30, .1), reading_of(99.1, 36, .1)}).systematic_sd, 0,
              1e-9)
      << "that is chance";
}

TEST(BenchFilms, OneAloneAddsItsIntervalToTheScatterThatIsAssumed) {
  const Observable drop = drop_after({reading_of(100, 40, base::kNormal95 * 2)});
  EXPECT_FALSE(drop.sd);
  const double usual = dem::experiment_of<dem::DropProtocol>()->usual_scatter;
  EXPECT_NEAR(*drop.assumed_sd_fraction, std::hypot(usual, .05), 1e-9);
  EXPECT_NEAR(*drop_after({reading_of(100, 40, 0)}).assumed_sd_fraction, usual, 1e-9);
}

}  // namespace
}  // namespace repose::calibrate
