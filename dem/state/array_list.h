#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem/state/vtk_file.h"
#include "dem/vector.h"

namespace repose::dem {

/// Collects named arrays for a file.
class ArrayWriter {
 public:
  explicit ArrayWriter(std::string prefix = {}) : prefix_(std::move(prefix)) {}

  void numbers(const std::string& name, int components, std::vector<double> values);
  void integers(const std::string& name, int components, std::vector<std::int64_t> values);
  void texts(const std::string& name, std::vector<std::string> values);
  /// Adds arrays that already have their full names.
  void add(std::vector<VtkArray> arrays);

  std::vector<VtkArray> take() { return std::move(arrays_); }

 private:
  std::string prefix_;
  std::vector<VtkArray> arrays_;
};

/// Appends to a flat list of numbers.
void append(std::vector<double>& values, const Vector& vector);
void append(std::vector<double>& values, const Quaternion& quaternion);  ///< w x y z

/// Sequential, bounds-checked access to the values of one array.
template <typename Number>
class ArrayStream {
 public:
  ArrayStream(std::string name, const std::vector<Number>& values)
      : name_(std::move(name)), values_(values) {}

  std::size_t left() const { return values_.size() - at_; }
  bool is_at_end() const { return left() == 0; }
  const std::string& name() const { return name_; }
  /// @throws base::InputError  no value is left.
  Number take();

 private:
  std::string name_;
  const std::vector<Number>& values_;
  std::size_t at_ = 0;
};

using NumberStream = ArrayStream<double>;
using IntegerStream = ArrayStream<std::int64_t>;

/// @throws base::InputError  a number is beyond 1e12 in magnitude, or not enough are left.
Vector take_vector(NumberStream& numbers);
/// @throws base::InputError  it is not of unit length.
Quaternion take_quaternion(NumberStream& numbers);
/// An integer from 0 to below `end`.
int take_index(IntegerStream& integers, std::size_t end);
/// All values must have been used. @throws base::InputError
void check_end(bool is_at_end, const std::string& name);

/// Finds arrays by name. Throws base::InputError naming the array.
class ArrayReader {
 public:
  explicit ArrayReader(const std::vector<VtkArray>& arrays, std::string prefix = {})
      : arrays_(arrays), prefix_(std::move(prefix)) {}

  bool has(const std::string& name) const;
  /// All values are finite.
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
