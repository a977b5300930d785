#version 460
// Adds up the partial sums of measure.comp in a fixed order and reads the percentiles off the histograms. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
layout(local_size_x = 256) in;
layout(std430, binding = 2) readonly buffer PartialBlock { MeasurePartial partials[]; };
layout(std430, binding = 3) readonly buffer HistogramBlock { uint histogram[]; };
layout(std430, binding = 4) writeonly buffer ResultBlock { MeasureResult result; };

shared MeasurePartial rows[256];
shared uint before[256];
shared float found;

// The middle of a bin.
float binValue(uint bin) { return 0.5 * (uintBitsToFloat((bin + kMeasureFirst) << 14) + uintBitsToFloat((bin + kMeasureFirst + 1u) << 14)); }

// A line of bins: the compression histogram from small to large, or the signed one from far below to far above.
const uint kSignedBins = 2u * kMeasureBins;
uint countAt(bool signed_, uint place) {
  if (!signed_) return histogram[place];
  return place < kMeasureBins ? histogram[2u * kMeasureBins + (kMeasureBins - 1u - place)] : histogram[place];
}
float valueAt(bool signed_, uint place) {
  if (!signed_) return binValue(place);
  return place < kMeasureBins ? -binValue(kMeasureBins - 1u - place) : binValue(place - kMeasureBins);
}

// The value at which `rank` entries of the line, and `below` that are in no bin before it, are not yet exceeded.
float percentile(bool signed_, uint rank, uint below) {
  uint lane = gl_LocalInvocationID.x;
  uint bins = signed_ ? kSignedBins : kMeasureBins;
  uint each = (bins + 255u) / 256u;
  uint sum = 0u;
  for (uint k = lane * each; k < min((lane + 1u) * each, bins); ++k) sum += countAt(signed_, k);
  before[lane] = sum;
  if (lane == 0u) found = 0.0;
  barrier();
  if (lane == 0u) {
    uint run = below;
    for (uint k = 0u; k < 256u; ++k) {
      uint own = before[k];
      before[k] = run;
      run += own;
    }
  }
  barrier();
  uint run = before[lane];
  if (run < rank && run + sum >= rank) {
    for (uint k = lane * each; k < min((lane + 1u) * each, bins); ++k) {
      run += countAt(signed_, k);
      if (run >= rank) {
        found = valueAt(signed_, k);
        break;
      }
    }
  }
  barrier();
  float value = found;
  barrier();
  return value;
}

MeasurePartial add(MeasurePartial a, MeasurePartial b) {
  return MeasurePartial(a.compression + b.compression, max(a.compressionMax, b.compressionMax), a.kinetic + b.kinetic, max(a.speedMax, b.speedMax),
                        a.velocityX + b.velocityX, a.velocityY + b.velocityY, a.velocityZ + b.velocityZ, a.positionX + b.positionX,
                        a.positionY + b.positionY, a.positionZ + b.positionZ, a.outside + b.outside, a.counted + b.counted, a.parked + b.parked);
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  uint groups = (params.count + kMeasureGroup - 1u) / kMeasureGroup;
  MeasurePartial mine = MeasurePartial(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0u, 0u, 0u);
  for (uint k = lane; k < groups; k += 256u) mine = add(mine, partials[k]);
  rows[lane] = mine;
  for (uint half_ = 128u; half_ > 0u; half_ /= 2u) {
    barrier();
    if (lane < half_) rows[lane] = add(rows[lane], rows[lane + half_]);
  }
  barrier();
  MeasurePartial all_ = rows[0];
  // Particles that are not compressed are in no bin: they come first. The histogram holds the others.
  uint compressed = 0u;
  uint each = (kMeasureBins + 255u) / 256u;
  for (uint k = lane * each; k < min((lane + 1u) * each, kMeasureBins); ++k) compressed += histogram[k];
  before[lane] = compressed;
  barrier();
  uint sum = 0u;
  for (uint k = 0u; k < 256u; ++k) sum += before[k];
  barrier();
  uint present = params.count - all_.parked;
  float p99 = percentile(false, (present * 99u + 99u) / 100u, present - sum);
  float median = percentile(true, (all_.counted + 1u) / 2u, 0u);
  if (lane == 0u) {
    result.sums = all_;
    result.compression99 = p99;
    result.signedMedian = median;
  }
}
