#include "offline/simulation_keys.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>

#include "core/fnv1a.hpp"
#include "core/words.hpp"
#include "model/fields.hpp"

namespace rill {
namespace {

constexpr std::array<std::string_view, 7> kExcluded{"title", "about", "duration", "probes", "camera", "look", "fluid.particles"};

std::string textOf(const Fnv1a& hash) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash.value()));
  return text;
}

std::string hashOf(const Mesh& mesh) {
  Fnv1a hash;
  hash.add(uint32_t{mesh.twoSided()});
  for (const Double3& v : mesh.data().vertices)
    for (double x : v) hash.add(std::bit_cast<uint64_t>(x));
  for (const auto& triangle : mesh.data().triangles)
    for (uint32_t corner : triangle) hash.add(corner);
  return textOf(hash);
}

class KeyCollector {
 public:
  template <class Owner>
  void collect(const std::string& path, const Owner& owner) {
    model::forEachField<Owner>([&](const auto& field) {
      using Value = typename std::decay_t<decltype(field)>::Value;
      if constexpr (model::kHasMember<Value>) {
        std::string key = (path.empty() ? "" : path + ".") + std::string(field.info.key);
        const Value* value = field.find(owner);
        if (field.info.key == "name") return;  // no bit depends on it
        if (value && std::find(kExcluded.begin(), kExcluded.end(), key) == kExcluded.end()) add(field.info, std::move(key), *value);
      }
    });
  }
  SimulationKeys take() { return std::move(keys_); }

 private:
  void add(const model::Info&, std::string key, double value) { keys_.emplace_back(std::move(key), shortestNumber(value)); }
  void add(const model::Info&, std::string key, bool value) { keys_.emplace_back(std::move(key), value ? "true" : "false"); }
  void add(const model::Info&, std::string key, uint32_t value) { keys_.emplace_back(std::move(key), std::to_string(value)); }
  void add(const model::Info&, std::string key, uint64_t value) { keys_.emplace_back(std::move(key), std::to_string(value)); }
  void add(const model::Info& info, std::string key, const std::optional<double>& value) {
    keys_.emplace_back(std::move(key), value ? shortestNumber(*value) : info.unset.empty() ? "not set" : std::string(info.unset));
  }
  void add(const model::Info&, std::string key, const std::pair<double, double>& value) {
    addList(std::move(key), std::array{value.first, value.second});
  }
  void add(const model::Info& info, std::string key, SideMask value) {
    std::string sides;
    for (size_t side = 0; side < info.words.size(); ++side)
      if (value >> side & 1) sides += (sides.empty() ? "" : ",") + std::string(info.words[side]);
    keys_.emplace_back(std::move(key), "[" + sides + "]");
  }
  void add(const model::Info&, std::string key, const Double3& vector) { addList(std::move(key), vector); }
  void add(const model::Info&, std::string key, const Quaternion& quaternion) { addList(std::move(key), quaternion); }
  template <class Vector>
  void addList(std::string key, const Vector& values) {
    std::string numbers;
    for (double number : values) numbers += (numbers.empty() ? "" : ",") + shortestNumber(number);
    keys_.emplace_back(std::move(key), "[" + numbers + "]");
  }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void add(const model::Info& info, std::string key, Enum value) {
    keys_.emplace_back(std::move(key), std::string(info.words[static_cast<size_t>(value)]));
  }
  /// The name of the file may change; its particles are covered by the hash of the initial particles.
  void add(const model::Info&, std::string key, const ParticleFile&) { keys_.emplace_back(std::move(key), "a file"); }
  /// The name of the file may change, too.
  void add(const model::Info&, std::string key, const MeshShape& shape) { keys_.emplace_back(std::move(key), hashOf(*shape.mesh)); }
  void add(const model::Info&, std::string key, const MeshMouth& mouth) {
    addList(memberPath(key, "translation"), mouth.translation);
    addList(memberPath(key, "rotation"), mouth.rotation);
    keys_.emplace_back(std::move(key), hashOf(*mouth.mesh));
  }
  template <model::Described Struct>
  void add(const model::Info&, std::string key, const Struct& value) {
    collect(key, value);
  }
  template <model::Described Struct>
  void add(const model::Info&, std::string key, const std::optional<Struct>& value) {
    if (value) collect(key, *value);
  }
  template <model::Described Struct>
  void add(const model::Info&, std::string key, const std::vector<Struct>& values) {
    for (size_t k = 0; k < values.size(); ++k) collect(key + "[" + std::to_string(k) + "]", values[k]);
  }
  // Strings and probes are excluded.
  void add(const model::Info&, std::string, const std::string&) {}
  void add(const model::Info&, std::string, const std::pair<std::string, std::string>&) {}
  void add(const model::Info&, std::string, const std::filesystem::path&) {}
  void add(const model::Info&, std::string, const std::optional<std::pair<double, double>>&) {}
  void add(const model::Info&, std::string, const std::optional<Axis>&) {}
  void add(const model::Info&, std::string, const std::optional<Double3>&) {}

