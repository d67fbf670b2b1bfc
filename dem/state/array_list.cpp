#include "dem/state/array_list.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

[[noreturn]] void refuse_array(const std::string& array, const std::string& what) {
  throw base::InputError({.value = fmt::format("array {} {}", array, what)});
}

}  // namespace

void ArrayWriter::numbers(const std::string& name, int components, std::vector<double> values) {
  arrays_.push_back({prefix_ + name, components, std::move(values)});
}

void ArrayWriter::integers(const std::string& name, int components,
                           std::vector<std::int64_t> values) {
  arrays_.push_back({prefix_ + name, components, std::move(values)});
}

void ArrayWriter::texts(const std::string& name, std::vector<std::string> values) {
  arrays_.push_back({prefix_ + name, 1, std::move(values)});
}

void ArrayWriter::add(std::vector<VtkArray> arrays) {
  std::move(arrays.begin(), arrays.end(), std::back_inserter(arrays_));
}

void append(std::vector<double>& values, const Vector& vector) {
  values.insert(values.end(), {vector.x(), vector.y(), vector.z()});
}

void append(std::vector<double>& values, const Quaternion& quaternion) {
  values.insert(values.end(), {quaternion.w(), quaternion.x(), quaternion.y(), quaternion.z()});
}

template <typename Number>
Number ArrayStream<Number>::take() {
  if (is_at_end())
    refuse_array(name_, fmt::format("ends after {} values, too soon", values_.size()));
  return values_[at_++];
}
template class ArrayStream<double>;
template class ArrayStream<std::int64_t>;

Vector take_vector(NumberStream& numbers) {
  constexpr double kMax = 1e12;  // in any SI unit; sums and squares stay finite
  const double x = numbers.take();
  const double y = numbers.take();
  const Vector vector(x, y, numbers.take());
  if (!(vector.cwiseAbs().maxCoeff() <= kMax)) {
    refuse_array(numbers.name(), fmt::format("holds a number beyond {:g}", kMax));
  }
  return vector;
}

Quaternion take_quaternion(NumberStream& numbers) {
  constexpr double kTolerance = 1e-6;
  const double w = numbers.take();
  const Vector v = take_vector(numbers);
  const Quaternion quaternion(w, v.x(), v.y(), v.z());
  if (!(std::abs(quaternion.norm() - 1) < kTolerance)) {
    refuse_array(numbers.name(), "holds an orientation that is not of unit length");
  }
  return quaternion;
}

int take_index(IntegerStream& integers, std::size_t end) {
  const std::int64_t index = integers.take();
  if (index < 0 || std::cmp_greater_equal(index, end)) {
    refuse_array(integers.name(),
                 fmt::format("holds {}, must be 0 or more and below {}", index, end));
  }
  return static_cast<int>(index);
}

void check_end(bool is_at_end, const std::string& name) {
  if (!is_at_end) refuse_array(name, "has more values than belong to it");
}

bool ArrayReader::has(const std::string& name) const {
  return std::any_of(arrays_.begin(), arrays_.end(),
                     [&](const VtkArray& one) { return one.name == prefix_ + name; });
}

template <typename Value>
const std::vector<Value>& ArrayReader::find(const std::string& name, int components) const {
  const std::string full = prefix_ + name;
  const auto array = std::find_if(arrays_.begin(), arrays_.end(),
                                  [&full](const VtkArray& one) { return one.name == full; });
  if (array == arrays_.end()) refuse_array(full, "is missing");
  const auto* values = std::get_if<std::vector<Value>>(&array->values);
  if (values == nullptr) refuse_array(full, "is of the wrong type");
  if (array->components != components) {
    refuse_array(full,
                 fmt::format("has {} components, must have {}", array->components, components));
  }
  return *values;
}

NumberStream ArrayReader::numbers(const std::string& name, int components) const {
  const auto& values = find<double>(name, components);
  if (std::any_of(values.begin(), values.end(),
                  [](double value) { return !std::isfinite(value); })) {
    refuse_array(prefix_ + name, "holds a value that is not a finite number");
  }
  return {prefix_ + name, values};
}

IntegerStream ArrayReader::integers(const std::string& name, int components) const {
  return {prefix_ + name, find<std::int64_t>(name, components)};
}

const std::vector<std::string>& ArrayReader::texts(const std::string& name) const {
  return find<std::string>(name, 1);
}

}  // namespace repose::dem
