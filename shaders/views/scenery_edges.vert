#version 460
// The domain's edges, or LINES of a buffer, as lines of constant width.
#extension GL_GOOGLE_include_directive : require
#ifdef LINES
#define RILL_PUSH_MORE float time;
#endif
#include "render/surface.glsl"
#include "views/particle_records.h"

#ifdef LINES
layout(std430, set = 0, binding = 0) readonly buffer Lines { LineRecord lines[]; };
layout(std430, set = 0, binding = 1) readonly buffer Keyframes { KeyframeRecord keyframes[]; };
#include "shared/keyframes.glsl"
#else
layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
#endif
layout(location = 0) out float across;  // pixels from the line's middle
layout(location = 1) flat out float half_width;

#ifdef LINES
void lineEnds(out vec3 a, out vec3 b) {
  const LineRecord line = lines[gl_InstanceIndex];
  const PoseRecord base = poseOf(vec3(line.centerX, line.centerY, line.centerZ), vec4(0.0, 0.0, 0.0, 1.0), vec3(0.0), vec3(0.0));
  const PoseRecord pose = keyframedPose(base, line.firstKey, line.keyCount, time);
  a = centerOf(pose) + toScene(pose, vec3(line.fromX, line.fromY, line.fromZ));
  b = centerOf(pose) + toScene(pose, vec3(line.toX, line.toY, line.toZ));
}
#else
void lineEnds(out vec3 a, out vec3 b) {
  const int axis = gl_InstanceIndex / 4, which = gl_InstanceIndex % 4;
  vec3 low = vec3(0.0), high = vec3(0.0);
  const vec3 choice = axis == 0 ? vec3(0.0, which & 1, which >> 1)
                                : (axis == 1 ? vec3(which & 1, 0.0, which >> 1) : vec3(which & 1, which >> 1, 0.0));
  low = choice;
  high = choice + (axis == 0 ? vec3(1.0, 0.0, 0.0) : (axis == 1 ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0)));
  a = mix(scene.domain_min.xyz, scene.domain_max.xyz, low);
  b = mix(scene.domain_min.xyz, scene.domain_max.xyz, high);
}
#endif

void main() {
  vec3 a, b;
  lineEnds(a, b);
  a = viewPoint(a);
  b = viewPoint(b);
  // The part in front of the eye.
  const float near = max(view.near_depth, 1e-3 * abs(b.z - a.z));
  if (a.z < near && b.z < near) {
    gl_Position = vec4(0.0, 0.0, -1.0, 1.0);
    return;
  }
  if (a.z < near) a = mix(a, b, (near - a.z) / (b.z - a.z));
  if (b.z < near) b = mix(b, a, (near - b.z) / (a.z - b.z));
  const vec2 from = pixelOf(a), to = pixelOf(b);
  const vec2 along = length(to - from) > 1e-3 ? normalize(to - from) : vec2(1.0, 0.0);
  const int n = gl_VertexIndex;
  const int corner = n < 3 ? n : (n == 3 ? 2 : (n == 4 ? 1 : 3));
  half_width = max(0.55, float(view.height) / 1400.0);
  across = (half_width + 1.0) * ((corner & 1) == 0 ? -1.0 : 1.0);
  const vec3 end = (corner & 2) == 0 ? a : b;
  const vec4 clip = clipPoint(end);
  gl_Position = clip + vec4(vec2(-along.y, along.x) * across / pictureSize() * 2.0 * clip.w, 0.0, 0.0);
}
