#include <fstream>  // tinygltf needs it, but leaves it out with TINYGLTF_NO_FS
#include <nlohmann/json.hpp>

#define TINYGLTF_IMPLEMENTATION
#include "core/words.hpp"
#include "scene/gltf_document.hpp"
#include "scene/json_text.hpp"
#include "scene/mesh_readers.hpp"
#include "scene/reader.hpp"
#include "scene/sibling_file.hpp"

namespace rill {
namespace {

constexpr uint64_t kGlbHeader = 20;            // bytes, with the header of the first chunk
constexpr uint64_t kMaxGltfJson = 1ULL << 30;  // tinygltf counts the bytes of data URIs with an int

/// The JSON chunk of a binary file.
Expected<std::string_view> jsonOfGlb(std::string_view bytes, const std::filesystem::path& file) {
  if (!bytes.starts_with("glTF")) return meshError(file, "header", "does not begin with \"glTF\", expected a binary glTF file");
  if (bytes.size() < kGlbHeader) return meshError(file, "header", "found " + grouped(bytes.size()) + " bytes, expected 20 or more");
  const auto word = [&](uint64_t at) {
    uint64_t value = 0;
    for (uint64_t k = 4; k-- > 0;) value = value << 8U | static_cast<uint8_t>(bytes[at + k]);
    return value;
  };
  const uint64_t version = word(4), length = word(8), json = word(12);
  if (version != 2) return meshError(file, "header", "found the version " + grouped(version) + ", expected 2");
  if (length > bytes.size() || kGlbHeader + json > length) {
    return meshError(file, "header",
                     "declares " + grouped(length) + " bytes with " + grouped(json) + " of JSON, found " + grouped(bytes.size()) +
                         ", expected a complete file");
  }
  return bytes.substr(kGlbHeader, json);
}

/// The files that the buffers refer to, in the order in which tinygltf asks for them.
class BufferFiles {
 public:
  explicit BufferFiles(const std::filesystem::path& file) : file_(file) {}

  /// Checks what tinygltf does not: lengths, and which buffers may be in the file itself.
  Expected<void> check(const Json& document, bool binary) {
    std::vector<uint64_t> sizes;
    if (auto ok = checkBuffers(document, binary, sizes); !ok) return ok;
    return checkViews(document, sizes);
  }

  const std::optional<Error>& problem() const { return problem_; }

  tinygltf::FsCallbacks callbacks() {
    tinygltf::FsCallbacks calls{};
    calls.FileExists = [](const std::string&, void*) { return true; };
    calls.ExpandFilePath = [](const std::string& path, void*) { return path; };
    calls.ReadWholeFile = [](std::vector<unsigned char>* out, std::string*, const std::string& path, void* self) {
      return static_cast<BufferFiles*>(self)->read(*out, path);
    };
    calls.WriteWholeFile = [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; };
    setFileSize(calls);
    calls.user_data = this;
    return calls;
  }

 private:
  struct Wanted {
    size_t buffer;
    uint64_t bytes;
  };

  Expected<void> checkBuffers(const Json& document, bool binary, std::vector<uint64_t>& sizes) {
    const auto buffers = document.find("buffers");
    if (buffers == document.end() || !buffers->is_array()) return {};
    uint64_t all = 0;
    for (size_t i = 0; i < buffers->size(); ++i) {
      const Json& buffer = (*buffers)[i];
      const std::string path = elementPath("buffers", i);
      if (!buffer.is_object()) return meshError(file_, path, "expected an object");
      const auto length = buffer.find("byteLength"), uri = buffer.find("uri");
      if (length == buffer.end() || !length->is_number_unsigned() || *length == 0U)
        return meshError(file_, memberPath(path, "byteLength"), "missing or invalid, expected a whole number from 1");
      const auto size = length->get<uint64_t>();
      if (size > kMaxMeshBytes - all)
        return meshError(file_, path, "found more than " + grouped(kMaxMeshBytes) + " bytes of buffers, expected at most that");
      all += size;
      sizes.push_back(size);
      const bool text = uri != buffer.end() && uri->is_string() && !uri->get_ref<const std::string&>().empty();
      if (!text && !(binary && i == 0)) return meshError(file_, memberPath(path, "uri"), "missing, expected the buffer's file or data");
      if (!text) continue;
      const auto& name = uri->get_ref<const std::string&>();
      if (tinygltf::IsDataURI(name)) continue;
      if (name.starts_with("data:"))
        return meshError(file_, memberPath(path, "uri"), "found " + inQuotes(name) + ", expected data:application/octet-stream;base64,...");
      wanted_.push_back({i, size});
    }
    return {};
  }

