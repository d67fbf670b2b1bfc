#include <gmock/gmock.h>

#include "tests/cli/program_server.h"

int main(int count, char** words) {
  repose::testing::start_program_server();
  ::testing::InitGoogleMock(&count, words);
  return RUN_ALL_TESTS();
}
