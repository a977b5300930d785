#include "bench/traffic/cost_model.hpp"

namespace rill::bench {
namespace {

// Latencies: 1 us a dispatch and 3 us a barrier on a large GPU, more where caches are flushed through a slower memory.
constexpr Card kCards[] = {
    {"H200", 4800, 1, 3, "NVIDIA H200 data sheet: GPU memory bandwidth 4.8 TB/s"},
    {"H100", 3350, 1, 3, "NVIDIA H100 data sheet: H100 SXM, GPU memory bandwidth 3.35 TB/s"},
    {"RTX 4070", 504, 1, 3, "NVIDIA GeForce RTX 4070: 192 bits of GDDR6X at 21 Gbit/s"},
    {"RX 7800 XT", 624, 1, 3, "AMD Radeon RX 7800 XT: memory bandwidth up to 624 GB/s (256 bits at 19.5 Gbit/s)"},
    {"A770", 560, 2, 5, "Intel Arc A770 16 GB, product specifications: graphics memory bandwidth 560 GB/s"},
    {"Apple M1", 68.25, 3, 8, "Apple M1: 128 bits of LPDDR4X-4266"},
    {"V3D 7.1", 17.1, 20, 40, "Raspberry Pi 5 product brief: LPDDR4X-4267, 32 bits"},
};

}  // namespace

std::span<const Card> cards() { return kCards; }

const Card* cardOf(std::string_view deviceName) {
  for (const Card& card : kCards) {
    const size_t at = deviceName.find(card.name);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = deviceName.substr(at + card.name.size());
    if (rest.starts_with(" Ti") || rest.starts_with(" SUPER")) continue;  // another card
    return &card;
  }
  return nullptr;
}

}  // namespace rill::bench
