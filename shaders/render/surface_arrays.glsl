// What a look at the surface walks over, at bindings 0 and 1: the cells of the screen grid and the centres of surface particles. With TEXEL they are
// uniform texel buffers, which lavapipe does not load lane by lane.
#ifdef TEXEL
layout(set = 0, binding = 0) uniform usamplerBuffer start;
layout(set = 0, binding = 1) uniform samplerBuffer centre;
#define START(k) texelFetch(start, int(k)).x
#define CENTRE(j) texelFetch(centre, int(j)).xyz
#else
layout(std430, set = 0, binding = 0) readonly buffer Start { uint start[]; };
layout(std430, set = 0, binding = 1) readonly buffer Centre { vec4 centre[]; };
#define START(k) start[k]
#define CENTRE(j) centre[j].xyz
#endif
