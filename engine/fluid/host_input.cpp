// What a frame brings from the host: the start state once, where driven solids are to go; and what is undone where that frame is abandoned.
#include <algorithm>
#include <cmath>

#include "core/vector_math.hpp"
#include "fluid/fluid_impl.hpp"
#include "gpu/device_impl.hpp"
#include "shape/records.hpp"

namespace rill {

void FluidImpl::declareUpload(Graph& graph) {
  struct Copy {
    BufferRef from, to;
    uint64_t bytes, at;
  };
  graph.pass("upload", [&](Pass& pass) {
    std::vector<BufferRef> sources, cleared;
    for (const Buffer& buffer : staging_->sources()) {
      sources.push_back(graph.import("start state", {.handle = buffer.handle(), .size = buffer.size(), .before = Use::Nothing}));
      pass.read(sources.back(), Use::CopySource);
    }
    std::vector<Copy> copies;
    for (const Staging::Copy& copy : staging_->copies()) {
      BufferRef& to = refs_[copy.target];
      to = pass.write(to, Use::CopyTarget);
      copies.push_back({sources[copy.source], to, copy.bytes, copy.at});
    }
    for (const size_t target : staging_->cleared()) {
      BufferRef& to = refs_[target];
      to = pass.write(to, Use::CopyTarget, true);
      cleared.push_back(to);
    }
    return [this, copies = std::move(copies), cleared = std::move(cleared)](Commands& commands) {
      uploadFrame_ = device_->clock.recording;
      for (const Copy& copy : copies) commands.copy(copy.from, copy.to, copy.bytes, copy.at);
      for (BufferRef to : cleared) commands.fill(to, 0);
    };
  });
}

std::string FluidImpl::solidOutOfRange(uint32_t solid) const {
  return "solid is " + std::to_string(solid) + "; the scene has " + std::to_string(setup.solids.size()) +
         (setup.solids.size() == 1 ? " solid" : " solids");
}

void FluidImpl::forgetAbandoned() {
  if (staging_ && uploadFrame_ && device_->abandoned(*uploadFrame_)) {
    uploaded_ = false;
    uploadFrame_.reset();
  }
  for (; !drives_.empty() && device_->abandoned(drives_.back().frame); drives_.pop_back())
    for (size_t k = 0; k < setup.driven.size(); ++k) setup.driven[k].pose = drives_.back().from[k];
  while (!drives_.empty() && drives_.front().frame <= device_->clock.completed) drives_.pop_front();
}

// Keyframes of the driven solids for an advance: from where the last one was to bring them, towards their targets.
void FluidImpl::declareDrive(Graph& graph, const FluidStep& step) {
  struct Keys {
    uint64_t at;
    std::array<KeyframeRecord, 2> values;  // where it is, and where it will be
  };
  std::vector<Keys> keys;
  Drive& drive = drives_.emplace_back();
  drive.number = ++driveCount_;
  drivenSpeed_ = 0;
  drivenMove_ = false;
  for (DrivenSolid& driven : setup.driven) {
    const PoseRecord from = driven.pose;
    drive.from.push_back(from);
    for (const SolidTarget& target : step.targets) {
      const Double3 displacement = minus(minus(target.center, origin), centerOf(from));
      const Double3 turn = target.rotation ? turnBetween(rotationOf(from), normalized(*target.rotation)) : Double3{};
      const double distance = length(displacement) + driven.radius * length(turn);
      if (target.solid != driven.solid || !std::isfinite(distance)) continue;
      const double share = distance > 0 ? std::min(1.0, driven.fastest * step.advance_s / distance) : 0.0;
      driven.pose = recordOf(Pose{.center = along(centerOf(from), share, displacement),
                                  .rotation = target.rotation ? normalized(turned(rotationOf(from), share, turn)) : rotationOf(from)},
                             {});
      drivenMove_ |= centerOf(driven.pose) != centerOf(from) || rotationOf(driven.pose) != rotationOf(from);
      drivenSpeed_ = std::max(drivenSpeed_, static_cast<float>(share * distance / step.advance_s));
    }
    const auto keyframes = drivenKeyframes(from, driven.pose, step.advance_s);
    keys.push_back({uint64_t{setup.solids[driven.solid].firstKey} * sizeof keyframes[0], keyframes});
  }
  graph.pass("drive solids", [&](Pass& pass) {
    BufferRef& keyframes = ref(FluidArray::Keyframes);
    keyframes = pass.write(keyframes, Use::CopyTarget);
    return [this, number = drive.number, keys = std::move(keys), target = keyframes](Commands& commands) {
      for (Drive& declared : drives_)
        if (declared.number == number) declared.frame = device_->clock.recording;
      for (const Keys& k : keys) commands.update(target, std::as_bytes(std::span(k.values)), k.at);
    };
  });
}

}  // namespace rill
