// The kernel of particles: meshKernel(), meshKernelSlope() and meshDistance() of engine/reference/surface_mesh.hpp.
const float kPi = 3.14159265;
float meshKernel(float r) { return r >= 1.5 ? 0.0 : r <= 0.5 ? 1.0 / kPi : (1.5 - r) / (2.0 * kPi * r); }
float meshKernelSlope(float r) { return r <= 0.5 || r >= 1.5 ? 0.0 : -1.5 / (2.0 * kPi * r * r); }
float meshDistance(float sum) { return sum < 0.5 ? 1.0 - sqrt(2.0 * sum) : sum >= 1.0 ? -1.0 : sqrt(2.0 - 2.0 * sum) - 1.0; }
