#pragma once

#include <optional>
#include <string>
#include <vector>

namespace repose::cli {

/// What `repose measure` is asked to do, as typed.
struct MeasureArguments {
  std::vector<std::string> pictures;  ///< files and folders
  std::string method;
  std::string window;
  std::vector<std::string> exclude;
  std::string pitch_deg;
  std::string threads;
  std::string overlay_folder;
  std::string json_file;
  std::string csv_file;
  std::string summary_file;
  bool shows_definitions = false;
};

/// What the command line comes down to: one of these.
struct Arguments {
  std::optional<MeasureArguments> measure;
  std::string text;   ///< asked for: help or version
  std::string fault;  ///< why it is no command line, and how to mend it
};

Arguments parse_arguments(int count, const char* const* words);

}  // namespace repose::cli
