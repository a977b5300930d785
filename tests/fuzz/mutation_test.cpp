// Runs the fuzz targets on reproducible mutations of their seeds, without libFuzzer. See tests/fuzz/run.sh for longer fuzzing.
#include <gtest/gtest.h>

#include <random>

#include "fuzz/seeds.hpp"
#include "fuzz/targets.hpp"

namespace rill::test {
namespace {

using Target = int (*)(const uint8_t*, size_t);

void feed(Target target, const std::string& input) {
  // Allocated at its exact size, so that sanitizers detect reads beyond the end.
  const std::vector<uint8_t> bytes(input.begin(), input.end());
  EXPECT_EQ(target(bytes.data(), bytes.size()), 0);
}

/// Applies one to four mutations: flipped bits, extreme numbers, removed, repeated or spliced ranges, truncation.
std::string mutated(std::string text, const std::vector<std::string>& seeds, std::mt19937& random) {
  const auto below = [&](size_t end) { return end == 0 ? 0 : random() % end; };
  for (size_t changes = 1 + below(4); changes > 0; --changes) {
    const size_t at = below(text.size()), length = std::min(text.size() - at, 1 + below(16));
    switch (below(7)) {
      case 0:
        if (!text.empty()) text[at] = static_cast<char>(text[at] ^ 1 << below(8));
        break;
      case 1:
        if (!text.empty()) text[at] = static_cast<char>(random());
        break;
      case 2:
        text.erase(at, length);
        break;
      case 3:
        text.insert(at, text.substr(at, length));
        break;
      case 4: {
        static const char* const words[] = {
            "-1", "1e309", "0", "null", "[]", "{}", "\"", "99999999999999999999", "nan", "\xff\xff\xff\xff", "1e-320"};
        text.insert(at, words[below(std::size(words))]);
        break;
      }
      case 5: {
        const std::string& other = seeds[below(seeds.size())];
        text.insert(at, other.substr(below(other.size()), 1 + below(64)));
        break;
      }
      default:
        text.resize(at);
    }
  }
  return text;
}

void expectNoCrash(Target target, const std::vector<std::string>& seeds, int rounds) {
  std::mt19937 random(1);
  for (const std::string& seed : seeds) {
    feed(target, seed);
    for (int round = 0; round < rounds; ++round) feed(target, mutated(seed, seeds, random));
  }
  feed(target, "");
}

TEST(Mutations, ScenesDoNotCrash) { expectNoCrash(fuzzScene, sceneSeeds(), 300); }
TEST(Mutations, PlyFilesDoNotCrash) { expectNoCrash(fuzzPly, plySeeds(), 1500); }
TEST(Mutations, MeshFilesDoNotCrash) { expectNoCrash(fuzzMesh, meshSeeds(), 1500); }
TEST(Mutations, CheckpointsDoNotCrash) { expectNoCrash(fuzzCheckpoint, checkpointSeeds(), 3000); }

}  // namespace
}  // namespace rill::test
