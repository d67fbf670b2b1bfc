#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem/state/vtk_file.h"
#include "dem/vector.h"

namespace repose::dem {

/// Gathers arrays for a file, by name.
class ArrayWriter {
 public:
  explicit ArrayWriter(std::string prefix = {}) : prefix_(std::move(prefix)) {}

  void numbers(const std::string& name, int components, std::vector<double> values);
  void integers(const std::string& name, int components, std::vector<std::int64_t> values);
  void texts(const std::string& name, std::vector<std::string> values);
  /// Arrays that have their names already.
  void add(std::vector<VtkArray> arrays);

  std::vector<VtkArray> take() { return std::move(arrays_); }

 private:
  std::string prefix_;
  std::vector<VtkArray> arrays_;
};

/// Appends to a flat list of numbers.
void append(std::vector<double>& values, const Vector& vector);
void append(std::vector<double>& values, const Quaternion& quaternion);  ///< w x y z

/// The values of one array, taken one after the other and never more than there are.
template <typename Number>
class ArrayStream {
 public:
  ArrayStream(std::string name, const std::vector<Number>& values)
      : name_(std::move(name)), values_(values) {}

  std::size_t left() const { return values_.size() - at_; }
  bool is_at_end() const { return left() == 0; }
  const std::string& name() const { return name_; }
  /// @throws base::InputError  there is none left.
  Number take();

 private:
  std::string name_;
  const std::vector<Number>& values_;
  std::size_t at_ = 0;
};

using NumberStream = ArrayStream<double>;
using IntegerStream = ArrayStream<std::int64_t>;

/// None of its numbers beyond 1e12. @throws base::InputError
Vector take_vector(NumberStream& numbers);
/// @throws base::InputError  it is not of unit length.
Quaternion take_quaternion(NumberStream& numbers);
/// A whole number from 0 to below `end`.
int take_index(IntegerStream& integers, std::size_t end);
/// All values must have been used. @throws base::InputError
void check_end(bool is_at_end, const std::string& name);

/// Finds arrays by name; every error names the array. Throws base::InputError.
class ArrayReader {
 public:
  explicit ArrayReader(const std::vector<VtkArray>& arrays, std::string prefix = {})
      : arrays_(arrays), prefix_(std::move(prefix)) {}

  bool has(const std::string& name) const;
  /// All finite.
  NumberStream numbers(const std::string& name, int components) const;
  IntegerStream integers(const std::string& name, int components) const;
  const std::vector<std::string>& texts(const std::string& name) const;

 private:
  template <typename Value>
  const std::vector<Value>& find(const std::string& name, int components) const;

  const std::vector<VtkArray>& arrays_;
  std::string prefix_;
};

}  // namespace repose::dem
