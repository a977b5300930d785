#include "graph/hazard.hpp"

#include <initializer_list>

namespace rill {
namespace {

bool stagesCover(VkPipelineStageFlags2 have, VkPipelineStageFlags2 need) {
  if (have & VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT) have |= ~VkPipelineStageFlags2(VK_PIPELINE_STAGE_2_HOST_BIT);
  return (need & ~have) == 0;
}

bool accessesCover(VkAccessFlags2 have, VkAccessFlags2 need) {
  constexpr VkAccessFlags2 anyWrite = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT |
                                      VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT |
                                      VK_ACCESS_2_MEMORY_WRITE_BIT;
  if (have & VK_ACCESS_2_MEMORY_WRITE_BIT) have |= anyWrite;
  if (have & VK_ACCESS_2_MEMORY_READ_BIT) have |= ~anyWrite;
  return (need & ~have) == 0;
}

/// The bit of the read use that a read-write use implies.
uint32_t readPart(Use use) { return use == Use::ComputeWrite || use == Use::ComputeAtomic ? useBit(Use::ComputeRead) : 0; }

}  // namespace

uint32_t usesMadeVisible(const Scope& scope) {
  uint32_t bits = 0;
  for (size_t i = 1; i < kUseCount; ++i) {
    const UseRow& row = useRow(Use(i));
    if (stagesCover(scope.targetStage, row.stage) && accessesCover(scope.targetAccess, row.read | row.write)) bits |= useBit(row.use);
  }
  return bits;
}

const char* hazardName(Hazard hazard) {
  switch (hazard) {
    case Hazard::None:
      return "none";
    case Hazard::ReadAfterWrite:
      return "read after write";
    case Hazard::WriteAfterRead:
      return "write after read";
    case Hazard::WriteAfterWrite:
      return "write after write";
  }
  return "";
}

HazardState HazardState::after(const UseRow& row) {
  HazardState state;
  if (!row.stage) return state;
  if (row.use == Use::Unknown) {
    state.writeStage_ = state.readStage_ = row.stage;
    state.writeAccess_ = row.write;
  } else if (row.use == Use::HostRead) {  // the host has finished, but the writes are visible only to the host
    state.writeStage_ = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    state.writeAccess_ = VK_ACCESS_2_MEMORY_WRITE_BIT;
    state.visible_ = useBit(row.use);
  } else if (row.write) {
    state.writeStage_ = row.stage;
    state.writeAccess_ = row.write;
    state.atomic_ = row.use == Use::ComputeAtomic;
  } else {  // the read has seen the earlier write, so waiting for the read is enough
    state.writeStage_ = state.readStage_ = row.stage;
    state.writeAccess_ = VK_ACCESS_2_MEMORY_WRITE_BIT;
    state.visible_ = useBit(row.use);
    state.stagesAfterWrite_ = row.stage;
    state.available_ = true;
  }
  return state;
}

HazardState HazardState::previousFrame(bool usesGraphics) {
  HazardState state;
  const auto wrote = [&](Use use) {
    state.writeStage_ |= useRow(use).stage;
    state.writeAccess_ |= useRow(use).write;
  };
  for (Use use : {Use::ComputeWrite, Use::CopyTarget}) wrote(use);
  for (Use use : {Use::ComputeRead, Use::Indirect, Use::CopySource}) state.readStage_ |= useRow(use).stage;
  if (usesGraphics) {
    for (Use use : {Use::ColorTarget, Use::DepthTarget}) wrote(use);
    state.readStage_ |= useRow(Use::DrawRead).stage | useRow(Use::VertexInput).stage;
  }
  return state;
}

Hazard HazardState::addDependency(const UseRow& row, bool keep, Scope& scope) const {
  const bool isVisible = (visible_ & useBit(row.use)) != 0;
  if (!row.write) {
    if (!writeStage_ || isVisible) return Hazard::None;
    scope.sourceStage |= writeStage_;
    scope.sourceAccess |= writeAccess_;
    scope.targetStage |= row.stage;
    scope.targetAccess |= row.read;
    return Hazard::ReadAfterWrite;
  }
  if (atomic_ && row.use == Use::ComputeAtomic && !readStage_) return Hazard::None;
  // If the reads waited for the last write, an execution dependency on them is enough, unless this use also
  // reads and the last write is not visible to it.
  const bool reads = keep && row.read != 0;
  const bool seesOldContent = isVisible || (visible_ & readPart(row.use)) != 0;
  const bool waitForReads = readStage_ && !stagesCover(stagesAfterReads_, row.stage);
  const bool ordered = available_ && (stagesCover(stagesAfterWrite_, row.stage) || (waitForReads && (readStage_ & stagesAfterWrite_)));
  const bool waitForWrite = writeStage_ && !isVisible && (aliased_ || !ordered || (reads && !seesOldContent));
  if (!waitForWrite && !waitForReads) return Hazard::None;
  scope.targetStage |= row.stage;
  if (waitForReads) scope.sourceStage |= readStage_;
  if (!waitForWrite) return Hazard::WriteAfterRead;
  scope.sourceStage |= writeStage_;
  scope.sourceAccess |= writeAccess_;
  scope.targetAccess |= row.read | row.write;
  return Hazard::WriteAfterWrite;
}

void HazardState::applyBarrier(const Scope& scope, uint32_t visibleUses) {
  if (writeStage_ && stagesCover(scope.sourceStage, writeStage_) && accessesCover(scope.sourceAccess, writeAccess_)) {
    available_ = true;
    visible_ |= visibleUses;
    stagesAfterWrite_ |= scope.targetStage;
  } else if (available_ && (scope.sourceStage & stagesAfterWrite_)) {
    stagesAfterWrite_ |= scope.targetStage;
  }
  if (readStage_ && stagesCover(scope.sourceStage, readStage_)) stagesAfterReads_ |= scope.targetStage;
}

void HazardState::applyUse(Use use) {
  const UseRow& row = useRow(use);
  if (!row.write) {
    readStage_ |= row.stage;
    stagesAfterReads_ = 0;
    return;
  }
  writeStage_ = row.stage;
  writeAccess_ = row.write;
  readStage_ = stagesAfterReads_ = stagesAfterWrite_ = 0;
  visible_ = 0;
  available_ = false;
  atomic_ = use == Use::ComputeAtomic;
  aliased_ = false;
}

void HazardState::changeLayout(const UseRow& row, Scope& scope) {
  scope = {writeStage_ | readStage_, writeAccess_, row.stage, row.read | row.write};
  // From here on the transition counts as a write in the stage that waits for it.
  *this = {};
  writeStage_ = stagesAfterWrite_ = row.stage;
  writeAccess_ = VK_ACCESS_2_MEMORY_WRITE_BIT;
  visible_ = usesMadeVisible(scope);
  available_ = true;
}

void HazardState::merge(const HazardState& other) {
  if (!other.writeStage_ && !other.readStage_) return;
  if (!writeStage_ && !readStage_) {
    *this = other;
    atomic_ = false;  // another resource's atomics do not commute with this one's
    aliased_ = true;
    return;
  }
  constexpr VkPipelineStageFlags2 all = ~VkPipelineStageFlags2(0);
  stagesAfterReads_ = (readStage_ ? stagesAfterReads_ : all) & (other.readStage_ ? other.stagesAfterReads_ : all);
  stagesAfterWrite_ = (writeStage_ ? stagesAfterWrite_ : all) & (other.writeStage_ ? other.stagesAfterWrite_ : all);
  writeStage_ |= other.writeStage_;
  writeAccess_ |= other.writeAccess_;
  readStage_ |= other.readStage_;
  visible_ &= other.visible_;
  available_ = available_ && other.available_;
  atomic_ = false;
  aliased_ = true;
}

}  // namespace rill
