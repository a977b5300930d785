#pragma once
// Tracks the accesses to one resource and computes the barrier that its next use needs. Independent of the graph.
//
// Barriers are global memory barriers, so a barrier recorded for one resource also serves all others whose
// last writer it covers: applyBarrier() updates their states, and they need no barrier of their own.
#include "graph/use_table.hpp"

namespace rill {

struct Scope {
  VkPipelineStageFlags2 sourceStage = 0;
  VkAccessFlags2 sourceAccess = 0;
  VkPipelineStageFlags2 targetStage = 0;
  VkAccessFlags2 targetAccess = 0;
  bool empty() const { return targetStage == 0; }
  friend bool operator==(const Scope&, const Scope&) = default;
};

/// Bits of the uses to which a barrier with this target scope makes writes visible.
uint32_t usesMadeVisible(const Scope& scope);

enum class Hazard : uint8_t { None, ReadAfterWrite, WriteAfterRead, WriteAfterWrite };
const char* hazardName(Hazard hazard);

class HazardState {
 public:
  static HazardState untouched() { return {}; }
  /// The state after `last`, an access by the host or an earlier graph.
  static HazardState after(const UseRow& last);
  /// A transient's memory at the start of a frame: any access by the previous frame, including graphics
  /// stages if `usesGraphics`.
  static HazardState previousFrame(bool usesGraphics);

  /// Adds to `scope` the dependencies of the use `row`. `keep`: a write that also needs the old content.
  Hazard addDependency(const UseRow& row, bool keep, Scope& scope) const;
  /// Updates the state after a barrier recorded for any resource. `visibleUses` is usesMadeVisible(scope).
  void applyBarrier(const Scope& scope, uint32_t visibleUses);
  void applyUse(Use use);
  /// A layout transition before the use `row`, in an image barrier of its own, whose scope is returned in `scope`.
  void changeLayout(const UseRow& row, Scope& scope);
  /// Adds the state of a resource that used the same memory before: dependencies of both apply.
  void merge(const HazardState& other);

 private:
  VkPipelineStageFlags2 writeStage_ = 0;
  VkAccessFlags2 writeAccess_ = 0;
  VkPipelineStageFlags2 readStage_ = 0;         ///< of the reads since the last write
  VkPipelineStageFlags2 stagesAfterReads_ = 0;  ///< stages that already wait for all of these reads
  VkPipelineStageFlags2 stagesAfterWrite_ = 0;  ///< stages that already wait for the last write, directly or through other stages
  uint32_t visible_ = 0;                        ///< bits of the uses to which the last write is visible
  bool available_ = false;                      ///< a barrier has made the last write available
  bool atomic_ = false;                         ///< the last write was ComputeAtomic
  bool aliased_ = false;  ///< the memory belonged to another resource, which may have written bytes that were never read
};

}  // namespace rill
