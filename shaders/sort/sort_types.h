// Constants and push constants of the sort's and the scan's shaders, for C++ and GLSL.
#ifndef RILL_SORT_TYPES_H
#define RILL_SORT_TYPES_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// Scan: a workgroup takes a tile of kScanThreads * kScanItems values, which are loaded and stored four at a time.
RILL_CONST uint kScanThreads = 128u;
RILL_CONST uint kScanItems = 16u;
RILL_CONST uint kScanTile = kScanThreads * kScanItems;
RILL_CONST uint kScanSums = 1024u;  // tiles, at most, whose sums every workgroup adds up for itself

struct ScanPush {
  uint count;  // values
};

// Counting sort.
RILL_CONST uint kCountThreads = 256u;
RILL_CONST uint kClearItems = 4u;  // fours of counters that one invocation clears
// A particle of a bin of up to so many finds its place by reading the whole bin; larger ones go to sort/order_oversized.
RILL_CONST uint kBinLimit = 512u;
// Indices that a workgroup of sort/order_oversized sorts at a time, as one bit each in 8 KiB of shared memory.
RILL_CONST uint kChunkWords = 2048u;
RILL_CONST uint kChunkIndices = 32u * kChunkWords;
RILL_CONST uint kOversizedGroups = 16u;  // a chunk, at most

struct CountingPush {
  uint count;      // keys
  uint lastKey;    // largest key; a larger one is taken for it, so that a stray key writes nowhere else
  uint chunks;     // of kChunkIndices indices
  uint binGroups;  // workgroups a chunk that share the oversized bins
};

// Radix sort: an invocation takes kRadixKeys consecutive keys, a workgroup a tile. There are as many invocations as digits.
RILL_CONST uint kRadixBits = 6u;  // most bits of one pass
RILL_CONST uint kRadixThreads = 64u;
RILL_CONST uint kRadixKeys = 64u;
RILL_CONST uint kRadixTile = kRadixThreads * kRadixKeys;

struct RadixPush {
  uint count;    // keys
  uint tiles;    // workgroups
  uint shift;    // of this pass's digit
  uint digits;   // values of a digit: a power of two, 2 .. 64
};

struct StartPush {
  uint count;  // keys
  uint range;  // entries of `start`, less one
};

RILL_RECORDS_END
#endif
