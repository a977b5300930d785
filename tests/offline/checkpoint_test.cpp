// Checkpoint files: round trips and errors.
#include <gtest/gtest.h>

#include <cstring>

#include "rill/offline.hpp"
#include "support/checkpoint_seed.hpp"
#include "support/temporary_folder.hpp"

namespace rill::test {
namespace {

using offline::Checkpoint;

std::string decodeError(std::span<const std::byte> bytes) {
  const auto read = offline::decodeCheckpoint(bytes, "run.rill");
  if (read) return "";
  EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
  return read.error().message;
}

TEST(CheckpointFile, RoundTrips) {
  for (const Checkpoint& c : {seedCheckpoint(), seedCheckpointWithBodies()}) {
    const auto bytes = offline::encodeCheckpoint(c);
    const auto read = offline::decodeCheckpoint(bytes, "run.rill");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, c);
    EXPECT_EQ(offline::encodeCheckpoint(*read), bytes);
  }
  const Checkpoint nothing;
  const auto empty = offline::decodeCheckpoint(offline::encodeCheckpoint(nothing), "run.rill");
  ASSERT_TRUE(empty) << empty.error().message;
  EXPECT_EQ(*empty, nothing);
}

TEST(CheckpointFile, RejectsTruncationAnywhere) {
  const auto bytes = offline::encodeCheckpoint(seedCheckpointWithBodies());
  for (size_t size = 1; size < bytes.size(); ++size) {
    const std::string why = decodeError(std::span(bytes).first(size));
    EXPECT_NE(why.find("is truncated"), std::string::npos) << size << ": " << why;
  }
  EXPECT_NE(decodeError({}).find("not a Rill checkpoint"), std::string::npos);
  auto longer = bytes;
  longer.push_back({});
  EXPECT_NE(decodeError(longer).find("is corrupted: found"), std::string::npos) << decodeError(longer);
}

TEST(CheckpointFile, RejectsAnyFlippedBit) {
  auto bytes = offline::encodeCheckpoint(seedCheckpoint());
  for (size_t at = 0; at < bytes.size(); ++at)
    for (int bit = 0; bit < 8; ++bit) {
      bytes[at] ^= static_cast<std::byte>(1 << bit);
      EXPECT_NE(decodeError(bytes), "") << "byte " << at << ", bit " << bit;
      bytes[at] ^= static_cast<std::byte>(1 << bit);
    }
}

TEST(CheckpointFile, DistinguishesForeignAndNewerFiles) {
  const std::string image = "\x89PNG\r\n\x1a\n and so on and so on";
  EXPECT_NE(decodeError(std::as_bytes(std::span(image))).find("is not a Rill checkpoint"), std::string::npos);
  const auto checkpoint = offline::encodeCheckpoint(seedCheckpoint());
  const int format = std::to_integer<int>(checkpoint[8]);
  const auto expectRejected = [&](int other, const char* age) {
    auto bytes = checkpoint;
    bytes[8] = std::byte(other);
    seal(bytes);
    const std::string what = age + (" Rill: found format " + std::to_string(other)) + ", expected " + std::to_string(format);
    EXPECT_NE(decodeError(bytes).find(what), std::string::npos) << decodeError(bytes);
  };
  expectRejected(format + 1, "a newer");
  expectRejected(format - 1, "an older");
}

// The checksum is valid, so that the lengths themselves are checked.
TEST(CheckpointFile, RejectsInvalidLengths) {
  const auto whole = offline::encodeCheckpoint(seedCheckpoint());
  uint32_t sections = 0;
  std::memcpy(&sections, whole.data() + 12, 4);
  ASSERT_GT(sections, 10u);
  for (uint64_t wrong : {uint64_t{1}, uint64_t{1} << 40, ~uint64_t{0}, ~uint64_t{7}, uint64_t{1} << 63}) {
    for (size_t row = 0; row < sections; ++row) {
      auto bytes = whole;
      std::memcpy(bytes.data() + 24 + 16 * row + 8, &wrong, 8);
      seal(bytes);
      EXPECT_NE(decodeError(bytes).find("is corrupted"), std::string::npos) << row << ": " << wrong;
    }
    auto bytes = whole;
    std::memcpy(bytes.data() + 16, &wrong, 8);  // of the whole file
    EXPECT_NE(decodeError(bytes), "");
    bytes = whole;
    std::memcpy(bytes.data() + 24 + 16 * sections, &wrong, 8);  // of the first text
    seal(bytes);
    EXPECT_NE(decodeError(bytes).find("is corrupted"), std::string::npos) << wrong;
  }
}

TEST(CheckpointFile, RejectsUnprintableKeys) {
  Checkpoint c = seedCheckpoint();
  c.keys[0].second = "\x1b[2J";
  EXPECT_NE(decodeError(offline::encodeCheckpoint(c)).find("is corrupted"), std::string::npos)
      << "control characters would reach a terminal";
}

TEST(CheckpointFile, LoadsFromDisk) {
  const TemporaryFolder folder;
  const auto bytes = offline::encodeCheckpoint(seedCheckpoint());
  const auto file = folder.write("run.rill", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  const auto read = offline::loadCheckpoint(file);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, seedCheckpoint());
  for (const auto& [path, words] : {std::pair{folder / "none", "does not exist"}, std::pair{folder.path(), "is not a regular file"},
                                    std::pair{std::filesystem::path("/dev/zero"), "is not a regular file"}}) {
    const auto missing = offline::loadCheckpoint(path);
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find(words), std::string::npos) << missing.error().message;
  }
  const auto other = folder.write("other", std::string(1 << 20, 'x'));
  EXPECT_NE(offline::loadCheckpoint(other).error().message.find("not a Rill checkpoint"), std::string::npos);
}

}  // namespace
}  // namespace rill::test
