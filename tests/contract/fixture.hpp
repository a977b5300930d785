#pragma once
#include "contract/guest.hpp"

namespace rill::test {

/// One host a test. Any message of its validation layer fails it.
class Contract : public ::testing::Test {
 protected:
  void SetUp() override {
    host_ = Host::open();
    ASSERT_TRUE(host_);
  }
  void TearDown() override {
    if (!host_) return;
    for (const std::string& message : host_->takeMessages()) ADD_FAILURE() << message;
  }
  Host& host() { return *host_; }
  Watch& watch() { return host_->watch; }
  /// Null, with a failure, where that fails.
  std::unique_ptr<Guest> guest(const HostDevice& lent, bool draws = true) {
    auto made = Guest::open(host(), lent, draws);
    if (made) return *std::move(made);
    ADD_FAILURE() << made.error().message;
    return nullptr;
  }
  std::unique_ptr<Guest> guest() { return guest(host().lend()); }
  static void frames(Guest& guest, int count) {
    for (int k = 0; k < count; ++k) {
      const auto ok = guest.frame();
      ASSERT_TRUE(ok) << ok.error().message;
    }
  }

 private:
  std::unique_ptr<Host> host_;
};

}  // namespace rill::test
