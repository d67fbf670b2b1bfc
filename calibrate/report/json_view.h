#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace repose::calibrate::report {

/// A part of a JSON text, read without expecting anything: what is not there, or is of another
/// kind, is empty. Results of older versions lack keys, and a report shows what there is.
class JsonView {
 public:
  JsonView();
  /// Empty when the text is no JSON.
  static JsonView of_text(const std::string& text);
  /// Empty when there is no such file.
  /// @throws std::invalid_argument  the file is there, and is no JSON object.
  static JsonView of_file(const std::filesystem::path& file);

  bool exists() const;
  JsonView operator[](std::string_view key) const;
  std::vector<JsonView> items() const;  ///< of an array
  std::vector<std::pair<std::string, JsonView>> members() const;

  std::optional<double> number() const;
  std::string text() const;
  bool is_true() const;
  /// Of an array; NaN stands for what is no number.
  std::vector<double> numbers() const;
  /// A number or text as a person writes it.
  std::string shown() const;

 private:
  struct Part;
  explicit JsonView(std::shared_ptr<const Part> part);
  std::shared_ptr<const Part> part_;
};

}  // namespace repose::calibrate::report
