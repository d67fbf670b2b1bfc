#include <iostream>

#include <repose/calibrate.h>
#include <repose/report.h>

int main(int, char* arguments[]) {
  const auto result = repose::run_study({.study = arguments[1], .folder = arguments[2]});
  const auto& joint = std::get<repose::JointResult>(result.value().found);
  for (const repose::ResultParameter& found : joint.parameters) {
    std::cout << found.name << ' ' << found.value << ": " << name_of(found.verdict) << '\n';
  }
  std::cout << repose::write_report(arguments[2]) << '\n';
}
