#pragma once
// Scenes with several fluids.
#include "support.hpp"

namespace rill::test {

inline const std::string kTwoFluids =
    R"("fluids": [{"name": "water"}, {"name": "oil", "density": 900, "viscosity": 0.05, "color": [0.8, 0.6, 0.1]}])";

inline std::string fluidScene(const std::string& keys) {
  return R"({"rill": "0.2", "fluid": {"spacing": 0.1, "density": 998, "viscosity": 0.001}, )" + keys + "}";
}

}  // namespace rill::test
