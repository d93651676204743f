// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "dem_gpu/core/quaternion.h"
#include "dem_gpu/core/vec3.h"

namespace dem_gpu::io {

// Vectors, quaternions and flags as rows of plain numbers, and back.

inline std::vector<double> rows_of(const std::vector<Vec3>& vectors) {
  std::vector<double> rows;
  rows.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) rows.insert(rows.end(), {v.x, v.y, v.z});
  return rows;
}

inline std::vector<double> rows_of(const std::vector<Quaternion>& quaternions) {
  std::vector<double> rows;
  rows.reserve(4 * quaternions.size());
  for (const Quaternion& q : quaternions) rows.insert(rows.end(), {q.w, q.x, q.y, q.z});
  return rows;
}

inline std::vector<std::uint8_t> rows_of(const std::vector<char>& flags) { return {flags.begin(), flags.end()}; }

inline std::vector<Vec3> vectors_of(const std::vector<double>& rows) {
  std::vector<Vec3> vectors(rows.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = {rows[3 * i], rows[3 * i + 1], rows[3 * i + 2]};
  return vectors;
}

inline std::vector<Quaternion> quaternions_of(const std::vector<double>& rows) {
  std::vector<Quaternion> quaternions(rows.size() / 4);
  for (std::size_t i = 0; i < quaternions.size(); ++i)
    quaternions[i] = {rows[4 * i], rows[4 * i + 1], rows[4 * i + 2], rows[4 * i + 3]};
  return quaternions;
}

inline std::vector<char> flags_of(const std::vector<std::uint8_t>& rows) { return {rows.begin(), rows.end()}; }

}  // namespace dem_gpu::io
