#pragma once

namespace rill {

/// Three floats, tightly packed (12 bytes). Public headers use it in place of GLM, whose size changes with the host's defines.
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
};

}  // namespace rill