  SimulationKeys keys_;
};

std::string hashOf(const ParticleSet& start) {
  Fnv1a hash;
  for (double v : start.origin) hash.add(std::bit_cast<uint64_t>(v));
  for (const std::vector<Float3>* vectors : {&start.positions, &start.velocities})
    for (const Float3& v : *vectors)
      for (float number : {v.x, v.y, v.z}) hash.add(std::bit_cast<uint32_t>(number));
  for (uint8_t fluid : start.fluids) hash.add(uint32_t{fluid});
  for (const Float4& c : start.concentrations)
    for (float share : {c.x, c.y, c.z, c.w}) hash.add(std::bit_cast<uint32_t>(share));
  return textOf(hash);
}

const std::string* find(const SimulationKeys& keys, const std::string& key) {
  const auto found = std::find_if(keys.begin(), keys.end(), [&](const auto& entry) { return entry.first == key; });
  return found == keys.end() ? nullptr : &found->second;
}

/// Which fluid each source emits, and which have an interface, by their indices: names may change.
void addNamedFluids(const Scene& scene, SimulationKeys& keys) {
  if (scene.fluids.empty()) return;
  for (size_t i = 0; i < scene.interfaces.size(); ++i) {
    const auto [first, second] =
        std::minmax({fluidIndex(scene, scene.interfaces[i].between.first), fluidIndex(scene, scene.interfaces[i].between.second)});
    keys.emplace_back(memberPath(elementPath("interfaces", i), "between"),
                      "fluids " + std::to_string(first) + " and " + std::to_string(second));
  }
  const auto add = [&](const std::string& path, const std::string& name) {
    keys.emplace_back(memberPath(path, "fluid"), std::to_string(fluidIndex(scene, name)));
  };
  for (size_t i = 0; i < scene.emitters.size(); ++i) add(elementPath("emitters", i), scene.emitters[i].fluid);
  if (scene.domain && scene.domain->inflow) add("domain.inflow", scene.domain->inflow->fluid);
}

}  // namespace

SimulationKeys simulationKeys(const Scene& scene, const ParticleSet& start) {
  KeyCollector collector;
  collector.collect("", scene);
  SimulationKeys keys = collector.take();
  addNamedFluids(scene, keys);
  keys.emplace_back("start", hashOf(start));
  return keys;
}

std::string firstDifference(const SimulationKeys& expected, const SimulationKeys& found) {
  if (expected == found) return {};
  for (const auto& [key, value] : found) {
    const std::string* wanted = find(expected, key);
    if (!wanted) return key + ": found " + value + ", expected no such key";
    if (*wanted == value) continue;
    if (key == "start") return "start: the initial particles differ (a particle file or the placement of fills has changed)";
    return key + ": found " + value + ", expected " + *wanted;
  }
  for (const auto& [key, value] : expected)
    if (!find(found, key)) return key + ": not set, expected " + value;
  return "the order of the keys differs";
}

}  // namespace rill
