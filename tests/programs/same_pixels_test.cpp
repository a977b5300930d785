// Images depend neither on the number of driver threads, which changes how invocations share subgroups, nor on how shaders read arrays.
#include <gtest/gtest.h>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace same_pixels_test {

TEST(SamePixelsTest, DriverThreadsDoNotChangeImages) {
  const TemporaryFolder folder;
  const auto render = [&](const std::string& threads, const std::string& out) {
    const Outcome outcome = capture({"double-dam", "--particles", "2000", "--fps", "10", "--frames", "10", "--size", "960x540", "--view",
                                     "normals", "--quiet", "--out", out},
                                    folder.string(), {{"LP_NUM_THREADS", threads}});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  };
  render("0", "one_thread");
  render("2", "two_threads");
  const std::vector<std::string> names = TemporaryFolder::namesIn(folder / "one_thread");
  ASSERT_EQ(names.size(), 10u);
  for (const std::string& name : names)
    EXPECT_TRUE(contentOf(folder / "one_thread" / name) == contentOf(folder / "two_threads" / name)) << name;
}

TEST(SamePixelsTest, ReadsOfArraysDoNotChangeImages) {
  const TemporaryFolder folder;
  const std::vector<std::string> plain{"look={}"};
  const std::vector<std::string> full{"look.sky=day", "look.stage=tank", "look.caustics=true", "look.whitewater=true"};
  for (const std::string scene : {"double-dam", "waterwheel"})
    for (const auto& [name, look] : {std::pair{"plain", plain}, {"full", full}}) {
      const auto render = [&](const std::string& reads) {
        std::vector<std::string> arguments{scene,     "--particles", "2000",  "--fps", "5",       "--frames", "3",     "--size",
                                           "480x270", "--quiet",     "--out", reads,   "--reads", reads,      "--set", "rill=0.2"};
        arguments.insert(arguments.end(), look.begin(), look.end());
        const Outcome outcome = capture(arguments, folder.string());
        ASSERT_EQ(outcome.code, 0) << outcome.err;
      };
      render("storage");
      render("texels");
      for (const char* file : {"frame_00000.png", "frame_00001.png", "frame_00002.png"})
        EXPECT_TRUE(contentOf(folder / "storage" / file) == contentOf(folder / "texels" / file)) << scene << ", " << name << ", " << file;
    }
}

}  // namespace same_pixels_test
}  // namespace rill::test
