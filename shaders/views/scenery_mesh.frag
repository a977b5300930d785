#version 460
// A mesh in the light of the scene.
#extension GL_GOOGLE_include_directive : require
#include "render/surface.glsl"
#include "views/particle_records.h"
#include "render/look_records.h"

layout(std140, set = 0, binding = 0) uniform Scene { SceneRecord scene; };
layout(std140, set = 0, binding = 1) uniform Look { LookRecord look; };
#include "views/scenery.glsl"
#include "views/scenery_lit.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) flat in vec3 base;
layout(location = 3) flat in uint colored;
layout(location = 0) out vec4 color;

void main() { color = vec4(litSolid(position, normalize(normal), colored != 0u ? base : kSolidAlbedo), 1.0); }
