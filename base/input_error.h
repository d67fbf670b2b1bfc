#pragma once

#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace repose::base {

/// How the user sets a field of an input: its command-line option, for example.
struct FieldName {
  std::string_view field;   ///< as libraries call it: "camera pitch"
  std::string_view option;  ///< "--pitch-deg"
};
using FieldNames = std::span<const FieldName>;

/// A reference to a field in an error's text: "choose the " + field("linear model"). Users read
/// "linear model", or "linear model (--model linear)" if `names` has its option.
std::string field(std::string_view name);

/// The text with each field() in it as users read it.
std::string with_names(std::string_view text, FieldNames names = {});

/// What is wrong with an input. Parts that do not apply stay empty.
struct Fault {
  std::string where = {};    ///< the file, row, field or thing: "sheet.csv:12"
  std::string subject = {};  ///< the field: "heap.plate_m", "camera pitch"
  std::string value = {};    ///< what it is: "is -1", or of `where`: "cannot be read"
  std::string rule = {};     ///< what would be right: "above 0"; or "must be above 0"
  std::string fix = {};      ///< what to do, with its full stop: "the size on the bench."

  /// "where: subject value. Rule: rule. Fix: fix", or "where: subject value must be ... Fix: fix"
  std::string text(FieldNames names = {}) const;
};

/// One line each.
std::string text_of(const std::vector<Fault>& faults, FieldNames names = {});

/// An input cannot be used; what() has one line per error. Any other exception is a bug in the
/// program or a failure of the machine.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Fault fault) : InputError(std::vector<Fault>{std::move(fault)}) {}
  /// A template so that a braced Fault is never converted to a list.
  template <std::same_as<std::vector<Fault>> List>
  explicit InputError(List faults)
      : std::runtime_error(text_of(faults)), faults_(std::move(faults)) {}

  const std::vector<Fault>& faults() const { return faults_; }
  /// The same errors, with their location inside `where`.
  InputError in(const std::string& where) const;

 private:
  std::vector<Fault> faults_;
};

/// "FILE: what. Fix: ...": errors of measuring a file do not name it, those of reading it do.
std::string naming_file(const std::string& file, const std::string& error);

/// Collects the errors of an input, to report all of them at once.
class Faults {
 public:
  /// After the first `most`, errors are only counted: a table may have a million rows with the same
  /// one.
  explicit Faults(std::size_t most = std::numeric_limits<std::size_t>::max()) : most_(most) {}

  /// Adds the error unless the rule holds.
  void require(bool holds, Fault fault) {
    if (!holds) add(std::move(fault));
  }
  void add(Fault fault) {
    if (++count_ <= most_) listed_.push_back(std::move(fault));
  }
  void add_all(const std::vector<Fault>& faults) {
    for (const Fault& fault : faults) add(fault);
  }

  bool empty() const { return count_ == 0; }

  /// Those that are listed, and the number of those that are not.
  std::vector<Fault> all() const;

  /// @throws InputError  with all of them, if there are any.
  void throw_if_any() const {
    if (!empty()) throw InputError(all());
  }

 private:
  std::vector<Fault> listed_;
  std::size_t count_ = 0;
  std::size_t most_;
};

}  // namespace repose::base
