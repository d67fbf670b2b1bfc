#include "calibrate/experiment/run_spec.h"
#include "calibrate/experiment/simulator.h"

namespace repose::calibrate {
namespace {

class OwnSimulator : public Simulator {
 public:
  dem::Repeat run(const RunCall& call) const override {
    const dem::ExperimentEntry& entry = call.spec.entry();
    const auto report = [&](double fraction, const dem::Simulation&) {
      return call.goes_on(fraction);
    };
    return call.from != nullptr
               ? entry.resume(call.spec.model, call.spec.protocol, call.seed, *call.from, report,
                              call.record)
               : entry.run(call.spec.model, call.spec.protocol, call.seed, report, call.record);
  }
};

}  // namespace

std::shared_ptr<const Simulator> own_simulator() {
  static const auto kOwn = std::make_shared<const OwnSimulator>();
  return kOwn;
}

}  // namespace repose::calibrate
