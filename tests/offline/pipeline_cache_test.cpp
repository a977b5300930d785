// The file with compiled pipelines: what is kept, and what is ignored.
#include "offline/pipeline_cache.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <new>

#include "support/temporary_folder.hpp"

namespace rill::test {
namespace pipeline_cache_test {

using offline::PipelineCache;
namespace fs = std::filesystem;
using Bytes = std::vector<std::byte>;

VkPhysicalDeviceProperties properties(uint8_t uuid = 7) {
  VkPhysicalDeviceProperties p{};
  p.vendorID = 0x1234;
  p.deviceID = 0x5678;
  p.driverVersion = 42;
  std::memset(p.pipelineCacheUUID, uuid, VK_UUID_SIZE);
  return p;
}

/// What a driver gives for these pipelines.
Bytes driverData(const VkPhysicalDeviceProperties& p, std::string_view pipelines) {
  VkPipelineCacheHeaderVersionOne header{sizeof header, VK_PIPELINE_CACHE_HEADER_VERSION_ONE, p.vendorID, p.deviceID, {}};
  std::memcpy(header.pipelineCacheUUID, p.pipelineCacheUUID, VK_UUID_SIZE);
  Bytes data(sizeof header + pipelines.size());
  std::memcpy(data.data(), &header, sizeof header);
  std::memcpy(data.data() + sizeof header, pipelines.data(), pipelines.size());
  return data;
}

// A driver with one cache: what it was created from, and what it has.
Bytes created, held;
int alive = 0;
VkResult create(VkDevice, const VkPipelineCacheCreateInfo* info, const VkAllocationCallbacks*, VkPipelineCache* out) {
  const auto* data = static_cast<const std::byte*>(info->pInitialData);
  created.assign(data, data + info->initialDataSize);
  held = created;
  ++alive;
  *out = reinterpret_cast<VkPipelineCache>(uintptr_t(1));
  return VK_SUCCESS;
}
void destroy(VkDevice, VkPipelineCache, const VkAllocationCallbacks*) { --alive; }
VkResult exhausted(VkDevice, VkPipelineCache, size_t*, void*) { throw std::bad_alloc(); }
VkResult tooMuch(VkDevice, VkPipelineCache, size_t* size, void* out) {
  EXPECT_EQ(out, nullptr) << "data of this size must not be requested";
  *size = offline::kMaxPipelineCacheBytes;  // with a header more than a file may have
  return VK_SUCCESS;
}
VkResult data(VkDevice, VkPipelineCache, size_t* size, void* out) {
  if (out) std::memcpy(out, held.data(), std::min(*size, held.size()));
  *size = held.size();
  return VK_SUCCESS;
}

class PipelineCacheTest : public ::testing::Test {
 protected:
  /// A run of a program in which the driver compiles `pipelines`; empty: nothing new.
  void run(std::string_view pipelines, const VkPhysicalDeviceProperties& device = properties()) {
    PipelineCache cache(folder(), device, VK_NULL_HANDLE, {create, destroy, data});
    EXPECT_NE(cache.handle(), VK_NULL_HANDLE);
    if (!pipelines.empty()) held = driverData(device, pipelines);
    cache.save();
  }
  fs::path folder() const { return temporary_.path() / "cache" / "rill"; }
  fs::path file() const { return offline::pipelineCacheFile(folder(), properties()); }
  Bytes content() const {
    std::ifstream stream(file(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
  }
  void overwrite(std::span<const std::byte> bytes) const {
    std::ofstream(file(), std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  void TearDown() override { EXPECT_EQ(alive, 0); }

 private:
  TemporaryFolder temporary_;
};

TEST_F(PipelineCacheTest, NextRunStartsWithWhatWasCompiled) {
  run("all");
  EXPECT_TRUE(created.empty());
  run("");
  EXPECT_EQ(created, driverData(properties(), "all"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder()), {}), 1) << "no part file is left";
}

TEST_F(PipelineCacheTest, WritesOnlyWhatIsNew) {
  run("all");
  const auto before = fs::last_write_time(file());
  fs::last_write_time(file(), before - std::chrono::hours(1));
  run("");
  EXPECT_EQ(fs::last_write_time(file()), before - std::chrono::hours(1));
  run("all and more");
  EXPECT_GT(fs::last_write_time(file()), before - std::chrono::hours(1));
}

TEST_F(PipelineCacheTest, MakesNoFileForDriversThatKeepNothing) {
  PipelineCache cache(folder(), properties(), VK_NULL_HANDLE, {create, destroy, data});
  held = driverData(properties(), "");
  cache.save();
  EXPECT_FALSE(fs::exists(folder()));
}

TEST_F(PipelineCacheTest, IgnoresDamagedFiles) {
  run("all of the pipelines");
  const Bytes good = content();
  for (size_t length = 0; length < good.size(); ++length) {
    overwrite(std::span(good).first(length));
    run("");
    EXPECT_TRUE(created.empty()) << length << " bytes";
  }
  for (size_t at = 0; at < good.size(); ++at) {
    Bytes bad = good;
    bad[at] ^= std::byte{0x10};
    overwrite(bad);
    run("");
    EXPECT_TRUE(created.empty()) << "byte " << at;
  }
  overwrite(good);
  run("");
  EXPECT_FALSE(created.empty());
}

TEST_F(PipelineCacheTest, IgnoresFilesOfOtherDevices) {
  run("all");
  overwrite(offline::encodePipelineCache(driverData(properties(9), "foreign")));
  run("");
  EXPECT_TRUE(created.empty());
  VkPhysicalDeviceProperties newer = properties();
  newer.driverVersion = 43;
  EXPECT_NE(offline::pipelineCacheFile(folder(), newer), file());
  // Drivers of a vendor may give all of its devices one UUID.
  VkPhysicalDeviceProperties sibling = properties();
  sibling.deviceID = 0x5679;
  EXPECT_NE(offline::pipelineCacheFile(folder(), sibling), file());
  VkPhysicalDeviceProperties other = properties();
  other.vendorID = 0x1235;
  EXPECT_NE(offline::pipelineCacheFile(folder(), other), file());
}

TEST_F(PipelineCacheTest, KeepsNothingThatIsTooLarge) {
  for (const auto give : {exhausted, tooMuch}) {
    PipelineCache cache(folder(), properties(), VK_NULL_HANDLE, {create, destroy, give});
    cache.save();
    EXPECT_FALSE(fs::exists(folder()));
  }
}

TEST_F(PipelineCacheTest, RunsWhereNothingCanBeWritten) {
  fs::create_directories(folder().parent_path());
  std::ofstream(folder()) << "a file in place of the folder";
  run("all");
  EXPECT_TRUE(fs::is_regular_file(folder()));
}

}  // namespace pipeline_cache_test
}  // namespace rill::test
