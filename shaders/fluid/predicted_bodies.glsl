// Stores the predicted pose of a body and what follows from it. Needs the storage arrays `bodies` and `solids`.
#ifndef RILL_PREDICTED_BODIES_GLSL
#define RILL_PREDICTED_BODIES_GLSL
#include "fluid/bodies.glsl"

void storePrediction(uint n, BodyRecord b, PoseRecord s) {
  mat3 inverted = inverseInertiaAt(b, rotationOf(s));
  bodies[n].predicted = s;
  bodies[n].inverseXX = inverted[0].x;
  bodies[n].inverseYY = inverted[1].y;
  bodies[n].inverseZZ = inverted[2].z;
  bodies[n].inverseYZ = inverted[1].z;
  bodies[n].inverseZX = inverted[2].x;
  bodies[n].inverseXY = inverted[0].y;
  solids[b.solid].pose = solidPose(b, s);
}
#endif
