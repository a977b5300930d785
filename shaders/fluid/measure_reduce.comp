#version 460
// Adds up the partial sums of measure_sums.comp in a fixed order and reads the percentiles off the
// histograms of measure.comp. One workgroup.
#extension GL_GOOGLE_include_directive : require
#include "fluid/uniforms.glsl"
#include "fluid/partials.glsl"
layout(local_size_x = 256) in;
layout(std430, binding = 2) readonly buffer PartialBlock { MeasurePartial partials[]; };
layout(std430, binding = 3) readonly buffer HistogramBlock { uint histogram[]; };
layout(std430, binding = 4) writeonly buffer ResultBlock { MeasureResult figures; };

shared MeasurePartial rows[kMeasurePartials];
shared uint before[256];
shared uint rank;
shared float found;

// The middle of a bin.
float binValue(uint bin) {
  return 0.5 * (uintBitsToFloat((bin + kMeasureFirst) << 14) + uintBitsToFloat((bin + kMeasureFirst + 1u) << 14));
}

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

// The 99th percentile of compression over active particles (those not compressed are in no bin and
// come first), or the median of the signed error.
float percentile(bool signed_, uint present) {
  uint lane = gl_LocalInvocationID.x;
  uint bins = signed_ ? kSignedBins : kMeasureBins;
  uint each = (bins + 255u) / 256u;
  uint sum = 0u;
  for (uint k = lane * each; k < min((lane + 1u) * each, bins); ++k) sum += countAt(signed_, k);
  before[lane] = sum;
  barrier();
  if (lane == 0u) {
    uint run = 0u;
    for (uint k = 0u; k < 256u; ++k) {
      uint own = before[k];
      before[k] = run;
      run += own;
    }
    uint below = signed_ ? 0u : present - run;
    uint wanted = signed_ ? (run + 1u) / 2u : (present * 99u + 99u) / 100u;
    rank = wanted > below ? wanted - below : 0u;  // among those in bins
    found = 0.0;
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
  return found;
}

void main() {
  uint lane = gl_LocalInvocationID.x;
  if (lane < kMeasurePartials) {
    if (lane < partialCount()) rows[lane] = partials[lane];
    else rows[lane] = MeasurePartial(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0u, 0u);
  }
  barrier();
  for (uint half_ = kMeasurePartials / 2u; half_ > 0u; half_ /= 2u) {
    if (lane < half_) rows[lane] = addPartials(rows[lane], rows[lane + half_]);
    barrier();
  }
  float p99 = percentile(false, control.count - rows[0].inactive);
  barrier();
  float median = percentile(true, 0u);
  if (lane == 0u) {
    figures.sums = rows[0];
    figures.compression99 = p99;
    figures.signedMedian = median;
  }
}
