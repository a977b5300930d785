// What a frame brings from the host: the start state once, where driven solids are to go; and what is undone where that frame is abandoned.
#include <algorithm>
#include <cmath>

#include "fluid/fluid_impl.hpp"
#include "gpu/device_impl.hpp"

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
    for (size_t k = 0; k < setup.driven.size(); ++k) setup.driven[k].center = drives_.back().from[k];
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
  for (DrivenSolid& driven : setup.driven) {
    const Float3 from = driven.center;
    Float3 to = from;
    drive.from.push_back(from);
    for (const SolidTarget& target : step.targets) {
      Double3 displacement;
      for (int a = 0; a < 3; ++a) displacement[a] = target.center[a] - origin[a] - from[a];
      const double length = std::hypot(displacement[0], displacement[1], displacement[2]);
      if (target.solid != driven.solid || !std::isfinite(length)) continue;
      const double share = length > 0 ? std::min(1.0, driven.fastest * step.advance_s / length) : 0.0;
      for (int a = 0; a < 3; ++a) to[a] = static_cast<float>(from[a] + share * displacement[a]);
      drivenSpeed_ = std::max(drivenSpeed_, static_cast<float>(share * length / step.advance_s));
    }
    driven.center = to;
    const auto key = [](const Float3& x, double at) {
      return KeyframeRecord{.x = x.x, .y = x.y, .z = x.z, .at = static_cast<float>(at), .rotationW = 1};
    };
    keys.push_back({uint64_t{setup.solids[driven.solid].firstKey} * sizeof(KeyframeRecord), {key(from, 0), key(to, step.advance_s)}});
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
