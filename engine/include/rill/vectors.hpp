#pragma once
// Plain vector and matrix types of the public headers.
//
//   const rill::Double3 center{0.5, 1, 0.5};  // center.y and center[1] are the same number
//   const rill::Float4x4 view = rill::Float4x4::from(viewMatrix);  // glm::value_ptr(matrix)
#include <cstddef>

namespace rill {

/// Three numbers along x, y and z, tightly packed; indexable and iterable. Public headers avoid GLM, whose sizes depend on the host's
/// defines.
template <typename T>
struct Vector3 {
  T x = 0, y = 0, z = 0;
  /// Axis 0, 1 or 2.
  constexpr T& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr const T& operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr T* begin() { return &x; }
  constexpr T* end() { return &x + 3; }
  constexpr const T* begin() const { return &x; }
  constexpr const T* end() const { return &x + 3; }
  friend bool operator==(const Vector3&, const Vector3&) = default;
};

/// Four numbers, tightly packed; indexable and iterable. A quaternion is x y z w, as in glTF.
template <typename T>
struct Vector4 {
  T x = 0, y = 0, z = 0, w = 0;
  /// Component 0 to 3.
  constexpr T& operator[](std::size_t i) { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
  constexpr const T& operator[](std::size_t i) const { return i == 0 ? x : i == 1 ? y : i == 2 ? z : w; }
  constexpr T* begin() { return &x; }
  constexpr T* end() { return &x + 4; }
  constexpr const T* begin() const { return &x; }
  constexpr const T* end() const { return &x + 4; }
  friend bool operator==(const Vector4&, const Vector4&) = default;
};

using Float3 = Vector3<float>;       ///< 12 bytes: what the device holds of a particle
using Double3 = Vector3<double>;     ///< points and vectors in scene coordinates
using Float4 = Vector4<float>;       ///< 16 bytes
using Quaternion = Vector4<double>;  ///< x y z w; unit length where it is an orientation

/// A column-major 4 x 4 matrix, 64 bytes.
struct Float4x4 {
  Float4 column[4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  /// From 16 floats in column-major order: glm::value_ptr(matrix), or &m[0][0] of a row-vector XMFLOAT4X4.
  static Float4x4 from(const float* m) {
    Float4x4 out;
    for (Float4& c : out.column) c = {m[0], m[1], m[2], m[3]}, m += 4;
    return out;
  }
};

}  // namespace rill
