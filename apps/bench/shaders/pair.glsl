// One pair of the density sum, the same in every baseline: they differ in what they visit and how it lies in memory, and in nothing else.
struct Found {
  float density;  // sum of (1 - (r/h)^2)^3
  uint neighbors;
};
void meet(inout Found found, vec3 here, vec3 there, float radius) {
  precise vec3 d = here - there;
  precise float r2 = d.x * d.x + d.y * d.y + d.z * d.z;
  float t = max(1.0 - r2 / (radius * radius), 0.0);
  found.density += t * t * t;
  found.neighbors += r2 < radius * radius ? 1u : 0u;
}
