#include "base/child_process.h"
#include "cli/program.h"

int main(int count, char** words) {
  repose::base::end_with_parent();
  return repose::cli::run_program(count, words);
}
