#pragma once
#include <gtest/gtest.h>

#include <filesystem>

#include "support/temporary_folder.hpp"

namespace rill::test {

/// Whole: it begins as a PNG does and ends with the IEND chunk.
inline void expectWholePng(const std::filesystem::path& file) {
  const std::string bytes = contentOf(file);
  ASSERT_GT(bytes.size(), 40u) << file;
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n") << file;
  EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND") << file;
}

}  // namespace rill::test
