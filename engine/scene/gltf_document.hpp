#pragma once
// A glTF 2.0 file with its buffers, by tinygltf.
#include <filesystem>
#include <string_view>

#include "rill/expected.hpp"

// A host may have the library, too: it gets a namespace of its own here.
#define tinygltf rill_tinygltf
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

namespace rill {

/// Parses .gltf, or .glb if `binary`, and loads the buffers, which have the lengths that the file declares. Images are left out.
/// The indices in the model are as in the file: not checked.
Expected<tinygltf::Model> loadGltf(std::string_view bytes, const std::filesystem::path& file, bool binary);

}  // namespace rill
