#pragma once
// Affine transforms of vertices, and what they do to normals.
#include <algorithm>
#include <array>
#include <cmath>

#include "rill/vectors.hpp"

namespace rill {

/// Three rows of linear part and translation.
struct Affine {
  std::array<std::array<double, 4>, 3> row{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

  Double3 point(const Double3& p) const {
    const auto along = [&](size_t i) { return row[i][0] * p.x + row[i][1] * p.y + row[i][2] * p.z + row[i][3]; };
    return {along(0), along(1), along(2)};
  }
  friend Affine operator*(const Affine& a, const Affine& b) {
    Affine out;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 4; ++k)
        out.row[i][k] = a.row[i][0] * b.row[0][k] + a.row[i][1] * b.row[1][k] + a.row[i][2] * b.row[2][k] + (k == 3 ? a.row[i][3] : 0);
    }
    return out;
  }
};

/// How normals turn: the cofactors of the linear part, which are its inverse transposed but for the length.
struct NormalTransform {
  explicit NormalTransform(const Affine& affine) {
    const auto& m = affine.row;
    for (size_t i = 0; i < 3; ++i) {
      for (size_t k = 0; k < 3; ++k) {
        const size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        cofactor[i][k] = m[i1][k1] * m[i2][k2] - m[i1][k2] * m[i2][k1];
      }
    }
    mirrored = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2] < 0;
    double largest = 0;
    for (const auto& row : cofactor) {
      for (const double c : row) largest = std::max(largest, std::abs(c));
    }
    scale = (mirrored ? -1 : 1) / (largest > 0 ? largest : 1);  // floats hold the result
  }
  Float3 operator()(const Float3& n) const {
    const auto along = [&](size_t i) {
      return static_cast<float>(scale * (cofactor[i][0] * n.x + cofactor[i][1] * n.y + cofactor[i][2] * n.z));
    };
    return {along(0), along(1), along(2)};
  }

  std::array<std::array<double, 3>, 3> cofactor{};
  bool mirrored = false;
  double scale = 1;
};

}  // namespace rill
