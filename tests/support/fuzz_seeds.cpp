// fuzz_seeds FOLDER: writes the libFuzzer seed corpora, one folder per target.
#include <cstdio>
#include <fstream>

#include "fuzz/seeds.hpp"

int main(int count, char** arguments) {
  using namespace rill::test;
  if (count != 2) return std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n"), 2;
  for (const auto& [name, seeds] : {std::pair{"scene", sceneSeeds()}, std::pair{"ply", plySeeds()}, std::pair{"mesh", meshSeeds()},
                                    std::pair{"checkpoint", checkpointSeeds()}}) {
    const auto folder = std::filesystem::path(arguments[1]) / name;
    std::filesystem::create_directories(folder);
    for (size_t k = 0; k < seeds.size(); ++k) std::ofstream(folder / ("seed" + std::to_string(k)), std::ios::binary) << seeds[k];
  }
  return 0;
}
