#include "bench/experiments/bands.hpp"

namespace rill::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kShown = std::numeric_limits<double>::infinity();

constexpr Band kBands[] = {
    {"martin-moyce", "front, shifted", 0.05, {kShown, kShown, kShown}, "%", ""},
    {"martin-moyce", "front, as it is", kNone, {kShown, kShown, kShown}, "%", ""},
    {"martin-moyce", "front, shift", kNone, {kShown, kShown, kShown}, "", ""},
    {"martin-moyce", "height, shifted", kNone, {kShown, kShown, kShown}, "%", ""},
    {"martin-moyce", "height, as it is", kNone, {kShown, kShown, kShown}, "%", ""},
    {"martin-moyce", "height, shift", kNone, {kShown, kShown, kShown}, "", ""},
    {"still-tank", "rms speed, 0.5 s", kNone, {kShown, kShown, kShown}, "m/s", ""},
    {"still-tank", "rms speed, 2 s", 0.02, {kShown, kShown, kShown}, "m/s", ""},
    {"still-tank", "rms speed, 6 s", 0.02, {kShown, kShown, kShown}, "m/s", ""},
    {"still-tank", "level", 0.01, {kShown, kShown, kShown}, "%", ""},
    {"still-tank", "twice the centre of mass", 0.01, {kShown, kShown, kShown}, "%", ""},
    {"still-tank", "pressure", kNone, {kShown, kShown, kShown}, "%", ""},
    {"still-tank", "floor's load, rms", kNone, {kShown, kShown, kShown}, "%", ""},
    {"still-tank", "energy", kNone, {kShown, kShown, kShown}, "%", ""},
    {"", "bulk density", 0.003, {kShown, kShown, kShown}, "%", ""},
    {"", "clumped", 0.01, {kShown, kShown, kShown}, "%", ""},
    {"", "energy, end", kNone, {kShown, kShown, kShown}, "%", ""},
    {"", "energy, peak", kNone, {kShown, kShown, kShown}, "%", ""},
    {"slosh", "period", 0.02, {kShown, kShown, kShown}, "%", ""},
    {"slosh", "damping a period", kNone, {kShown, kShown, kShown}, "", ""},
    {"elliptic-drop", "long axis, end", 0.03, {kShown, kShown, kShown}, "%", ""},
    {"elliptic-drop", "long axis, worst", 0.03, {kShown, kShown, kShown}, "%", ""},
    {"elliptic-drop", "short axis, end", kNone, {kShown, kShown, kShown}, "%", ""},
    {"elliptic-drop", "area, end", kNone, {kShown, kShown, kShown}, "%", ""},
    {"free-fall", "way", kNone, {kShown, kShown, kShown}, "%", ""},
    {"free-fall", "speed", kNone, {kShown, kShown, kShown}, "%", ""},
    {"free-drop", "momentum, drift", kNone, {kShown, kShown, kShown}, "%", ""},
    {"free-drop", "angular momentum, drift", kNone, {kShown, kShown, kShown}, "%", ""},
    {"torricelli", "speed over Torricelli's", kNone, {kShown, kShown, kShown}, "%", ""},
    {"torricelli", "contraction", kNone, {kShown, kShown, kShown}, "%", ""},
};

}  // namespace

std::span<const Band> bands() { return kBands; }

const Band* bandOf(std::string_view family, std::string_view figure) {
  for (const Band& band : kBands)
    if (family.starts_with(band.family) && figure == band.figure) return &band;
  return nullptr;
}

}  // namespace rill::bench
