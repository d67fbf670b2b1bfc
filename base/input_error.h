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

/// How a program's user gives a field of an input: the command line's option of it, say.
struct FieldName {
  std::string_view field;   ///< as libraries call it: "camera pitch"
  std::string_view option;  ///< "--pitch-deg"
};
using FieldNames = std::span<const FieldName>;

/// A field that a text advises to give: "choose the " + field("linear model"). In what people read
/// it becomes "linear model", or "linear model (--model linear)" where names tell its option.
std::string field(std::string_view name);

/// The text with each field() in it as people read it.
std::string with_names(std::string_view text, FieldNames names = {});

/// What is wrong with an input. A part that says nothing stays empty.
struct Fault {
  std::string where = {};    ///< the file, row, field or thing: "sheet.csv:12"
  std::string subject = {};  ///< the field: "heap.plate_m", "camera pitch"
  std::string value = {};    ///< what it is: "is -1", or of `where`: "cannot be read"
  std::string rule = {};     ///< what would be right: "above 0"; or "must be above 0"
  std::string fix = {};      ///< what to do, with its full stop: "the size on the bench."

  /// "where: subject value. Rule: rule. Fix: fix", or "where: subject value must be ... Fix: fix"
  std::string text(FieldNames names = {}) const;
};

/// A line for each.
std::string text_of(const std::vector<Fault>& faults, FieldNames names = {});

/// An input cannot be used; what() has a line for each fault. All else that is thrown is a fault
/// of the program or of the machine.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Fault fault) : InputError(std::vector<Fault>{std::move(fault)}) {}
  /// A list by its name only: the braces of a Fault are none.
  template <std::same_as<std::vector<Fault>> List>
  explicit InputError(List faults)
      : std::runtime_error(text_of(faults)), faults_(std::move(faults)) {}

  const std::vector<Fault>& faults() const { return faults_; }
  /// The same faults, of something that is in `where`.
  InputError in(const std::string& where) const;

 private:
  std::vector<Fault> faults_;
};

/// "FILE: what. Fix: ...": errors of measuring a file do not name it, those of reading it do.
std::string naming_file(const std::string& file, const std::string& error);

/// Collects what is wrong with an input, to say all of it at once.
class Faults {
 public:
  /// Of more than `most`, those after the first `most` are only counted: a table may have a million
  /// rows with the same fault.
  explicit Faults(std::size_t most = std::numeric_limits<std::size_t>::max()) : most_(most) {}

  /// Notes the fault unless the rule holds.
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

  /// Those that are listed, and how many are not.
  std::vector<Fault> all() const;

  /// @throws InputError  with all of them, where there are some.
  void throw_if_any() const {
    if (!empty()) throw InputError(all());
  }

 private:
  std::vector<Fault> listed_;
  std::size_t count_ = 0;
  std::size_t most_;
};

}  // namespace repose::base
