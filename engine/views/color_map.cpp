#include "views/color_map.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace rill {
namespace {

struct Key {
  double chroma, hue;
};  // Oklab; hue in degrees, not limited to 0 .. 360

/// Lightness is linear from `first` to `last`; chroma and hue are interpolated between keys.
struct Map {
  double first, last;
  Key keys[6];
};

constexpr Map kSpeed = {0.37, 0.955, {{0.125, 262}, {0.130, 255}, {0.125, 242}, {0.108, 222}, {0.080, 200}, {0.022, 185}}};
constexpr Map kCompression = {0.90, 0.28, {{0.035, 95}, {0.125, 78}, {0.165, 52}, {0.175, 28}, {0.145, 0}, {0.090, -35}}};

}  // namespace

Float3 mapColor(ParticleColor color, double t) {
  const Map& map = color == ParticleColor::Speed ? kSpeed : kCompression;
  t = std::clamp(t, 0.0, 1.0);
  const int k = std::min(static_cast<int>(t * 5), 4);
  const double part = t * 5 - k;
  const double lightness = map.first + t * (map.last - map.first);
  const double chroma = map.keys[k].chroma + part * (map.keys[k + 1].chroma - map.keys[k].chroma);
  const double hue = (map.keys[k].hue + part * (map.keys[k + 1].hue - map.keys[k].hue)) * std::numbers::pi / 180;
  const double a = chroma * std::cos(hue), b = chroma * std::sin(hue);
  // Oklab to linear sRGB (Ottosson 2020).
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  const auto component = [](double v) { return static_cast<float>(std::clamp(v, 0.0, 1.0)); };
  return {component(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          component(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          component(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

Float3 fluidColor(size_t index) {
  constexpr uint8_t kColors[][3] = {{0, 114, 178}, {230, 159, 0},  {0, 158, 115},  {204, 121, 167},
                                    {213, 94, 0},  {86, 180, 233}, {240, 228, 66}, {150, 150, 150}};  // sRGB
  const auto& color = kColors[index % std::size(kColors)];
  const auto linear = [](uint8_t byte) {
    const double c = byte / 255.0;
    return static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  };
  return {linear(color[0]), linear(color[1]), linear(color[2])};
}

uint8_t srgbByte(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  return static_cast<uint8_t>(encoded * 255 + 0.5);
}

}  // namespace rill
