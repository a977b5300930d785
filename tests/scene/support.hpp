#pragma once
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "rill/scene_io.hpp"

namespace rill::test {

/// A temporary folder of a test, removed afterwards.
class Folder {
 public:
  Folder() {
    static std::atomic<int> number{0};
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    path = std::filesystem::path(RILL_BINARY_DIR) / "test_scene" /
           (std::string(info->test_suite_name()) + "_" + info->name() + "_" + std::to_string(number++));
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return path / name;
  }

  std::filesystem::path path;
};

inline Expected<Scene> parse(std::string_view text, std::vector<Override> overrides = {}) {
  return parseScene(text, "dam.json", {}, overrides);
}

/// The parsed scene; fails the test with the message on error.
inline Scene scene(std::string_view text, std::vector<Override> overrides = {}) {
  auto result = parse(text, std::move(overrides));
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? *result : Scene{};
}

/// The error message of a scene, or "accepted".
inline std::string parseError(std::string_view text, std::vector<Override> overrides = {}) {
  const auto result = parse(text, std::move(overrides));
  if (result) return "accepted";
  EXPECT_EQ(result.error().kind, ErrorKind::BadInput);
  return result.error().message;
}

/// A scene and the message that refuses it, which follows the name of the file, or ":line:column" behind it.
struct Refusal {
  std::string text, message;
};
inline void expectRefusals(const std::vector<Refusal>& refusals) {
  for (const Refusal& r : refusals)
    EXPECT_EQ(parseError(r.text), "dam.json" + std::string(r.message.starts_with(':') ? "" : ": ") + r.message) << r.text;
}

/// A minimal scene with the additional keys `more`.
inline std::string with(std::string_view more) { return R"({"rill": "0.1", "fluid": {"spacing": 0.1}, )" + std::string(more) + "}"; }
/// A scene with `keys` in `fluid`.
inline std::string withFluid(std::string_view keys) { return R"({"rill": "0.1", "fluid": {)" + std::string(keys) + "}}"; }

inline constexpr uint64_t kMany = 10'000'000;

/// The particles; fails the test with the message on error.
inline ParticleSet particles(Scene& from, uint64_t most = kMany) {
  auto result = makeParticles(from, most);
  EXPECT_TRUE(result) << (result ? "" : result.error().message);
  return result ? std::move(*result) : ParticleSet{};
}
inline ParticleSet particles(std::string_view text) {
  Scene from = scene(text);
  return particles(from);
}

}  // namespace rill::test
