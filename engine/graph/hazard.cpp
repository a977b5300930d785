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

/// What a write's reading half is, seen as a use of its own.
uint32_t readingHalf(Use use) { return use == Use::ComputeWrite || use == Use::ComputeAtomic ? useBit(Use::ComputeRead) : 0; }

}  // namespace

uint32_t usesSeeing(const Scope& scope) {
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
  } else if (row.use == Use::HostRead) {  // the host is done, but only it has seen the device's writes
    state.writeStage_ = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    state.writeAccess_ = VK_ACCESS_2_MEMORY_WRITE_BIT;
    state.visible_ = useBit(row.use);
  } else if (row.write) {
    state.writeStage_ = row.stage;
    state.writeAccess_ = row.write;
    state.atomic_ = row.use == Use::ComputeAtomic;
  } else {  // whoever wrote it, this read has seen it, and waiting for the read waits for the write
    state.writeStage_ = state.readStage_ = row.stage;
    state.writeAccess_ = VK_ACCESS_2_MEMORY_WRITE_BIT;
    state.visible_ = useBit(row.use);
    state.writeBefore_ = row.stage;
    state.available_ = true;
  }
  return state;
}

HazardState HazardState::seam(bool draws) {
  HazardState state;
  const auto wrote = [&](Use use) {
    state.writeStage_ |= useRow(use).stage;
    state.writeAccess_ |= useRow(use).write;
  };
  for (Use use : {Use::ComputeWrite, Use::CopyTarget}) wrote(use);
  for (Use use : {Use::ComputeRead, Use::Indirect, Use::CopySource}) state.readStage_ |= useRow(use).stage;
  if (draws) {
    for (Use use : {Use::ColorTarget, Use::DepthTarget}) wrote(use);
    state.readStage_ |= useRow(Use::DrawRead).stage | useRow(Use::VertexInput).stage;
  }
  return state;
}

Hazard HazardState::need(const UseRow& row, bool keep, Scope& scope) const {
  const bool sees = (visible_ & useBit(row.use)) != 0;
  if (!row.write) {
    if (!writeStage_ || sees) return Hazard::None;
    scope.sourceStage |= writeStage_;
    scope.sourceAccess |= writeAccess_;
    scope.targetStage |= row.stage;
    scope.targetAccess |= row.read;
    return Hazard::ReadAfterWrite;
  }
  if (atomic_ && row.use == Use::ComputeAtomic && !readStage_) return Hazard::None;
  // Where the reads have waited for the last write, waiting for them is waiting for it, and moves no memory:
  // unless this write also reads and has not seen it.
  const bool reads = keep && row.read != 0;
  const bool seesOld = sees || (visible_ & readingHalf(row.use)) != 0;
  const bool waitForReads = readStage_ && !stagesCover(readsBefore_, row.stage);
  const bool ordered = available_ && (stagesCover(writeBefore_, row.stage) || (waitForReads && (readStage_ & writeBefore_)));
  const bool waitForWrite = writeStage_ && !sees && (reused_ || !ordered || (reads && !seesOld));
  if (!waitForWrite && !waitForReads) return Hazard::None;
  scope.targetStage |= row.stage;
  if (waitForReads) scope.sourceStage |= readStage_;
  if (!waitForWrite) return Hazard::WriteAfterRead;
  scope.sourceStage |= writeStage_;
  scope.sourceAccess |= writeAccess_;
  scope.targetAccess |= row.read | row.write;
  return Hazard::WriteAfterWrite;
}

void HazardState::passed(const Scope& scope, uint32_t seeing) {
  if (writeStage_ && stagesCover(scope.sourceStage, writeStage_) && accessesCover(scope.sourceAccess, writeAccess_)) {
    available_ = true;
    visible_ |= seeing;
    writeBefore_ |= scope.targetStage;
  } else if (available_ && (scope.sourceStage & writeBefore_)) {
    writeBefore_ |= scope.targetStage;
  }
  if (readStage_ && stagesCover(scope.sourceStage, readStage_)) readsBefore_ |= scope.targetStage;
}

void HazardState::used(Use use) {
  const UseRow& row = useRow(use);
  if (!row.write) {
    readStage_ |= row.stage;
    readsBefore_ = 0;
    return;
  }
  writeStage_ = row.stage;
  writeAccess_ = row.write;
  readStage_ = readsBefore_ = writeBefore_ = 0;
  visible_ = 0;
  available_ = false;
  atomic_ = use == Use::ComputeAtomic;
  reused_ = false;
}

void HazardState::changeLayout(const UseRow& row, Scope& scope) {
  scope = {writeStage_ | readStage_, writeAccess_, row.stage, row.read | row.write};
  // From here on it is as if the change were a write in the stage that waits for it.
  *this = {};
  writeStage_ = writeBefore_ = row.stage;
  writeAccess_ = VK_ACCESS_2_MEMORY_WRITE_BIT;
  visible_ = usesSeeing(scope);
  available_ = true;
}

void HazardState::join(const HazardState& other) {
  if (!other.writeStage_ && !other.readStage_) return;
  if (!writeStage_ && !readStage_) {
    *this = other;
    atomic_ = false;  // another resource's atomics do not commute with this one's
    reused_ = true;
    return;
  }
  constexpr VkPipelineStageFlags2 all = ~VkPipelineStageFlags2(0);
  readsBefore_ = (readStage_ ? readsBefore_ : all) & (other.readStage_ ? other.readsBefore_ : all);
  writeBefore_ = (writeStage_ ? writeBefore_ : all) & (other.writeStage_ ? other.writeBefore_ : all);
  writeStage_ |= other.writeStage_;
  writeAccess_ |= other.writeAccess_;
  readStage_ |= other.readStage_;
  visible_ &= other.visible_;
  available_ = available_ && other.available_;
  atomic_ = false;
  reused_ = true;
}

}  // namespace rill
