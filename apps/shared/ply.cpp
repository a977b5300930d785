#include "shared/ply.hpp"

#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

#include "core/numbers.hpp"
#include "core/words.hpp"
#include "fill/ply_format.hpp"
#include "shared/atomic_file.hpp"

namespace rill::apps {
namespace {

constexpr double kRandoms = 1 << 24;  ///< random numbers of whitewater are below

struct Vertex {
  float position[3];
  float velocity[3];
  float density;
  uint32_t id;
};
static_assert(sizeof(Vertex) == 32);
static_assert(std::endian::native == std::endian::little, "the records are written as they are in memory");

std::string headOf(double time_s, const char* comments, size_t count) {
  return "ply\nformat binary_little_endian 1.0\ncomment time " + shortestNumber(time_s) + "\n" + comments + "element vertex " +
         std::to_string(count) + "\n";
}

}  // namespace

std::vector<std::byte> encodePly(const offline::Particles& particles, double time_s) {
  const size_t count = particles.positions.size();
  assert(particles.velocities.size() == count && particles.densities.size() == count && particles.ids.size() == count);
  assert(particles.fluids.empty() || particles.fluids.size() == count);
  std::string header = headOf(time_s, "", count);
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "density"}) header += std::string("property float ") + name + "\n";
  header += "property uint id\n";
  const bool several = !particles.fluids.empty();
  if (several) header += "property uchar fluid\n";
  for (size_t fluid : particles.diffusing) header += "property float concentration" + std::to_string(fluid) + "\n";
  header += "end_header\n";

  const size_t stride = sizeof(Vertex) + (several ? 1 : 0) + particles.concentrations.size() * sizeof(float);
  std::vector<std::byte> bytes(header.size() + count * stride);
  std::memcpy(bytes.data(), header.data(), header.size());
  std::byte* next = bytes.data() + header.size();
  for (size_t i = 0; i < count; ++i, next += stride) {
    const Float3 &p = particles.positions[i], &v = particles.velocities[i];
    const Vertex vertex{{p.x, p.y, p.z}, {v.x, v.y, v.z}, particles.densities[i], particles.ids[i]};
    std::memcpy(next, &vertex, sizeof vertex);
    if (several) next[sizeof vertex] = static_cast<std::byte>(particles.fluids[i]);
    for (size_t n = 0; n < particles.concentrations.size(); ++n)
      std::memcpy(next + sizeof vertex + 1 + n * sizeof(float), &particles.concentrations[n][i], sizeof(float));
  }
  return bytes;
}

std::vector<std::byte> encodeWhitewaterPly(const offline::DiffuseParticles& particles, double time_s) {
  const size_t count = particles.positions.size();
  assert(particles.velocities.size() == count && particles.ages.size() == count && particles.classes.size() == count &&
         particles.randoms.size() == count);
  std::string header = headOf(time_s, "comment class 0 spray, 1 foam, 2 bubble\n", count);
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz", "age"}) header += std::string("property float ") + name + "\n";
  header += "property uint random\nproperty uchar class\nend_header\n";

  constexpr size_t kBytes = 33;  // seven floats, a word and a byte
  std::vector<std::byte> bytes(header.size() + count * kBytes);
  std::memcpy(bytes.data(), header.data(), header.size());
  std::byte* next = bytes.data() + header.size();
  for (size_t i = 0; i < count; ++i, next += kBytes) {
    const Float3 &p = particles.positions[i], &v = particles.velocities[i];
    const float numbers[7] = {p.x, p.y, p.z, v.x, v.y, v.z, particles.ages[i]};
    std::memcpy(next, numbers, sizeof numbers);
    std::memcpy(next + sizeof numbers, &particles.randoms[i], sizeof(uint32_t));
    next[sizeof numbers + sizeof(uint32_t)] = static_cast<std::byte>(particles.classes[i]);
  }
  return bytes;
}

Expected<offline::DiffuseParticles> readWhitewaterPly(const std::filesystem::path& file) {
  constexpr std::array<std::string_view, 9> kNames{"x", "y", "z", "vx", "vy", "vz", "class", "age", "random"};
  constexpr size_t kClass = 6, kAge = 7, kRandom = 8;
  const auto header = ply::readHeader(file, "vertex");
  if (!header) return header.error();
  if (header->elements.empty() || header->elements.back().name != "vertex")
    return header->badInput("the header has no vertex element; expected one with x, y, z, vx, vy, vz and class");
  std::array<int, kNames.size()> column;
  column.fill(-1);
  if (auto ok = header->findColumns(header->elements.back(), kNames, column); !ok) return ok.error();
  for (size_t k = 0; k < kAge; ++k)
    if (column[k] < 0) return header->badInput("has no property \"" + std::string(kNames[k]) + "\", which whitewater needs");
  if (auto ok = header->checkCounts(); !ok) return ok.error();
  ply::Body body(*header);
  if (!body.isOpen()) return header->badInput("cannot be read");
  offline::DiffuseParticles all;
  std::vector<double> row;
  for (const ply::Element& element : header->elements) {
    for (uint64_t i = 0; i < element.count && !element.properties.empty(); ++i) {
      if (auto ok = body.read(element, i, row); !ok) return ok.error();
      if (element.name != "vertex") continue;
      std::array<double, kNames.size()> v{};
      for (size_t k = 0; k < kNames.size(); ++k)
        if (column[k] >= 0) v[k] = row[static_cast<size_t>(column[k])];
      if (auto ok = header->checkMotion(i, std::span(v).first(kClass)); !ok) return ok.error();
      if (v[kClass] != 0 && v[kClass] != 1 && v[kClass] != 2)
        return header->badInput("vertex " + grouped(i) + ", property \"class\": found " + shortestNumber(v[kClass]) +
                                ", expected 0 (spray), 1 (foam) or 2 (bubble)");
      if (!fitsFloat(v[kAge]))
        return header->badInput("vertex " + grouped(i) + ", property \"age\": found " + shortestNumber(v[kAge]) +
                                ", expected a finite number");
      if (!(v[kRandom] >= 0 && v[kRandom] < kRandoms && v[kRandom] == std::floor(v[kRandom])))
        return header->badInput("vertex " + grouped(i) + ", property \"random\": found " + shortestNumber(v[kRandom]) +
                                ", expected a whole number from 0 to 16,777,215");
      const auto number = [&](size_t k) { return static_cast<float>(v[k]); };
      all.positions.push_back({number(0), number(1), number(2)});
      all.velocities.push_back({number(3), number(4), number(5)});
      all.ages.push_back(number(kAge));
      all.classes.push_back(static_cast<WhitewaterClass>(v[kClass]));
      if (column[kRandom] >= 0) all.randoms.push_back(static_cast<uint32_t>(v[kRandom]));
    }
  }
  return all;
}

Expected<void> writePly(const std::filesystem::path& file, const offline::Particles& particles, double time_s) {
  return writeFile(file, encodePly(particles, time_s));
}

}  // namespace rill::apps
