// Calibrations over HTTP: started, watched, stopped, killed, resumed; the folder's state
// afterwards.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/folder_lock.h"
#include "calibrate/experiment/run_store.h"
#include "tests/studio/served_folder.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

namespace repose::studio {
namespace {

using test::ServedFolder;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kState = "/api/calibration?study=peas.toml";
constexpr const char* kTask = "/api/tasks?study=peas.toml&task=calibrate";

class StudioCalibrations : public ::testing::Test {
 protected:
  StudioCalibrations() {
    studio_.post("/api/studies", Json::parse(R"({"study": "peas", "grains": "pea",
        "plate": "wood", "experiments": ["drop", "tilt"]})"));
    fill_in("peas");
  }

  void fill_in(const std::string& study) const {
    studio_.folder.write(study + "/drops.csv",
                         std::string("drop_mm,rebound_mm\n500,180\n500,176\n500,187\n500,172\n"));
    studio_.folder.write(study + "/tilts.csv", std::string("angle_deg\n19.8\n20.6\n21.1\n19.5\n"));
  }

  static std::string with_study(std::string address, const std::string& study) {
    return address.replace(address.find("peas"), std::string("peas").size(), study);
  }

  /// How the newest task of the study ended.
  Json ended(const std::string& study = "peas") const {
    for (int k = 0; k < 12'000; ++k) {  // 10 minutes: for slow machines and sanitizers
      const Json tasks = studio_.get(with_study(kState, study)).at("tasks");
      const std::string state = tasks.empty() ? "" : tasks.at(0).at("state");
      if (state == "done" || state == "stopped" || state == "failed") return tasks.at(0);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << "it does not end";
    return {};
  }

  /// Waits until some runs are done, so that it can be stopped halfway.
  void wait_for_runs() const {
    while (studio_.get(kState).at("runs") < 3) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  ServedFolder studio_{testing::program()};
};

TEST_F(StudioCalibrations, OneFromTheFormToTheReport) {
  EXPECT_EQ(studio_.get(kState).at("state"), "none");
  const Json started = studio_.post(kTask, {});
  EXPECT_EQ(started.at("tasks").at(0).at("command"), "repose calibrate peas.toml --budget quick");
  ASSERT_EQ(ended().at("state"), "done") << ended();
  const Json state = studio_.get(kState);
  EXPECT_EQ(state.at("state"), "finished");
  EXPECT_EQ(state.at("result").at("parameters").at(0).at("name"),
            "contact.particle_wall.restitution");
  EXPECT_GE(state.at("progress").at("done"), 1);
  EXPECT_FALSE(state.at("progress").at("rounds").empty());
  const auto report = studio_.client->Get("/files/report?study=peas.toml");
  EXPECT_NE(report->body.find("Peas on wood"), std::string::npos);
  const std::string rules = report->get_header_value("Content-Security-Policy");
  EXPECT_THAT(rules, HasSubstr("sandbox"));
  EXPECT_THAT(rules, Not(HasSubstr("allow-same-origin")));
  EXPECT_EQ(report->get_header_value_count("Content-Security-Policy"), 1U);
  // Identical to the command line's.
  EXPECT_TRUE(report->body == studio_.text("peas_calibration/report.html"));
  const auto result = studio_.client->Get("/files/calibration?study=peas.toml&name=result.json");
  EXPECT_EQ(result->body, studio_.text("peas_calibration/result.json"));
  EXPECT_THAT(result->get_header_value("Content-Disposition"), HasSubstr("attachment"));
  const Json exported = studio_.post("/api/export?study=peas.toml&to=yade&approximate=1", {});
  EXPECT_EQ(exported.at("is_done"), true) << exported;
  EXPECT_EQ(exported.at("command"), "repose export peas_calibration --to yade --approximate");
  EXPECT_EQ(
      studio_.client->Get("/files/calibration?study=peas.toml&name=export/yade/README.txt")->status,
      200);
  EXPECT_EQ(studio_.post("/api/export?study=peas.toml&to=edam", {}).at("is_done"), false);
  // Different readings make it a different study.
  studio_.folder.write("peas/tilts.csv", std::string("angle_deg\n25\n26\n25.5\n"));
  EXPECT_EQ(studio_.get(kState).at("state"), "changed");
}

TEST_F(StudioCalibrations, WhatIsStoppedGoesOnInAnotherStudio) {
  studio_.post(kTask, {});
  wait_for_runs();
  studio_.remove(kTask);
  const Json stopped = ended();
  if (stopped.at("state") == "done") GTEST_SKIP() << "it was too fast";
  EXPECT_EQ(stopped.at("state"), "stopped");
  studio_.end();
  studio_.serve();
  const Json state = studio_.get(kState);
  EXPECT_EQ(state.at("state"), "unfinished");
  EXPECT_THAT(state.at("tasks"), IsEmpty());
  EXPECT_GE(state.at("runs"), 3);
  const std::string page = studio_.client->Get("/files/report?study=peas.toml")->body;
  EXPECT_NE(page.find("Unfinished: this study has no result yet."), std::string::npos);
  studio_.post(kTask, {});
  EXPECT_EQ(ended().at("state"), "done");
  const Json notes = studio_.get(kState).at("progress").at("notes");
  EXPECT_THAT(notes.dump(), HasSubstr("simulations were taken from"));
}

TEST_F(StudioCalibrations, TheStudiosEndEndsWhatItStartedAndTheNextGoesOn) {
  studio_.post("/api/studies", Json{{"study", "beans"}, {"experiments", {"drop", "tilt"}}});
  fill_in("beans");
  studio_.post(kTask, {});
  studio_.post(with_study(kTask, "beans"), {});
  wait_for_runs();
  studio_.end();
  EXPECT_FALSE(base::is_locked_by_another(
      calibrate::lock_file_in(studio_.folder.path() / "peas_calibration")));
  studio_.serve();
  // Queued ones, too.
  EXPECT_EQ(ended("beans").at("state"), "done");
  EXPECT_EQ(studio_.get(kState).at("state"), "finished");
  studio_.end();
  studio_.serve();
  EXPECT_THAT(studio_.get("/api/tasks").at("tasks"), IsEmpty());
}

/// `repose studio` as a separate process, which can be killed.
class StudioProcess {
 public:
  explicit StudioProcess(const std::filesystem::path& folder) {
    pid_ = ::fork();
    if (pid_ == 0) {
      const std::string program = testing::program().string(), name = folder.string();
      if (testing::enter(folder.string(), logs_.out, logs_.err)) {
        ::execl(program.c_str(), program.c_str(), "studio", name.c_str(), "--no-browser", nullptr);
      }
      ::_exit(127);
    }
  }
  ~StudioProcess() { kill(); }
  StudioProcess(const StudioProcess&) = delete;
  StudioProcess& operator=(const StudioProcess&) = delete;
  StudioProcess(StudioProcess&&) = delete;
  StudioProcess& operator=(StudioProcess&&) = delete;

  /// Requests a calibration.
  void calibrate() const {
    std::string address;
    for (int k = 0; k < 500 && !address.ends_with('\n'); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      address = testing::text_of(logs_.out);
    }
    const std::size_t token = address.find("token=");
    ASSERT_NE(token, std::string::npos) << testing::text_of(logs_.err);
    const int port = std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
    httplib::Client client("127.0.0.1", port);
    const std::string key = address.substr(token, address.find('\n') - token);
    const auto answer = client.Post(std::string(kTask) + '&' + key);
    ASSERT_TRUE(answer && answer->status == 200);
  }
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = 0;
  }

 private:
  testing::Logs logs_;
  pid_t pid_ = 0;
};

TEST_F(StudioCalibrations, AKilledStudioLeavesNothingAtWorkAndTheNextGoesOn) {
  const auto lock = calibrate::lock_file_in(studio_.folder.path() / "peas_calibration");
  const auto waits_until = [](const auto& is_so) {
    for (int k = 0; k < 3000 && !is_so(); ++k) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return is_so();
  };
  studio_.end();
  StudioProcess other(studio_.folder.path());
  other.calibrate();
  ASSERT_TRUE(waits_until([&] { return base::is_locked_by_another(lock); }));
  other.kill();
  EXPECT_TRUE(waits_until([&] { return !base::is_locked_by_another(lock); }));
  if (std::filesystem::exists(studio_.folder.path() / "peas_calibration/result.json"))
    GTEST_SKIP() << "it was too fast";
  studio_.serve();
  EXPECT_EQ(ended().at("state"), "done");
}

TEST_F(StudioCalibrations, AKilledOneIsToldAndGoesOn) {
  studio_.post(kTask, {});
  wait_for_runs();
  const auto lock = calibrate::lock_file_in(studio_.folder.path() / "peas_calibration");
  // The lock's owner is the program.
  std::string owner;
  try {
    const base::FolderLock taken(studio_.folder.path(), lock);
  } catch (const std::exception& error) {
    owner = error.what();
  }
  const std::size_t number = owner.find("process ");
  if (number == std::string::npos) GTEST_SKIP() << "it was too fast";
  ::kill(std::stoi(owner.substr(number + std::string("process ").size())), SIGKILL);
  const Json killed = ended();
  EXPECT_EQ(killed.at("state"), "failed");
  EXPECT_THAT(killed.at("end"), HasSubstr("signal 9"));
  EXPECT_EQ(studio_.get(kState).at("state"), "unfinished");
  studio_.post(kTask, {});
  EXPECT_EQ(ended().at("state"), "done");
}

TEST_F(StudioCalibrations, SeveralWaitForEachOtherAndCanBeTakenOut) {
  for (const char* name : {"beans", "rice"}) {
    studio_.post("/api/studies", Json{{"study", name}, {"experiments", {"drop", "tilt"}}});
    fill_in(name);
  }
  studio_.post(kTask, {});
  studio_.post(kTask, {}, 400);  // already running
  studio_.post(with_study(kTask, "beans"), {});
  const Json tasks = studio_.post(with_study(kTask, "rice"), {}).at("tasks");
  ASSERT_EQ(tasks.size(), 3U);
  EXPECT_EQ(tasks.at(1).at("state"), "waiting");
  studio_.remove(with_study(kTask, "beans"));
  studio_.remove(with_study(kTask, "beans"), 400);
  EXPECT_EQ(ended("rice").at("state"), "done");
  EXPECT_EQ(studio_.get(with_study(kState, "beans")).at("state"), "none");
}

TEST_F(StudioCalibrations, WhatTheProgramRefusesIsTold) {
  studio_.folder.write("peas/drops.csv", std::string("drop_mm,rebound_mm\n500,600\n"));
  studio_.post(kTask, {});
  const Json failed = ended();
  EXPECT_EQ(failed.at("state"), "failed");
  EXPECT_THAT(failed.at("lines").at(0), HasSubstr("drops.csv:2: rebound_mm = 600"));
  for (const char* wrong :
       {"task=sing", "task=calibrate&amount=huge", "task=plan&amount=--help", "task="}) {
    studio_.post(std::string("/api/tasks?study=peas.toml&") + wrong, {}, 400);
  }
}

TEST_F(StudioCalibrations, AnEstimateTellsTheTimeOfEachBudgetAndSavesNothing) {
  studio_.post("/api/tasks?study=peas.toml&task=estimate", {});
  const Json task = ended();
  EXPECT_EQ(task.at("state"), "done") << task;
  EXPECT_EQ(task.at("command"), "repose calibrate peas.toml --dry-run");
  const Json estimate = studio_.get(kState).at("estimate");
  EXPECT_EQ(estimate.at("budgets").at(0).at("budget"), "quick");
  EXPECT_GT(estimate.at("budgets").at(0).at("seconds"), 0);
  EXPECT_THAT(studio_.folder.names(), Not(Contains("peas_calibration")));
}

TEST_F(StudioCalibrations, OneOfSoManyMinutesIsThatOfTheCommandLine) {
  const Json started = studio_.post(std::string(kTask) + "&amount=2min", {});
  EXPECT_EQ(started.at("tasks").at(0).at("command"), "repose calibrate peas.toml --minutes 2");
  ASSERT_EQ(ended().at("state"), "done") << ended();
}

TEST_F(StudioCalibrations, APlanIsThatOfTheCommandLine) {
  studio_.post("/api/tasks?study=peas.toml&task=plan&amount=0.1", {});
  const Json task = ended();
  EXPECT_EQ(task.at("state"), "done") << task;
  EXPECT_EQ(task.at("command"), "repose plan peas.toml --minutes 0.1");
  const Json plan = studio_.get(kState).at("plan");
  EXPECT_EQ(plan.at("hash"), studio_.get("/api/study?study=peas.toml").at("hash"));
  EXPECT_EQ(plan.at("experiments").at(0).at("measured"), true);
  EXPECT_EQ(plan, Json::parse(studio_.text("peas_calibration/plan.json")));
  // Its simulations do not count as a started calibration.
  EXPECT_GT(studio_.get(kState).at("runs"), 0);
  EXPECT_EQ(studio_.get(kState).at("state"), "none");
}

TEST_F(StudioCalibrations, OneThatATerminalRunsIsSeen) {
  std::filesystem::create_directories(studio_.folder.path() / "peas_calibration/runs");
  const auto file = calibrate::lock_file_in(studio_.folder.path() / "peas_calibration");
  std::ofstream(file).close();
  const pid_t other = ::fork();
  if (other == 0) {
    const base::FolderLock lock(file, file);
    ::pause();
    ::_exit(0);
  }
  for (int k = 0; k < 100 && !base::is_locked_by_another(file); ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const Json state = studio_.get(kState);
  ::kill(other, SIGKILL);
  ::waitpid(other, nullptr, 0);
  EXPECT_EQ(state.at("state"), "running");
  EXPECT_EQ(state.at("is_elsewhere"), true);
}

TEST_F(StudioCalibrations, OnlyItsOwnFilesAreHandedOut) {
  const testing::TemporaryFolder other;
  other.write("secret.csv", std::string("secret"));
  std::filesystem::create_directories(studio_.folder.path() / "peas_calibration/tables");
  std::filesystem::create_symlink(other.path() / "secret.csv",
                                  studio_.folder.path() / "peas_calibration/tables/a.csv");
  studio_.folder.write("peas_calibration/mine.txt", std::string("mine"));
  for (const std::string& name :
       {std::string("../peas.toml"), std::string("tables/a.csv"), std::string("mine.txt"),
        std::string("/etc/passwd"), (other.path() / "secret.csv").string(), std::string("")}) {
    EXPECT_EQ(studio_.client
                  ->Get("/files/calibration?study=peas.toml&name=" +
                        httplib::detail::encode_query_param(name))
                  ->status,
              400)
        << name;
  }
  // A symbolic link in place of the calibration's folder is not followed.
  std::filesystem::remove_all(studio_.folder.path() / "peas_calibration");
  std::filesystem::create_directory_symlink(other.path(),
                                            studio_.folder.path() / "peas_calibration");
  studio_.post(kTask, {}, 400);
  EXPECT_EQ(studio_.client->Get("/files/report?study=peas.toml")->status, 400);
  EXPECT_THAT(studio_.get(kState).at("files"), IsEmpty());
  EXPECT_EQ(other.names().size(), 1U);
}

}  // namespace
}  // namespace repose::studio
