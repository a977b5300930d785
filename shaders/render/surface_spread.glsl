// Each invocation of a particle kernel visits the samples that its sphere may cover. The whole
// workgroup visits those of a sphere that covers many: near the eye one fills the picture, and
// lavapipe ends a loop after 65,535 turns. Before including, define visit(center, radius, at), and
// visitedAll(owner) for what is to be done with what an invocation found of another one's sphere;
// needs `counters`.

const int kOwnSamples = 1024;   // that an invocation visits by itself at most
const int kMaxVisits = 60000;  // of one invocation for all large spheres of its workgroup

shared vec4 large_sphere[kSurfaceGroup];
shared uint large_owner[kSurfaceGroup];
shared uint large_count;

int areaOf(ivec4 rect) { return max(rect.z - rect.x + 1, 0) * max(rect.w - rect.y + 1, 0); }

// By all invocations of a workgroup; `live`: whether this one has a sphere.
void spread(bool live, vec3 center, float radius) {
  if (gl_LocalInvocationIndex == 0u) large_count = 0u;
  barrier();
  if (live) {
    const ivec4 rect = sampleRect(center, radius);
    if (areaOf(rect) > kOwnSamples) {
      const uint slot = atomicAdd(large_count, 1u);
      large_sphere[slot] = vec4(center, radius);
      large_owner[slot] = gl_LocalInvocationIndex;
    } else {
      for (int y = rect.y; y <= rect.w; ++y)
        for (int x = rect.x; x <= rect.z; ++x) visit(center, radius, ivec2(x, y));
      visitedAll(gl_LocalInvocationIndex);
    }
  }
  barrier();
  int left = kMaxVisits;
  for (uint k = 0u; k < large_count; ++k) {
    const vec4 sphere = large_sphere[k];
    const ivec4 rect = sampleRect(sphere.xyz, sphere.w);
    const int area = areaOf(rect), width = rect.z - rect.x + 1, each = (area + int(kSurfaceGroup) - 1) / int(kSurfaceGroup);
    left -= each;
    if (left >= 0) {
      for (int i = int(gl_LocalInvocationIndex); i < area; i += int(kSurfaceGroup))
        visit(sphere.xyz, sphere.w, rect.xy + ivec2(i % width, i / width));
      visitedAll(large_owner[k]);
    } else if (gl_LocalInvocationIndex == 0u) {
      atomicAdd(counters[kBoundHits], 1u);
    }
  }
  barrier();
}
