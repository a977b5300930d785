#include "core/words.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rill {
namespace {

TEST(Words, NearestWordFindsTypos) {
  const std::string_view known[] = {"spacing", "density", "viscosity", "vorticity"};
  EXPECT_EQ(nearestWord("spacin", known), "spacing") << "a missing letter";
  EXPECT_EQ(nearestWord("densitty", known), "density") << "an extra letter";
  EXPECT_EQ(nearestWord("viscosoty", known), "viscosity") << "a wrong letter";
  EXPECT_EQ(nearestWord("vorticiyt", known), "vorticity") << "two letters swapped";
  EXPECT_EQ(nearestWord("VISCOSITY", known), "viscosity") << "case";
  EXPECT_EQ(nearestWord("visc", known), "viscosity") << "a prefix";
  EXPECT_EQ(nearestWord("gravity", known), "");
  EXPECT_EQ(nearestWord("", known), "");
  EXPECT_EQ(nearestWord("spacing", {}), "");
}

TEST(Words, QuotesEscapeAndTruncate) {
  EXPECT_EQ(inQuotes("a b"), "\"a b\"");
  EXPECT_EQ(inQuotes("a\nb\x01").find('\n'), std::string::npos);
  EXPECT_EQ(inQuotes("a\nb\x01").find('\x01'), std::string::npos);
  EXPECT_LT(inQuotes(std::string(10000, 'x')).size(), 80u);
  std::string umlauts;
  for (int i = 0; i < 100; ++i) umlauts += "\xc3\xa4";
  const std::string cut = inQuotes(umlauts);
  EXPECT_LT(cut.size(), 80u);
  size_t leads = 0, tails = 0;  // equal unless a character was split
  for (unsigned char c : cut) leads += c == 0xc3, tails += c == 0xa4;
  EXPECT_EQ(leads, tails);
}

TEST(Words, NumbersAreGroupedByThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(50000000), "50,000,000");
  EXPECT_EQ(grouped(std::numeric_limits<uint64_t>::max()), "18,446,744,073,709,551,615");
}

TEST(Words, ShortNumbersRoundTrip) {
  EXPECT_EQ(shortestNumber(0.1), "0.1");
  EXPECT_EQ(shortestNumber(1000), "1000");
  for (double x : {1.0 / 3, 1e-300, 6.02214076e23, -0.0, 4194304.0, std::nextafter(1.0, 2.0)}) EXPECT_EQ(std::stod(shortestNumber(x)), x);
}

TEST(Words, RoughNumbersHaveFourDigits) {
  EXPECT_EQ(roundedNumber(0.0023068), "0.002307");
  EXPECT_EQ(roundedNumber(12.3456), "12.35");
}

TEST(Words, ListsAreQuoted) {
  const std::string_view words[] = {"a", "b"};
  EXPECT_EQ(quotedList(words), "\"a\", \"b\"");
  EXPECT_EQ(quotedList({}), "");
}

}  // namespace
}  // namespace rill
