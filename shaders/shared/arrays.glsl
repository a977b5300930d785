// Read-only arrays: READ_FLOAT4(binding, particle) declares particleAt(k). With TEXEL they are uniform texel
// buffers (faster on lavapipe: docs/notes/lavapipe.md), else storage buffers, for devices with small texel limits.
#ifndef RILL_ARRAYS_GLSL
#define RILL_ARRAYS_GLSL
#ifdef TEXEL
#define RILL_TEXELS(BINDING, NAME, SAMPLER) layout(set = 0, binding = BINDING) uniform SAMPLER NAME##Texels;
#define READ_FLOAT4(BINDING, NAME) RILL_TEXELS(BINDING, NAME, samplerBuffer) \
  vec4 NAME##At(uint k) { return texelFetch(NAME##Texels, int(k)); }
#define READ_UINT(BINDING, NAME) RILL_TEXELS(BINDING, NAME, usamplerBuffer) \
  uint NAME##At(uint k) { return texelFetch(NAME##Texels, int(k)).x; }
#define READ_UINT4(BINDING, NAME) layout(set = 0, binding = BINDING) uniform usamplerBuffer NAME##Texels4; \
  uvec4 NAME##At(uint k) { return texelFetch(NAME##Texels4, int(k)); }
#define READ_UINT2(BINDING, NAME) layout(set = 0, binding = BINDING) uniform usamplerBuffer NAME##Texels2; \
  uvec2 NAME##At(uint k) { return texelFetch(NAME##Texels2, int(k)).xy; }
#define READ_FLOAT(BINDING, NAME) RILL_TEXELS(BINDING, NAME, usamplerBuffer) \
  float NAME##At(uint k) { return uintBitsToFloat(texelFetch(NAME##Texels, int(k)).x); }
#else
#define RILL_STORAGE(BINDING, NAME, TYPE) layout(std430, set = 0, binding = BINDING) readonly buffer NAME##Block { TYPE NAME##Array[]; }; \
  TYPE NAME##At(uint k) { return NAME##Array[k]; }
#define READ_FLOAT4(BINDING, NAME) RILL_STORAGE(BINDING, NAME, vec4)
#define READ_UINT(BINDING, NAME) RILL_STORAGE(BINDING, NAME, uint)
#define READ_UINT2(BINDING, NAME) RILL_STORAGE(BINDING, NAME, uvec2)
#define READ_UINT4(BINDING, NAME) RILL_STORAGE(BINDING, NAME, uvec4)
#define READ_FLOAT(BINDING, NAME) RILL_STORAGE(BINDING, NAME, float)
#endif
#endif
