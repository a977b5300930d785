#include "offline/pipeline_cache.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "core/fnv1a.hpp"

namespace rill::offline {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view kMagic = "RILLPIP1";
constexpr size_t kHeader = kMagic.size() + 2 * sizeof(uint64_t);           // before the driver's data
constexpr size_t kDriverHeader = sizeof(VkPipelineCacheHeaderVersionOne);  // bytes that every driver's data begins with

uint64_t checksum(std::span<const std::byte> bytes) {
  Fnv1a hash;
  hash.add(bytes);
  return hash.value();
}

std::vector<std::byte> read(const fs::path& file) {
  std::error_code failed;
  const uint64_t size = fs::is_regular_file(file, failed) ? fs::file_size(file, failed) : 0;
  if (failed || size == 0 || size > kMaxPipelineCacheBytes) return {};
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::byte> bytes(size);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  return stream ? bytes : std::vector<std::byte>{};
}

void replace(const fs::path& file, std::span<const std::byte> bytes) {
  std::error_code failed;
  fs::create_directories(file.parent_path(), failed);
  fs::path part = file;
  part += "." + std::to_string(getpid()) + ".part";  // another program may save as well
  bool written = false;
  {
    std::ofstream stream(part, std::ios::binary);
    stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    written = stream.good();
  }
  if (written) fs::rename(part, file, failed);
  if (!written || failed) fs::remove(part, failed);
}

}  // namespace

fs::path pipelineCacheFile(const fs::path& folder, const VkPhysicalDeviceProperties& device) {
  char text[32];
  std::snprintf(text, sizeof text, "pipelines-%08x-%08x-", device.vendorID, device.deviceID);
  std::string name = text;
  for (const uint8_t byte : device.pipelineCacheUUID) {
    std::snprintf(text, sizeof text, "%02x", unsigned{byte});
    name += text;
  }
  std::snprintf(text, sizeof text, "-%08x", device.driverVersion);
  return folder / (name + text);
}

std::vector<std::byte> encodePipelineCache(std::span<const std::byte> data) {
  const std::array<uint64_t, 2> about = {data.size(), checksum(data)};
  const auto header = std::as_bytes(std::span(about));
  std::vector<std::byte> content(kMagic.size() + header.size() + data.size());
  std::memcpy(content.data(), kMagic.data(), kMagic.size());
  std::memcpy(content.data() + kMagic.size(), header.data(), header.size());
  std::ranges::copy(data, content.end() - static_cast<std::ptrdiff_t>(data.size()));
  return content;
}

std::span<const std::byte> decodePipelineCache(std::span<const std::byte> content, const VkPhysicalDeviceProperties& device) {
  std::array<uint64_t, 2> about{};
  if (content.size() < kMagic.size() + sizeof about || std::memcmp(content.data(), kMagic.data(), kMagic.size()) != 0) return {};
  std::memcpy(about.data(), content.data() + kMagic.size(), sizeof about);
  const auto data = content.subspan(kMagic.size() + sizeof about);
  if (about[0] != data.size() || about[1] != checksum(data) || data.size() < kDriverHeader) return {};
  VkPipelineCacheHeaderVersionOne header;
  std::memcpy(&header, data.data(), sizeof header);
  const bool own = header.headerSize >= kDriverHeader && header.headerVersion == VK_PIPELINE_CACHE_HEADER_VERSION_ONE &&
                   header.vendorID == device.vendorID && header.deviceID == device.deviceID &&
                   std::memcmp(header.pipelineCacheUUID, device.pipelineCacheUUID, VK_UUID_SIZE) == 0;
  return own ? data : std::span<const std::byte>{};
}

PipelineCache::PipelineCache(const fs::path& folder, const VkPhysicalDeviceProperties& properties, VkDevice device,
                             const Functions& functions)
    : file_(pipelineCacheFile(folder, properties)), device_(device), functions_(functions) {
  try {
    const std::vector<std::byte> content = read(file_);
    const auto data = decodePipelineCache(content, properties);
    saved_.assign(data.begin(), data.end());
  } catch (const std::exception&) {}  // no memory for it: all is compiled anew
  VkPipelineCacheCreateInfo create{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
  create.initialDataSize = saved_.size();
  create.pInitialData = saved_.data();
  if (functions_.create(device_, &create, nullptr, &handle_) == VK_SUCCESS) return;
  handle_ = VK_NULL_HANDLE;
}

PipelineCache::~PipelineCache() {
  if (handle_) functions_.destroy(device_, handle_, nullptr);
}

void PipelineCache::save() noexcept {
  try {
    saveNew();
  } catch (const std::exception&) {}
}

void PipelineCache::saveNew() {
  size_t size = 0;
  if (!handle_ || functions_.data(device_, handle_, &size, nullptr) != VK_SUCCESS) return;
  if (size <= kDriverHeader || size > kMaxPipelineCacheBytes - kHeader) return;
  std::vector<std::byte> data(size);
  if (functions_.data(device_, handle_, &size, data.data()) != VK_SUCCESS) return;
  data.resize(size);
  if (data == saved_) return;
  replace(file_, encodePipelineCache(data));
  saved_ = std::move(data);
}

}  // namespace rill::offline
