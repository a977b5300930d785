#version 460
#extension GL_GOOGLE_include_directive : require
#include "cloud.h"
#include "shared/dispatch.glsl"
layout(local_size_x = kCloudGroup) in;
layout(push_constant) uniform PushBlock { CloudPush push; };
layout(binding = 0, std430) readonly buffer Positions { vec4 position[]; };
layout(binding = 1, std430) readonly buffer Order { uint order[]; };
layout(binding = 2, std430) writeonly buffer Sorted { vec4 sorted[]; };

void main() {
  const uint i = flatInvocation();
  if (i < push.count) sorted[i] = position[order[i]];
}
