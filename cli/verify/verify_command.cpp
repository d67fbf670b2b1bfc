#include "cli/verify/verify_command.h"

#include <memory>

#include "cli/verify/verify.h"

namespace repose::cli {

Command verify_command() {
  const auto given = std::make_shared<VerifyArguments>();
  return {.name = "verify",
          .summary = "Check the physics against known solutions",
          .options = {{"--json", "FILE|-", "Full results, for programs", &given->json_file}},
          .run = [given] { return run_verify(*given); }};
}

}  // namespace repose::cli
