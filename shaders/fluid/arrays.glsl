// Bindings 2 to 5: the particles gathered from, the neighbour list, its counts and the cell keys.
#ifndef RILL_ARRAYS_GLSL
#define RILL_ARRAYS_GLSL
#ifdef TEXEL
layout(binding = 2) uniform samplerBuffer particleArray;
layout(binding = 3) uniform usamplerBuffer listArray;
layout(binding = 4) uniform usamplerBuffer countArray;
layout(binding = 5) uniform usamplerBuffer keyArray;
#define PARTICLE(j) texelFetch(particleArray, int(j))
#define LIST_AT(j) texelFetch(listArray, int(j))
#define COUNT_OF(j) texelFetch(countArray, int(j)).x
#define KEY_OF(j) texelFetch(keyArray, int(j)).x
#else
layout(std430, binding = 2) readonly buffer ParticleBlock { vec4 particleArray[]; };
layout(std430, binding = 3) readonly buffer ListBlock { uvec4 listArray[]; };
layout(std430, binding = 4) readonly buffer CountBlock { uint countArray[]; };
layout(std430, binding = 5) readonly buffer KeyBlock { uint keyArray[]; };
#define PARTICLE(j) particleArray[j]
#define LIST_AT(j) listArray[j]
#define COUNT_OF(j) countArray[j]
#define KEY_OF(j) keyArray[j]
#endif
#endif
