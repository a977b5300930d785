// The table of passes: what follows from the order of its rows, and that docs/architecture.md names them.
#include "fluid/pass_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace rill::test {
namespace {

TEST(PassTable, RowsAreInTheSectionThatTheirStartSays) {
  for (size_t k = 0; k < kFluidPasses; ++k) {
    const FluidPassRow& row = fluidPassTable()[k];
    EXPECT_EQ(static_cast<size_t>(row.id), k) << row.name;
    for (const Start start : row.starts) {
      if (start == Start::Always) continue;
      const PassSection expected = start == Start::Rebuild                                 ? PassSection::Rebuild
                                   : start == Start::Figures                               ? PassSection::Figures
                                   : start == Start::Predict || start == Start::FallAsleep ? PassSection::Start
                                                                                           : PassSection::Substep;
      EXPECT_EQ(sectionOf(row.id), expected) << row.name;
    }
  }
}

TEST(PassTable, ArchitectureNamesEveryPass) {
  std::ifstream file(std::filesystem::path(RILL_SOURCE_DIR) / "docs" / "architecture.md");
  std::stringstream text;
  text << file.rdbuf();
  ASSERT_GT(text.str().size(), 1000u);
  for (const FluidPassRow& row : fluidPassTable()) {
    const std::string name = "`" + std::string(row.name) + "`";
    EXPECT_NE(text.str().find(name), std::string::npos) << "expected " << name << " in a table of docs/architecture.md";
  }
}

}  // namespace
}  // namespace rill::test
