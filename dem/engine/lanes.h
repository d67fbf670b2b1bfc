#pragma once

#include <cmath>
#include <cstddef>

#include "dem/vector.h"

/// Four numbers in one: the inner loops process four bodies or four contacts at once.
///
/// Formulas are templates on Number, which is double or Double4. Each lane is rounded like a
/// double, whatever the machine's vector width, so results depend neither on the machine nor on
/// which four are grouped. These vectors are a GCC and Clang extension.
///
/// Rows are four numbers in memory; four rows can be accessed by lane or by coordinate.

namespace repose::dem {

inline constexpr std::size_t kLanes = 4;

/// Fours that go through a step's passes together: few enough to stay in the L1 cache.
inline constexpr std::size_t kBatchesPerBlock = 8;

/// Functions on lanes are only fast when inlined into a loop.
#define REPOSE_INLINE inline __attribute__((always_inline))

/// Compiled for machines with vectors of four (AVX2), with more registers (AVX-512), and for all
/// others; the best version is chosen at startup. Under sanitizers only the last: they slow
/// compilation, and ThreadSanitizer is not ready yet when the version is chosen.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define REPOSE_TARGET_CLONES __attribute__((target_clones("default", "avx2", "arch=x86-64-v4")))
#else
#define REPOSE_TARGET_CLONES
#endif

/// A boolean per lane.
struct alignas(32) LaneMask {
  long long __attribute__((vector_size(32))) bits;

  REPOSE_INLINE bool operator[](std::size_t lane) const { return bits[lane] != 0; }
  friend REPOSE_INLINE LaneMask operator&(const LaneMask& x, const LaneMask& y) {
    return {x.bits & y.bits};
  }
  friend REPOSE_INLINE LaneMask operator|(const LaneMask& x, const LaneMask& y) {
    return {x.bits | y.bits};
  }
};

// Explicitly aligned: the default alignment of a vector differs from machine to machine.
struct alignas(32) Double4 {
  using Vector4 = double __attribute__((vector_size(32)));
  Vector4 numbers = {};

  Double4() = default;
  // Handwritten, so that structures of lanes are also copied as whole vectors, not in halves.
  REPOSE_INLINE Double4(const Double4& from) : numbers(from.numbers) {}
  REPOSE_INLINE Double4& operator=(const Double4& from) {
    numbers = from.numbers;
    return *this;
  }
  ~Double4() = default;
  // NOLINTNEXTLINE(google-explicit-constructor): it only wraps this vector
  REPOSE_INLINE Double4(const Vector4& from) : numbers(from) {}
  REPOSE_INLINE explicit Double4(double of_all) : numbers(Vector4{} + of_all) {}

  REPOSE_INLINE double operator[](std::size_t lane) const { return numbers[lane]; }
  REPOSE_INLINE void set(std::size_t lane, double number) { numbers[lane] = number; }
  REPOSE_INLINE Double4 operator-() const { return -numbers; }
  REPOSE_INLINE Double4& operator+=(const Double4& y) { return *this = *this + y; }

