// One pair of the density sum, shared by all baselines: they differ only in candidates and memory layout.
struct PairSum {
  float density;  // sum of (1 - (r/h)^2)^3
  uint neighbors;
};
void addPair(inout PairSum sum, vec3 here, vec3 there, float radius) {
  precise vec3 d = here - there;
  precise float r2 = d.x * d.x + d.y * d.y + d.z * d.z;
  float t = max(1.0 - r2 / (radius * radius), 0.0);
  sum.density += t * t * t;
  sum.neighbors += r2 < radius * radius ? 1u : 0u;
}
