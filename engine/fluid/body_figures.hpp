#pragma once
// What hosts see of rigid bodies, from their records on the device.
#include <span>

#include "rill/fluid.hpp"
#include "shared/body_records.h"

namespace rill {

/// `origin`: that the record is relative to, m.
BodyMotion motionOf(const BodyRecord& record, const Double3& origin);

/// `gravity`: m/s^2.
BodyFigures figuresOf(std::span<const BodyRecord> records, const Double3& origin, const Double3& gravity);

}  // namespace rill
