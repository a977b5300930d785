#pragma once
#include <gtest/gtest.h>

#include <cstdlib>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {

/// An environment in which the driver of the tests reports its device twice: by a second driver file, in `folder`. Fails the test where
/// VK_DRIVER_FILES does not name a file.
inline Child::Environment twoDevices(const TemporaryFolder& folder) {
  const char* driver = std::getenv("VK_DRIVER_FILES");
  if (!driver || !std::filesystem::is_regular_file(driver)) {
    ADD_FAILURE()
        << "VK_DRIVER_FILES is " << (driver ? driver : "not set")
        << "; expected the .json file of one Vulkan driver, for example /usr/share/vulkan/icd.d/lvp_icd.x86_64.json, as tests/run.sh "
           "sets it";
    return {};
  }
  const std::string drivers = folder.write("second.json", contentOf(driver)).string() + ":" + driver;
  return {{"VK_DRIVER_FILES", drivers}, {"VK_ICD_FILENAMES", drivers}};
}

}  // namespace rill::test
