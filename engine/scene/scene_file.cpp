// loadScene() and parseScene(): parse the text, apply overrides, check the version, read the keys.
#include <exception>
#include <new>

#include "rill/scene_io.hpp"
#include "scene/reader.hpp"

namespace rill {
namespace {

Expected<Scene> readScene(std::string_view text, std::string_view name, const std::filesystem::path& folder,
                          std::span<const Override> overrides) {
  auto root = parseJsonText(text, name);
  if (!root) return root.error();
  if (!root->is_object()) {
    // Without the content: it may be any file's.
    const std::string found = root->is_string() ? "found a string" : root->is_number() ? "found a number" : foundText(*root);
    return Error{ErrorKind::BadInput, std::string(name) + ": " + found + ", expected an object { ... }"};
  }

  OverrideMarks marks;
  const auto applied = applyOverrides(*root, overrides, marks);
  Reader reader(name, marks, folder);
  Scene scene;
  if (!reader.version(*root)) return Error{ErrorKind::BadInput, reader.message()};
  if (!applied) return applied.error();
  if (!reader.object(*root, "", scene)) return Error{ErrorKind::BadInput, reader.message()};
  scene.name = std::filesystem::path(name).stem().string();
  return scene;
}

/// Turns exceptions of `work` into errors: nothing may throw out of the library.
template <class Work>
Expected<Scene> guarded(std::string_view name, Work&& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::OutOfMemory, std::string(name) + ": not enough memory to read the scene"};
  } catch (const std::exception& trouble) { return Error{ErrorKind::Failed, std::string(name) + ": reading failed: " + trouble.what()}; }
}

}  // namespace

Expected<Scene> parseScene(std::string_view text, std::string_view name, const std::filesystem::path& folder,
                           std::span<const Override> overrides) {
  return guarded(name, [&] { return readScene(text, name, folder, overrides); });
}

Expected<Scene> loadScene(const std::filesystem::path& file, std::span<const Override> overrides) {
  const std::string name = file.string();
  return guarded(name, [&]() -> Expected<Scene> {
    const auto text = readWholeFile(file, kMaxSceneBytes);
    if (!text) return text.error();
    auto scene = readScene(*text, name, file.parent_path(), overrides);
    if (scene) scene->file = file;
    return scene;
  });
}

}  // namespace rill
