#pragma once
// A session of the viewer without a window.
#include <gtest/gtest.h>

#include <memory>

#include "support/gpu_test.hpp"
#include "support/temporary_folder.hpp"
#include "view/touch.hpp"

namespace rill::view {

class SessionTest : public test::GpuTest {
 protected:
  void TearDown() override {
    session_.reset();
    GpuTest::TearDown();
  }
  /// Opens a scene and simulates its first step.
  void open(const char* scene) {
    auto opened = Session::open(context(), folder.write("scene.json", scene));
    ASSERT_TRUE(opened) << opened.error().message;
    session_ = std::move(*opened);
    steps(1);
  }
  Runner& runner() { return session_->runner(); }
  Session& session() { return *session_; }
  /// Looks along -z from the front at a place.
  static Ray at(double x, double y) { return {{x, y, 3}, {0, 0, -1}}; }
  static CameraView eye() { return {.eye = {1.5, 0.5, 3}, .target = {1.5, 0.5, 0}, .fov_y_deg = 40}; }
  void steps(int count) {
    for (int k = 0; k < count; ++k) {
      auto ran = runner().step();
      ASSERT_TRUE(ran) << ran.error().message;
    }
  }
  FluidStats stats() {
    auto measured = runner().measure();
    EXPECT_TRUE(measured);
    return measured ? *measured : FluidStats{};
  }

  test::TemporaryFolder folder;
  std::unique_ptr<Session> session_;
  Touch touch_;
};

}  // namespace rill::view