  friend REPOSE_INLINE Double4 operator+(const Double4& x, const Double4& y) {
    return x.numbers + y.numbers;
  }
  friend REPOSE_INLINE Double4 operator-(const Double4& x, const Double4& y) {
    return x.numbers - y.numbers;
  }
  friend REPOSE_INLINE Double4 operator*(const Double4& x, const Double4& y) {
    return x.numbers * y.numbers;
  }
  friend REPOSE_INLINE Double4 operator/(const Double4& x, const Double4& y) {
    return x.numbers / y.numbers;
  }
  friend REPOSE_INLINE Double4 operator*(double x, const Double4& y) { return x * y.numbers; }
  friend REPOSE_INLINE Double4 operator*(const Double4& x, double y) { return x.numbers * y; }
  friend REPOSE_INLINE Double4 operator/(double x, const Double4& y) { return x / y.numbers; }
  friend REPOSE_INLINE Double4 operator/(const Double4& x, double y) { return x.numbers / y; }
  friend REPOSE_INLINE Double4 operator+(double x, const Double4& y) { return x + y.numbers; }
  friend REPOSE_INLINE Double4 operator-(const Double4& x, double y) { return x.numbers - y; }
  friend REPOSE_INLINE Double4 operator-(double x, const Double4& y) { return x - y.numbers; }
  friend REPOSE_INLINE LaneMask operator<(const Double4& x, const Double4& y) {
    return {x.numbers < y.numbers};
  }
  friend REPOSE_INLINE LaneMask operator>(const Double4& x, const Double4& y) {
    return {x.numbers > y.numbers};
  }
  friend REPOSE_INLINE LaneMask operator<=(const Double4& x, const Double4& y) {
    return {x.numbers <= y.numbers};
  }
  friend REPOSE_INLINE LaneMask operator>=(const Double4& x, const Double4& y) {
    return {x.numbers >= y.numbers};
  }
};

REPOSE_INLINE double sqrt(double value) { return std::sqrt(value); }
REPOSE_INLINE Double4 sqrt(const Double4& values) {
  Double4 roots;
  for (std::size_t lane = 0; lane < kLanes; ++lane) roots.set(lane, std::sqrt(values[lane]));
  return roots;
}

REPOSE_INLINE bool any(bool value) { return value; }
REPOSE_INLINE bool any(const LaneMask& mask) {
  return (mask.bits[0] | mask.bits[1] | mask.bits[2] | mask.bits[3]) != 0;
}

/// A bit per lane, the first lane's lowest.
REPOSE_INLINE unsigned bits_of(const LaneMask& mask) {
  using Bits = long long __attribute__((vector_size(32)));
  const Bits bits = mask.bits & Bits{1, 2, 4, 8};
  return static_cast<unsigned>((bits[0] | bits[1]) | (bits[2] | bits[3]));
}

REPOSE_INLINE double select(bool mask, double yes, double no) { return mask ? yes : no; }
REPOSE_INLINE Double4 select(const LaneMask& mask, const Double4& yes, const Double4& no) {
  return mask.bits ? yes.numbers : no.numbers;
}
template <typename Number>
REPOSE_INLINE Number min(const Number& x, const Number& y) {
  return select(x < y, x, y);
}
template <typename Number>
REPOSE_INLINE Number max(const Number& x, const Number& y) {
  return select(x > y, x, y);
}
template <typename Number>
REPOSE_INLINE Number abs(const Number& x) {
  return max(x, -x);
}

/// Four numbers anywhere in memory. (memcpy would move them in halves. With `using`, Clang would
/// drop the attribute and assume full alignment.)
// NOLINTNEXTLINE(modernize-use-using)
typedef double FourNumbers __attribute__((vector_size(32), aligned(8), may_alias));
static_assert(alignof(FourNumbers) == alignof(double));

REPOSE_INLINE Double4 load(const double* from) {
  return Double4(Double4::Vector4(*reinterpret_cast<const FourNumbers*>(from)));
}
REPOSE_INLINE void store(const Double4& lanes, double* to) {
  *reinterpret_cast<FourNumbers*>(to) = lanes.numbers;
}

/// A 3-D vector, one per lane.
template <typename Number>
struct Vec3 {
  Number x = {};
  Number y = {};
  Number z = {};

