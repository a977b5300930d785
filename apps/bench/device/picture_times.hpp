#pragma once
// Times of final pictures of a dam break, by their size.
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bench/bench.hpp"

namespace rill::bench {

struct PictureTimes {
  std::string size;        ///< "1920x1080"
  std::vector<double> ms;  ///< of each frame, without the copy to the host
  std::string leftOut;     ///< why it was not drawn
};

/// Draws 50,000 particles in each size of which `bench` runs the case "picture-SIZE", for at most about `budget_s` s, set-up included.
/// `done` is called with the times of each.
Expected<void> timePictures(Bench& bench, std::span<const std::pair<uint32_t, uint32_t>> sizes, double budget_s,
                            const std::function<void(const PictureTimes&)>& done);

}  // namespace rill::bench
