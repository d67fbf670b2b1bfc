#include "base/input_error.h"

#include <algorithm>
#include <utility>

namespace repose::base {
namespace {

/// Delimit a field in a text: control characters that printable() (base/text.h) never lets through.
constexpr char kFieldBegins = '\x0E', kFieldEnds = '\x0F';

std::string named(std::string_view name, FieldNames names) {
  const auto found = std::ranges::find(names, name, &FieldName::field);
  std::string text(name);
  if (found != names.end()) text.append(" (").append(found->option).append(")");
  return text;
}

/// Continues the sentence.
void add_words(std::string& text, const std::string& words) {
  if (!text.empty() && !words.empty()) text += ' ';
  text += words;
}

/// Starts a new sentence.
void add_sentence(std::string& text, std::string_view heading, const std::string& words) {
  if (words.empty()) return;
  constexpr std::string_view kEnds = ".?:";
  if (!text.empty()) text += kEnds.find(text.back()) == std::string_view::npos ? ". " : " ";
  text.append(heading).append(words);
}

}  // namespace

std::string field(std::string_view name) { return kFieldBegins + std::string(name) + kFieldEnds; }

std::string with_names(std::string_view text, FieldNames names) {
  std::string read;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t from = text.find(kFieldBegins, at);
    read += text.substr(at, from - at);
    if (from == std::string_view::npos) break;
    const std::size_t to = std::min(text.find(kFieldEnds, from + 1), text.size());
    read += named(text.substr(from + 1, to - from - 1), names);
    at = to + 1;
  }
  return read;
}

std::string Fault::text(FieldNames names) const {
  std::string text = where.empty() ? "" : named(where, names) + ':';
  add_words(text, named(subject, names));
  add_words(text, value);
  const bool goes_on = rule.starts_with("must ");
  if (goes_on) add_words(text, rule);
  if (!goes_on) add_sentence(text, "Rule: ", rule);
  if (!rule.empty() && fix.empty()) text += '.';
  add_sentence(text, "Fix: ", fix);
  return with_names(text, names);
}

std::string text_of(const std::vector<Fault>& faults, FieldNames names) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += fault.text(names);
  }
  return text;
}

InputError InputError::in(const std::string& where) const {
  std::vector<Fault> faults = faults_;
  for (Fault& fault : faults) {
    fault.where = fault.where.empty() ? where : where + ": " + fault.where;
  }
  return InputError(std::move(faults));
}

std::vector<Fault> Faults::all() const {
  std::vector<Fault> faults = listed_;
  if (count_ > listed_.size()) {
    faults.push_back({.value = "and " + std::to_string(count_ - listed_.size()) +
                               " more of this kind, which are not listed",
                      .fix = "correct these first."});
  }
  return faults;
}

std::string naming_file(const std::string& file, const std::string& error) {
  return error.starts_with(file + ": ") ? error : file + ": " + error;
}

}  // namespace repose::base
