#include "dem/study/engine_choice.h"

#include "dem/study/section.h"

namespace repose::dem {

EngineChoice read_engine(Section engine) {
  constexpr int kMostProcesses = 1024;
  constexpr double kLongest_s = 1e7;
  EngineChoice choice;
  choice.program = engine.text("program", "program = \"liggghts\"").value_or(choice.program);
  const auto processes = engine.integer("processes", 1, kMostProcesses, "processes = 2");
  choice.processes = static_cast<int>(processes.value_or(choice.processes));
  const auto launcher = engine.text("launcher", "launcher = \"mpirun\"");
  if (launcher && *launcher != "mpirun" && *launcher != "srun") {
    engine.wrong(*engine.value("launcher"), "mpirun or srun", "launcher = \"mpirun\"");
  }
  choice.launcher = launcher.value_or(choice.launcher);
  choice.takes_approximate = engine.truth("approximate", "approximate = true").value_or(false);
  choice.timeout_s = engine.number("timeout_s", above(0, kLongest_s), "timeout_s = 3600");
  engine.reject_unknown_keys();
  return choice;
}

}  // namespace repose::dem
