#include "cli/program.h"

int main(int count, char** words) { return repose::cli::run_program(count, words); }
