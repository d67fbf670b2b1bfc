#include "dem/verify/verify.h"

#include <algorithm>
#include <utility>

#include "base/input_error.h"
#include "dem/verify/scene.h"

namespace repose::dem {
namespace {

std::vector<VerifyCase> all_cases() {
  std::vector<VerifyCase> all;
  for (const auto& topic :
       {impact_cases(), clump_cases(), oblique_cases(), kharaz_cases(), motion_cases(),
        rolling_cases(), rotation_cases(), bed_cases(), conservation_cases()}) {
    all.insert(all.end(), topic.begin(), topic.end());
  }
  return all;
}

std::vector<CaseResult> run(const VerifyCase& which, const CasePeer* peer = nullptr) {
  std::vector<CaseResult> results;
  for (const double fraction : {1.0, .5}) {
    Trial trial(which, fraction, peer);
    which.run(trial);
    results.insert(results.end(), trial.results().begin(), trial.results().end());
  }
  return results;
}

/// Forwards scenes to the peer, and records the values that it replaces.
class NotedPeer : public CasePeer {
 public:
  NotedPeer(const CasePeer& peer, std::vector<std::string>& changes)
      : peer_(peer), changes_(changes) {}

  std::string title() const override { return peer_.title(); }
  std::string changes_to(const SimulationSetup& setup) const override {
    return peer_.changes_to(setup);
  }
  std::vector<Collision> collide_each(const SimulationSetup& setup,
                                      const std::vector<Meeting>& meetings) const override {
    note(setup);
    return peer_.collide_each(setup, meetings);
  }
  Path follow(const SimulationSetup& setup, const std::vector<Grain>& grains, double duration_s,
              int every_steps) const override {
    note(setup);
    return peer_.follow(setup, grains, duration_s, every_steps);
  }

 private:
  void note(const SimulationSetup& setup) const {
    std::string change = changes_to(setup);
    if (!change.empty() && std::ranges::find(changes_, change) == changes_.end()) {
      changes_.push_back(std::move(change));
    }
  }

  const CasePeer& peer_;
  std::vector<std::string>& changes_;
};

}  // namespace

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const VerifyCase& each : all_cases()) names.push_back(each.name);
  return names;
}

std::vector<CaseResult> run_case(const std::string& name, const CasePeer* peer) {
  const std::vector<VerifyCase> cases = all_cases();
  const auto found = std::find_if(cases.begin(), cases.end(),
                                  [&name](const VerifyCase& each) { return each.name == name; });
  if (found == cases.end()) {
    throw base::InputError({.where = "case " + name,
                            .value = "there is none with this name",
                            .fix = "one of those that case_names() lists."});
  }
  return run(*found, peer);
}

std::vector<PeerCase> run_cases_in(const CasePeer& peer, const ProgressCallback& progress) {
  const std::vector<VerifyCase> cases = all_cases();
  std::vector<PeerCase> made;
  for (const VerifyCase& each : cases) {
    PeerCase one{.name = each.name};
    try {
      const NotedPeer noted(peer, one.changes);
      one.results = run(each, &noted);
    } catch (const CannotRun& reason) {
      one.changes.clear();
      one.cannot = reason.what();
    }
    made.push_back(std::move(one));
    if (progress) progress(made.size(), cases.size());
  }
  return made;
}

std::vector<CaseResult> run_cases(const ProgressCallback& progress) {
  const std::vector<VerifyCase> cases = all_cases();
  std::vector<CaseResult> results;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const std::vector<CaseResult> some = run(cases[k]);
    results.insert(results.end(), some.begin(), some.end());
    if (progress) progress(k + 1, cases.size());
  }
  return results;
}

}  // namespace repose::dem
