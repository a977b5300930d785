// The last grid of the thickness's buffer in front of a scene: sums of lengths (counts) times depths, in front of what they belong to.
// A sum fits into a word where thickness times depth is below kMaxDepthSum.
const float kDepthCounts = 4.0;        // per spacing
const float kMaxDepthSum = 1048576.0;  // spacings squared, of 1024 counts of length per spacing

uint depthCounts(float z, float spacing) { return uint(z * (kDepthCounts / spacing) + 0.5); }
uint depthGrid(uint fluids) { return fluids > 1u ? 2u * fluids : 1u; }
// Mean depth, m, of `sum` over `counts`.
float meanDepth(float sum, float counts, float spacing) { return sum / max(counts, 1.0) * (spacing / kDepthCounts); }
