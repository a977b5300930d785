// visitSphere() calls beginVisit(), visitSample() for each sample that an invocation's sphere may cover, then endVisit(). Large spheres are
// shared by the workgroup: lavapipe ends a loop after 65,535 iterations. Define the functions before including; needs `counters`.

const int kOwnSamples = 1024;   // samples of a sphere that one invocation visits by itself
const int kMaxVisits = 60000;  // samples per invocation over all large spheres of its workgroup

shared vec4 large_sphere[kSurfaceGroup];
shared uint large_owner[kSurfaceGroup];
shared uint large_count;

int areaOf(ivec4 rect) { return max(rect.z - rect.x + 1, 0) * max(rect.w - rect.y + 1, 0); }

// Called by all invocations of a workgroup; `live`: whether this one has a sphere.
void visitSphere(bool live, vec3 center, float radius) {
  if (gl_LocalInvocationIndex == 0u) large_count = 0u;
  barrier();
  if (live) {
    const ivec4 rect = sampleRect(center, radius);
    if (areaOf(rect) > kOwnSamples) {
      const uint slot = atomicAdd(large_count, 1u);
      large_sphere[slot] = vec4(center, radius);
      large_owner[slot] = gl_LocalInvocationIndex;
    } else {
      beginVisit(gl_LocalInvocationIndex);
      for (int y = rect.y; y <= rect.w; ++y)
        for (int x = rect.x; x <= rect.z; ++x) visitSample(center, radius, ivec2(x, y));
      endVisit(gl_LocalInvocationIndex);
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
      beginVisit(large_owner[k]);
      for (int i = int(gl_LocalInvocationIndex); i < area; i += int(kSurfaceGroup))
        visitSample(sphere.xyz, sphere.w, rect.xy + ivec2(i % width, i / width));
      endVisit(large_owner[k]);
    } else if (gl_LocalInvocationIndex == 0u) {
      atomicAdd(counters[kBoundHits], 1u);
    }
  }
  barrier();
}
