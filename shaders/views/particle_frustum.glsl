// Which solids' bounding spheres meet a tile of the picture or, with LIGHT, of the light map. Needs `scene`.
#ifdef LIGHT
uvec2 surfaceSize() { return scene.counts.yz; }
#else
uvec2 surfaceSize() { return uvec2(view.width, view.height); }
#endif

uint surfaceColumns() { return (surfaceSize().x + kPixelTile - 1u) / kPixelTile; }
uint surfaceTiles() { return surfaceColumns() * ((surfaceSize().y + kPixelTile - 1u) / kPixelTile); }
uint solidWords() { return (scene.counts.x + 31u) / 32u; }

#ifdef MEETS_TILE
#include "shared/pose.glsl"

bool meetsTile(PlacedSolid solid, uvec2 tile) {
  const vec2 low = vec2(tile * kPixelTile), high = low + float(kPixelTile);
#ifdef LIGHT
  const vec2 at = lightTexel(centerOf(solid.pose));
  const float reach = solid.radius / scene.light_texel.x + 1.0;
  return all(greaterThan(at + reach, low)) && all(lessThan(at - reach, high));
#else
  const vec3 c = vec3(solid.viewX, solid.viewY, solid.viewZ);
  const float r = solid.radius;
  const vec2 a = tangentOf(low), b = tangentOf(high);  // left and top, right and bottom
  return c.z + r > view.near_depth && c.x - a.x * c.z > -r * sqrt(1.0 + a.x * a.x) && c.x - b.x * c.z < r * sqrt(1.0 + b.x * b.x) &&
         c.y - a.y * c.z < r * sqrt(1.0 + a.y * a.y) && c.y - b.y * c.z > -r * sqrt(1.0 + b.y * b.y);
#endif
}
#endif
