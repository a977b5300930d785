#pragma once
#include "contract/client.hpp"

namespace rill::test {

/// One host per test. Any validation message fails the test.
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
  Interceptor& interceptor() { return host_->interceptor; }
  /// Null, with a test failure, on error.
  std::unique_ptr<Client> client(const HostDevice& hostDevice, bool draws = true) {
    auto made = Client::open(host(), hostDevice, draws);
    if (made) return *std::move(made);
    ADD_FAILURE() << made.error().message;
    return nullptr;
  }
  std::unique_ptr<Client> client() { return client(host().hostDevice()); }
  static void frames(Client& client, int count) {
    for (int k = 0; k < count; ++k) {
      const auto ok = client.frame();
      ASSERT_TRUE(ok) << ok.error().message;
    }
  }

 private:
  std::unique_ptr<Host> host_;
};

}  // namespace rill::test
