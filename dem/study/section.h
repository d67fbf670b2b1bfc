#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "dem/experiment/protocol_key.h"
#include "dem/study/config.h"

namespace repose::dem {

/// One table of a study, read key by key. Errors are collected in StudyErrors, not thrown; an
/// invalid value reads as missing.
class Section {
 public:
  /// @param table  null if the study does not have it.
  Section(const ConfigValue* table, std::string path, const Place& otherwise, StudyErrors& errors);

  bool exists() const { return table_ != nullptr; }
  const Place& place() const { return place_; }
  const std::string& path() const { return path_; }
  StudyErrors& errors() const { return *errors_; }

  /// @param example  a correct line: "height_mm = 500"
  std::optional<double> number(const std::string& key, const Range& range,
                               const std::string& example);
  std::optional<std::int64_t> integer(const std::string& key, std::int64_t from, std::int64_t to,
                                      const std::string& example);
  std::optional<std::string> text(const std::string& key, const std::string& example);
  std::optional<bool> truth(const std::string& key, const std::string& example);
  std::optional<std::vector<double>> numbers(const std::string& key, const Range& range,
                                             const std::string& example);
  std::optional<std::vector<std::string>> texts(const std::string& key, const std::string& example);
  /// Adds an error if it is missing.
  double needed_number(const std::string& key, const Range& range, const std::string& example);

  /// A section within this one.
  Section section(const std::string& key);
  /// Any value; null if missing.
  const ConfigValue* value(const std::string& key);
  bool has(const std::string& key) const;

  void missing(const std::string& key, const std::string& rule, const std::string& example) const;
  void wrong(const ConfigValue& value, const std::string& rule, const std::string& fix) const;
  std::string full(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }

  /// To be called after all known keys have been read: any others are errors.
  void reject_unknown_keys() const;

 private:
  bool is_number(const ConfigValue& value, const Range& range, const std::string& example) const;

  const ConfigValue* table_;
  std::string path_;
  Place place_;
  StudyErrors* errors_;
  std::vector<std::string> known_;
};

}  // namespace repose::dem
