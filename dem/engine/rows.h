#pragma once

#include "dem/engine/lanes.h"

/// Rows of four numbers in memory, and four rows by lane or by coordinate.
namespace repose::dem {

/// A vector and a number beside it, as long as Lanes.
struct alignas(32) Row {
  Vector xyz = Vector::Zero();
  double w = 0;
};

/// The first four numbers of a structure of doubles: a Row, say.
template <typename Structure>
REPOSE_INLINE Lanes load_row(const Structure& from) {
  static_assert(sizeof(Structure) >= sizeof(Lanes));
  return load(reinterpret_cast<const double*>(&from));
}
template <typename Structure>
REPOSE_INLINE void store_row(const Lanes& lanes, Structure& to) {
  static_assert(sizeof(Structure) >= sizeof(Lanes));
  store(lanes, reinterpret_cast<double*>(&to));
}

/// Four rows: by lane, or by coordinate.
struct Rows {
  Lanes row[kLanes];
};
struct Columns {
  Vec3<Lanes> xyz;
  Lanes w;
};

REPOSE_INLINE Rows turned(const Rows& r) {
  using Vector4 = Lanes::Vector4;
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
REPOSE_INLINE Rows rows_of(const Vec3<Lanes>& xyz, const Lanes& w) {
  return turned({{xyz.x, xyz.y, xyz.z, w}});
}

/// Gathers a row of each lane.
template <typename RowOfLane>
REPOSE_INLINE Columns gather(const RowOfLane& row) {
  return columns_of({{row(0), row(1), row(2), row(3)}});
}

/// Gathers a number of each lane.
template <typename NumberOfLane>
REPOSE_INLINE Lanes each(const NumberOfLane& number) {
  return Lanes::Vector4{number(0), number(1), number(2), number(3)};
}

/// Of two rows; w: 0.
REPOSE_INLINE Lanes cross_of_rows(const Lanes& u, const Lanes& v) {
  const auto next = [](const Lanes& row) __attribute__((always_inline)) {
    return Lanes(__builtin_shufflevector(row.numbers, row.numbers, 1, 2, 0, 3));
  };
  return next(u * next(v) - next(u) * v);
}

/// Puts a number into a row's w.
REPOSE_INLINE Lanes with_w(const Lanes& row, double number) {
  return select(Lanes(Lanes::Vector4{0, 0, 0, 1}) > Lanes(0), Lanes(number), row);
}

}  // namespace repose::dem
