#pragma once
// Plain vector and matrix types of the public headers.
//
//   const rill::Float3 up{0, 1, 0};
//   const rill::Float4x4 view = rill::Float4x4::from(viewMatrix);  // glm::value_ptr(matrix)

namespace rill {

/// Three floats, tightly packed (12 bytes). Public headers avoid GLM, whose sizes depend on the host's defines.
struct Float3 {
  float x = 0, y = 0, z = 0;
  friend bool operator==(const Float3&, const Float3&) = default;
};

/// Four floats, 16 bytes. A quaternion is x y z w, as in glTF.
struct Float4 {
  float x = 0, y = 0, z = 0, w = 0;
  friend bool operator==(const Float4&, const Float4&) = default;
};

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
