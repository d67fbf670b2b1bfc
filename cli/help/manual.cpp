#include "cli/help/manual.h"

#include <cctype>
#include <sstream>

#include <fmt/format.h>

#include "base/version.h"
#include "cli/help/about.h"
#include "cli/help/value_kind.h"

namespace repose::cli {
namespace {

/// Text that is printed as it is: hyphens that can be copied, no line that is a request.
std::string literal(const std::string& text) {
  std::string escaped;
  bool begins_line = true;
  for (const char letter : text) {
    if (begins_line && (letter == '.' || letter == '\'')) escaped += "\\&";
    begins_line = letter == '\n';
    if (letter == '-') {
      escaped += "\\-";
    } else if (letter == '\\') {
      escaped += "\\e";
    } else {
      escaped += letter;
    }
  }
  return escaped;
}

std::string heading(const std::string& page) {
  std::string name;
  for (const char letter : page) {
    name += static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  }
  return fmt::format(".TH {} 1 \"\" \"{}\" \"repose\"\n", literal(name), base::kProgram);
}

/// A section in which every line stays a line.
std::string as_typed(const std::string& name, const std::string& text) {
  const std::size_t first = text.find_first_not_of('\n');
  if (first == std::string::npos) return {};
  return fmt::format(".SH {}\n.nf\n{}\n.fi\n", name, literal(text.substr(first)));
}

std::string synopsis(const Command& command) {
  std::string text = fmt::format(".SH SYNOPSIS\n.B repose {}\n[\\fIOPTION\\fR]...\n", command.name);
  for (const CommandOption& option : command.options) {
    if (is_known_by_place(option)) text += fmt::format("\\fI{}\\fR\n", literal(option.value_name));
  }
  return text;
}

std::string options(const Command& command) {
  std::string text = ".SH OPTIONS\n";
  for (const CommandOption& option : command.options) {
    const bool is_word = is_known_by_place(option);
    text += fmt::format(
        ".TP\n{}{}\n{}.\n", is_word ? "" : fmt::format("\\fB{}\\fR ", literal(option.name)),
        is_switch(option) ? "" : fmt::format("\\fI{}\\fR", literal(option.value_name)),
        literal(option.help));
  }
  return text;
}

ManualPage page_of(const Command& command) {
  const std::string name = "repose-" + command.name;
  return {name + ".1",
          heading(name) +
              fmt::format(".SH NAME\n{} \\- {}\n", literal(name), literal(command.summary)) +
              synopsis(command) + options(command) + as_typed("NOTES", command.notes) +
              ".SH SEE ALSO\n.BR repose (1)\n"};
}

ManualPage program_page(const std::vector<Command>& commands) {
  std::string text = heading("repose") +
                     ".SH NAME\nrepose \\- measure heaps and calibrate contact parameters\n" +
                     ".SH SYNOPSIS\n.B repose\n\\fICOMMAND\\fR [\\fIOPTION\\fR]...\n" +
                     fmt::format(".SH DESCRIPTION\n{}\n.SH COMMANDS\n", literal(kAbout));
  for (const Command& command : commands) {
    text += fmt::format(".TP\n.BR repose\\-{} (1)\n{}.\n", command.name, literal(command.summary));
  }
  return {"repose.1", text + as_typed("EXAMPLES AND EXIT CODES", kExamples)};
}

}  // namespace

std::vector<ManualPage> manual_pages(const std::vector<Command>& commands) {
  std::vector<ManualPage> pages = {program_page(commands)};
  for (const Command& command : commands) pages.push_back(page_of(command));
  return pages;
}

}  // namespace repose::cli
