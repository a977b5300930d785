#pragma once
// Column-major camera matrices.
#include <cmath>

namespace host {

struct Matrix {
  float m[4][4] = {};  ///< column, row
};

/// World to view space: the camera looks along -z, y is up.
inline Matrix lookAt(const float (&eye)[3], const float (&target)[3]) {
  float f[3], r[3], u[3], length = 0;
  for (int a = 0; a < 3; ++a) length = std::hypot(length, f[a] = target[a] - eye[a]);
  for (float& a : f) a /= length;
  length = std::hypot(f[2], f[0]);
  r[0] = -f[2] / length, r[1] = 0, r[2] = f[0] / length;
  u[0] = r[1] * f[2] - r[2] * f[1], u[1] = r[2] * f[0] - r[0] * f[2], u[2] = r[0] * f[1] - r[1] * f[0];
  Matrix out;
  for (int a = 0; a < 3; ++a) {
    out.m[a][0] = r[a], out.m[a][1] = u[a], out.m[a][2] = -f[a];
    out.m[3][0] -= r[a] * eye[a], out.m[3][1] -= u[a] * eye[a], out.m[3][2] += f[a] * eye[a];
  }
  out.m[3][3] = 1;
  return out;
}

/// View to Vulkan's clip space with reversed depth: 1 at `nearest`, 0 at infinity.
inline Matrix perspective(float fov_y_deg, float aspect, float nearest) {
  const float scale = 1 / std::tan(fov_y_deg * 3.14159265f / 360);
  Matrix out;
  out.m[0][0] = scale / aspect, out.m[1][1] = -scale, out.m[2][3] = -1, out.m[3][2] = nearest;
  return out;
}

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix out;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r)
      for (int k = 0; k < 4; ++k) out.m[c][r] += a.m[k][r] * b.m[c][k];
  return out;
}

}  // namespace host
