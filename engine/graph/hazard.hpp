#pragma once
// What has happened to one resource so far, and which barrier its next use needs. Knows no graph.
//
// Barriers are global memory barriers, so one that is recorded for a resource serves every other whose last writer it
// covers: passed() tells the others, and they then need none of their own.
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

/// Bits of the uses that a barrier with this target makes a write visible to.
uint32_t usesSeeing(const Scope& scope);

enum class Hazard : uint8_t { None, ReadAfterWrite, WriteAfterRead, WriteAfterWrite };
const char* hazardName(Hazard hazard);

class HazardState {
 public:
  static HazardState nothing() { return {}; }
  /// After `last`, done before this graph by someone else.
  static HazardState after(const UseRow& last);
  /// A transient's memory at the start of a frame: whatever the frame before did to it, draws included where there may have been any.
  static HazardState seam(bool draws);

  /// Adds to `scope` what must be waited for before `use`; `keep`: a write that also needs the old content.
  Hazard need(const UseRow& row, bool keep, Scope& scope) const;
  /// A barrier was recorded, here or for another resource. `seeing` is usesSeeing(scope).
  void passed(const Scope& scope, uint32_t seeing);
  void used(Use use);
  /// An image changes its layout before `use`, in a barrier of its own: `scope` gets what that must wait for and who sees it.
  void changeLayout(const UseRow& row, Scope& scope);
  /// The memory was another resource's before: this one must wait for what happened to both.
  void join(const HazardState& other);

 private:
  VkPipelineStageFlags2 writeStage_ = 0;
  VkAccessFlags2 writeAccess_ = 0;
  VkPipelineStageFlags2 readStage_ = 0;    ///< of the reads since the last write
  VkPipelineStageFlags2 readsBefore_ = 0;  ///< stages that already wait for all of these reads
  VkPipelineStageFlags2 writeBefore_ = 0;  ///< stages that already wait for the last write, directly or through other stages
  uint32_t visible_ = 0;                   ///< bits of the uses that see the last write
  bool available_ = false;                 ///< some barrier has waited for the last write
  bool atomic_ = false;                    ///< the last write was ComputeAtomic
  bool reused_ = false;                    ///< the memory was another resource's: of its bytes some were written and never read
};

}  // namespace rill