  /// tinygltf reads images at the offset of their view, wherever that is.
  Expected<void> checkViews(const Json& document, const std::vector<uint64_t>& sizes) const {
    const auto views = document.find("bufferViews");
    if (views == document.end() || !views->is_array()) return {};
    for (size_t i = 0; i < views->size(); ++i) {
      const Json& view = (*views)[i];
      const std::string path = elementPath("bufferViews", i);
      if (!view.is_object()) return meshError(file_, path, "expected an object");
      const auto number = [&](const char* key, uint64_t missing) {
        const auto found = view.find(key);
        return found == view.end() ? missing : found->is_number_unsigned() ? found->get<uint64_t>() : UINT64_MAX;
      };
      const uint64_t buffer = number("buffer", UINT64_MAX), offset = number("byteOffset", 0), length = number("byteLength", UINT64_MAX);
      if (buffer < sizes.size() && (length == 0 || offset > sizes[buffer] || length > sizes[buffer] - offset))
        return meshError(file_, path,
                         "found " + grouped(length) + " bytes from " + grouped(offset) + ", expected them within the " +
                             grouped(sizes[buffer]) + " of the buffer");
    }
    return {};
  }

  /// A callback of tinygltf 2.9 and later, which require it.
  template <class Callbacks>
  static void setFileSize(Callbacks& calls) {
    if constexpr (requires { calls.GetFileSizeInBytes; })
      calls.GetFileSizeInBytes = [](size_t* bytes, std::string*, const std::string&, void*) {
        *bytes = 1;  // read() checks the size
        return true;
      };
  }

  bool read(std::vector<unsigned char>& out, const std::string& name) {
    if (next_ >= wanted_.size()) return false;
    const auto [buffer, bytes] = wanted_[next_++];
    const std::string where = file_.string() + ": " + memberPath(elementPath("buffers", buffer), "uri") + ": ";
    const auto content = readSibling(file_, name, kMaxMeshBytes);
    if (!content) {
      problem_ = Error{content.error().kind, where + content.error().message};
      return false;
    }
    if (content->size() < bytes) {
      problem_ = Error{ErrorKind::BadInput, where + "found " + grouped(content->size()) + " bytes, expected " + grouped(bytes)};
      return false;
    }
    out.assign(content->begin(), content->begin() + static_cast<ptrdiff_t>(bytes));
    return true;
  }

  const std::filesystem::path& file_;
  std::vector<Wanted> wanted_;
  size_t next_ = 0;
  std::optional<Error> problem_;
};

Expected<void> checkGltfVersion(const Json& document, const std::filesystem::path& file) {
  if (!document.is_object()) return meshError(file, "JSON", "found no object, expected a glTF document");
  const auto asset = document.find("asset");
  const auto version = asset == document.end() || !asset->is_object() ? Json() : asset->value("version", Json());
  if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2."))
    return meshError(file, "asset.version", foundText(version) + ", expected \"2.0\"");
  return {};
}

/// The first line of what tinygltf reports.
std::string firstLine(const std::string& text) {
  constexpr size_t kMaxLength = 200;
  const std::string line = text.substr(0, std::min(text.find('\n'), kMaxLength));
  return line.empty() ? "cannot be read" : line;
}

}  // namespace

Expected<tinygltf::Model> loadGltf(std::string_view bytes, const std::filesystem::path& file, bool binary) {
  if (!binary && bytes.starts_with("glTF"))
    return meshError(file, "header", "found a binary glTF file, expected JSON; such files end in .glb");
  const auto json = binary ? jsonOfGlb(bytes, file) : Expected<std::string_view>(bytes);
  if (!json) return json.error();
  if (json->size() > kMaxGltfJson)
    return meshError(file, "JSON", "found " + grouped(json->size()) + " bytes, expected at most " + grouped(kMaxGltfJson));
  BufferFiles files(file);
  {
    const auto document = parseJsonText(*json, file.string());  // also limits the depth, with which tinygltf recurses
    if (!document) return document.error();
    if (auto ok = checkGltfVersion(*document, file); !ok) return ok.error();
    if (auto ok = files.check(*document, binary); !ok) return ok.error();
  }
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks(files.callbacks());
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*, int, void*) { return true; },
                        nullptr);
  tinygltf::Model model;
  std::string errors, warnings;
  const auto size = static_cast<unsigned>(bytes.size());
  const bool ok = binary
                      ? loader.LoadBinaryFromMemory(&model, &errors, &warnings, reinterpret_cast<const unsigned char*>(bytes.data()), size)
                      : loader.LoadASCIIFromString(&model, &errors, &warnings, bytes.data(), size, "");
  if (files.problem()) return *files.problem();
  if (!ok) return meshError(file, "glTF", firstLine(errors) + ", expected a valid document");
  return model;
}

}  // namespace rill
