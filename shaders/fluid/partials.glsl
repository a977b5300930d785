// Adding up the figures of several sets of particles.
#ifndef RILL_PARTIALS_GLSL
#define RILL_PARTIALS_GLSL
// Workgroups that add up: few, since the end of each, in shared memory, costs lavapipe 23 us.
uint partialCount() { return min((control.count + kMeasureShare * kFluidGroup - 1u) / (kMeasureShare * kFluidGroup), kMeasurePartials); }

MeasurePartial addPartials(MeasurePartial a, MeasurePartial b) {
  return MeasurePartial(a.compression + b.compression, max(a.compressionMax, b.compressionMax),
                        max(a.speedMax, b.speedMax), a.mass + b.mass, a.kinetic + b.kinetic,
                        a.velocityX + b.velocityX, a.velocityY + b.velocityY, a.velocityZ + b.velocityZ, a.positionX + b.positionX,
                        a.positionY + b.positionY, a.positionZ + b.positionZ, a.outside + b.outside, a.inactive + b.inactive);
}
#endif
