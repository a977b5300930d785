// Depth of the scene without the fluid, from a copy of the depth target. SCENE_DEPTH: its binding. Needs surface.glsl.
#include "shared/arrays.glsl"
READ_FLOAT(SCENE_DEPTH, scene_depth)

// In m, of a pixel.
float sceneDepth(uint pixel) { return depthOfTarget(scene_depthAt(pixel)); }
float sceneDepth(uvec2 pixel) { return sceneDepth(pixel.y * view.width + pixel.x); }
