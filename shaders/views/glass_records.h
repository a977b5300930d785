// Faces of a glass tank, which shaders share with C++. Lengths in m, relative to the scene's origin.
#ifndef RILL_VIEWS_GLASS_RECORDS_H
#define RILL_VIEWS_GLASS_RECORDS_H

#ifdef __cplusplus
namespace rill {
#endif

struct GlassQuad {
  float cornerX, cornerY, cornerZ;
  float edge;                    // 1: the edge of a pane, 0: its face
  float firstX, firstY, firstZ;  // a side of the quad
  float secondX, secondY, secondZ;  // the other side
  float outwardX, outwardY, outwardZ;  // normal of the pane, away from the domain
};

#ifdef __cplusplus
}  // namespace rill
#endif
#endif
