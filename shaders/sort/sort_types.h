// Constants and push constants of the sort and scan shaders, shared by C++ and GLSL.
#ifndef RILL_SORT_TYPES_H
#define RILL_SORT_TYPES_H
#include "shared/interop.h"
RILL_RECORDS_BEGIN

// Scan: a workgroup handles a tile of kScanThreads * kScanItems values, loaded and stored four at a time.
RILL_CONST uint kScanThreads = 128u;
RILL_CONST uint kScanItems = 16u;
RILL_CONST uint kScanTile = kScanThreads * kScanItems;
RILL_CONST uint kScanSums = 1024u;  // up to this many tiles, every workgroup sums the previous tiles itself

struct ScanPush {
  uint count;  // values
};

RILL_CONST uint kNoKey = 0xffffffffu;  // in place of a key: this index has none, and none has it with a larger index

// Counting sort.
RILL_CONST uint kCountThreads = 256u;
RILL_CONST uint kClearItems = 4u;  // uvec4s of counters that one invocation clears
// In bins up to this size an index finds its slot by reading the whole bin; sort/order_oversized handles larger bins.
RILL_CONST uint kBinLimit = 512u;
// A workgroup of sort/order_oversized sorts a chunk of indices at a time, one bit per index in 8 KiB of shared memory.
RILL_CONST uint kChunkWords = 2048u;
RILL_CONST uint kChunkIndices = 32u * kChunkWords;
RILL_CONST uint kOversizedGroups = 16u;  // maximum per chunk

struct CountingPush {
  uint count;      // keys
  uint lastKey;    // largest key; larger ones are clamped to it, so that invalid keys never write out of bounds
  uint chunks;     // number of chunks of kChunkIndices indices
  uint binGroups;  // workgroups per chunk that share the oversized bins
};

// Radix sort: an invocation handles kRadixKeys consecutive keys, a workgroup one tile, with one invocation per digit value.
RILL_CONST uint kRadixBits = 6u;  // maximum bits per pass
RILL_CONST uint kRadixThreads = 64u;
RILL_CONST uint kRadixKeys = 64u;
RILL_CONST uint kRadixTile = kRadixThreads * kRadixKeys;

struct RadixPush {
  uint count;    // keys
  uint tiles;    // workgroups
  uint shift;    // bit offset of this pass's digit
  uint digits;   // number of digit values: a power of two, 2 .. 64
};

struct StartPush {
  uint count;  // keys
  uint range;  // entries of `start` minus one
};

RILL_RECORDS_END
#endif