  REPOSE_INLINE Number dot(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  REPOSE_INLINE Number squared_norm() const { return dot(*this); }
  REPOSE_INLINE Vec3 cross(const Vec3& v) const {
    return {y * v.z - z * v.y, z * v.x - x * v.z, x * v.y - y * v.x};
  }
  /// Component-wise product.
  REPOSE_INLINE Vec3 times(const Vec3& v) const { return {x * v.x, y * v.y, z * v.z}; }
  REPOSE_INLINE Vec3 operator-() const { return {-x, -y, -z}; }
  REPOSE_INLINE Vec3& operator+=(const Vec3& v) { return *this = *this + v; }
  REPOSE_INLINE Vec3& operator-=(const Vec3& v) { return *this = *this - v; }

  friend REPOSE_INLINE Vec3 operator+(const Vec3& u, const Vec3& v) {
    return {u.x + v.x, u.y + v.y, u.z + v.z};
  }
  friend REPOSE_INLINE Vec3 operator-(const Vec3& u, const Vec3& v) {
    return {u.x - v.x, u.y - v.y, u.z - v.z};
  }
  friend REPOSE_INLINE Vec3 operator*(const Vec3& v, const Number& factor) {
    return {v.x * factor, v.y * factor, v.z * factor};
  }
};

inline Vec3<double> triple_of(const Vector& v) { return {v.x(), v.y(), v.z()}; }
inline Vector vector_of(const Vec3<double>& v) { return {v.x, v.y, v.z}; }

template <typename Mask, typename Number>
REPOSE_INLINE Vec3<Number> select(const Mask& mask, const Vec3<Number>& yes,
                                  const Vec3<Number>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

/// A vector plus a number, as large as a Double4.
struct alignas(32) Row {
  Vector xyz = Vector::Zero();
  double w = 0;
};

/// The first four numbers of a structure of doubles, such as a Row.
template <typename Structure>
REPOSE_INLINE Double4 load_row(const Structure& from) {
  static_assert(sizeof(Structure) >= sizeof(Double4));
  return load(reinterpret_cast<const double*>(&from));
}
template <typename Structure>
REPOSE_INLINE void store_row(const Double4& lanes, Structure& to) {
  static_assert(sizeof(Structure) >= sizeof(Double4));
  store(lanes, reinterpret_cast<double*>(&to));
}

/// Four rows: by lane, or by coordinate.
struct Rows {
  Double4 row[kLanes];
};
struct Columns {
  Vec3<Double4> xyz;
  Double4 w;
};

REPOSE_INLINE Rows turned(const Rows& r) {
  using Vector4 = Double4::Vector4;
  const Vector4 a = __builtin_shufflevector(r.row[0].numbers, r.row[1].numbers, 0, 4, 2, 6);
  const Vector4 b = __builtin_shufflevector(r.row[0].numbers, r.row[1].numbers, 1, 5, 3, 7);
  const Vector4 c = __builtin_shufflevector(r.row[2].numbers, r.row[3].numbers, 0, 4, 2, 6);
  const Vector4 d = __builtin_shufflevector(r.row[2].numbers, r.row[3].numbers, 1, 5, 3, 7);
  return {{__builtin_shufflevector(a, c, 0, 1, 4, 5), __builtin_shufflevector(b, d, 0, 1, 4, 5),
           __builtin_shufflevector(a, c, 2, 3, 6, 7), __builtin_shufflevector(b, d, 2, 3, 6, 7)}};
}
REPOSE_INLINE Columns columns_of(const Rows& rows) {
  const Rows columns = turned(rows);
  return {{columns.row[0], columns.row[1], columns.row[2]}, columns.row[3]};
}
REPOSE_INLINE Rows rows_of(const Vec3<Double4>& xyz, const Double4& w) {
  return turned({{xyz.x, xyz.y, xyz.z, w}});
}

/// Gathers one row per lane.
template <typename RowOfLane>
REPOSE_INLINE Columns gather(const RowOfLane& row) {
  return columns_of({{row(0), row(1), row(2), row(3)}});
}

/// Gathers one number per lane.
template <typename NumberOfLane>
REPOSE_INLINE Double4 each(const NumberOfLane& number) {
  return Double4::Vector4{number(0), number(1), number(2), number(3)};
}

/// Cross product of two rows; w: 0.
REPOSE_INLINE Double4 cross_of_rows(const Double4& u, const Double4& v) {
  const auto next = [](const Double4& row) __attribute__((always_inline)) {
    return Double4(__builtin_shufflevector(row.numbers, row.numbers, 1, 2, 0, 3));
  };
  return next(u * next(v) - next(u) * v);
}

/// Replaces a row's w.
REPOSE_INLINE Double4 with_w(const Double4& row, double number) {
  return select(Double4(Double4::Vector4{0, 0, 0, 1}) > Double4(0), Double4(number), row);
}

}  // namespace repose::dem
