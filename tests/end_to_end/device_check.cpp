// Without a usable device no test of this program can run: it fails once, with the reason.
#include <gtest/gtest.h>

#include "offline/context.hpp"

namespace rill::offline {
namespace {

class DeviceCheck : public ::testing::Environment {
  void SetUp() override {
    const auto context = Context::create();
    ASSERT_TRUE(context) << context.error().message;
  }
};

[[maybe_unused]] const ::testing::Environment* const registeredCheck = ::testing::AddGlobalTestEnvironment(new DeviceCheck);

}  // namespace
}  // namespace rill::offline
