#include <algorithm>
#include <bit>
#include <cstring>

#include "support.hpp"

namespace rill::test {
namespace {

using namespace std::string_literals;

template <class T>
std::string bytesOf(T value, bool big) {
  std::string out(sizeof(T), '\0');
  std::memcpy(out.data(), &value, sizeof(T));
  if (big == (std::endian::native == std::endian::little)) std::reverse(out.begin(), out.end());
  return out;
}

const std::string kScene =
    R"({"rill": "0.1", "fluid": {"spacing": 0.1}, "domain": {"max": [10, 10, 10]}, "fill": [{"particles": {"file": "p.ply"}, "velocity": [0, 0, 1]}]})";

class Ply : public ::testing::Test {
 protected:
  Expected<ParticleSet> load(const std::string& bytes, const std::string& text = kScene) {
    folder.write("p.ply", bytes);
    auto s = parseScene(text, "dam.json", folder.path);
    if (!s) return s.error();
    return makeParticles(*s, 1'000'000);
  }
  /// The error message without the folder.
  std::string message(const std::string& bytes) {
    const auto result = load(bytes);
    if (result) return "accepted";
    const std::string prefix = "dam: fill[0].particles.file: " + folder.path.string() + "/";
    const std::string& text = result.error().message;
    return text.rfind(prefix, 0) == 0 ? text.substr(prefix.size()) : text;
  }
  Folder folder;
};

const std::string kAscii =
    "ply\nformat ascii 1.0\ncomment time 0.25\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n";

TEST_F(Ply, ReadsAscii) {
  const auto set = load(kAscii + "1 2 3\n4.5 +5 6e0");
  ASSERT_TRUE(set) << set.error().message;
  ASSERT_EQ(set->positions.size(), 2U);
  EXPECT_EQ(set->positions[1], (Float3{4.5F, 5, 6}));
  EXPECT_EQ(set->velocities[1], (Float3{0, 0, 1}));
}

TEST_F(Ply, ReadsBothByteOrdersAndSkipsOtherProperties) {
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\r\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                        " 1.0\r\nobj_info x\r\nelement face 2\r\nproperty list uchar int vertex_indices\r\nproperty uchar tag\r\n"
                        "element vertex 2\r\nproperty float vz\r\nproperty double x\r\nproperty uint id\r\nproperty double y\r\nproperty "
                        "list ushort float more\r\nproperty float z\r\n"
                        "property float vx\r\nproperty float vy\r\nelement edge 1\r\nproperty int vertex1\r\nend_header\r\n";
    for (int face = 0; face < 2; ++face) {
      bytes += bytesOf<uint8_t>(3, big);
      for (int i = 0; i < 3; ++i) bytes += bytesOf<int32_t>(i, big);
      bytes += bytesOf<uint8_t>(7, big);
    }
    for (int i = 0; i < 2; ++i) {
      const float step = static_cast<float>(i);
      bytes += bytesOf(30 + step, big) + bytesOf(1.0 + i, big) + bytesOf<uint32_t>(9, big) + bytesOf(2.0 + i, big) +
               bytesOf<uint16_t>(2, big) + bytesOf(0.5F, big) + bytesOf(0.5F, big) + bytesOf(3 + step, big) + bytesOf(10 + step, big) +
               bytesOf(20 + step, big);
    }
    bytes += bytesOf<int32_t>(0, big);
    const auto set = load(bytes);
    ASSERT_TRUE(set) << set.error().message;
    ASSERT_EQ(set->positions.size(), 2U);
    EXPECT_EQ(set->positions[1], (Float3{2, 3, 4}));
    EXPECT_EQ(set->velocities[1], (Float3{11, 21, 32}));  // the fill's velocity is added
  }
}

TEST_F(Ply, ReadsLargeFiles) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 27000\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 27000; ++i) {
    for (const int part : {i % 30, i / 30 % 30, i / 900}) bytes += bytesOf(0.05F + 0.1F * static_cast<float>(part), false);
  }
  const auto set = load(bytes);
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_EQ(set->positions.size(), 27000U);
  EXPECT_FLOAT_EQ(set->positions[26999].z, 2.95F);
}

TEST_F(Ply, KeepsCloseButDropsCoincidentParticles) {
  const std::string five = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  const auto set = load(five + "1 1 1\n1.06 1 1\n1.06 1 1\n2 2 2\n2 2 2.00001\n");
  ASSERT_TRUE(set);
  EXPECT_EQ(set->positions.size(), 3U);
  EXPECT_EQ(set->leftOutOverlap, 2U);
  ASSERT_EQ(set->warnings.size(), 1U);
  EXPECT_NE(set->warnings[0].find("fill[0]: 2 of 5 particles coincide, or are closer than 0.9 spacings"), std::string::npos)
      << set->warnings[0];
}

TEST_F(Ply, RejectsInvalidFiles) {
  const std::string head = "ply\nformat ascii 1.0\n", xyz = "property float x\nproperty float y\nproperty float z\n";
  EXPECT_EQ(message(""), "p.ply: does not begin with \"ply\"; expected a PLY file");
  EXPECT_EQ(message("solid\n"), "p.ply: does not begin with \"ply\"; expected a PLY file");
  EXPECT_EQ(message("ply\n"), "p.ply: the header has no end; expected a line end_header");
  EXPECT_EQ(message("ply\nformat ascii 2.0\nend_header\n"), "p.ply: the format's version is \"2.0\"; expected 1.0");
  EXPECT_EQ(message("ply\nformat text 1.0\nend_header\n"),
            "p.ply: the format is \"text\"; expected ascii, binary_little_endian or binary_big_endian");
  EXPECT_EQ(message("ply\nelement vertex 1\n" + xyz + "end_header\n"),
            "p.ply: the header has no format line; expected format ascii, binary_little_endian or binary_big_endian 1.0");
  EXPECT_EQ(message(head + "element vertex -1\nend_header\n"),
            "p.ply: the header line \"element vertex -1\" has no count; expected element NAME COUNT");
  EXPECT_EQ(message(head + "element vertex 1\nproperty real x\nend_header\n"),
            "p.ply: the header line \"property real x\" is invalid; expected property TYPE NAME with a type such as float or uint");
  EXPECT_EQ(message(head + "property float x\nend_header\n"), "p.ply: the header line \"property float x\" comes before any element");
  EXPECT_EQ(message(head + "vertices 3\nend_header\n"),
            "p.ply: the header line \"vertices 3\" is invalid; expected format, element, property, comment or end_header");
  EXPECT_EQ(message(head + "element face 1\nproperty float x\nend_header\n1\n"),
            "p.ply: the header has no vertex element; expected one with x, y and z");
  EXPECT_EQ(message(head + "element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n"),
            "p.ply: the vertices have no property \"z\"; expected x, y and z");
  EXPECT_EQ(message(head + "element vertex 1\n" + xyz + "property float x\nend_header\n1 2 3 4\n"),
            "p.ply: the vertex property \"x\" is declared twice; expected it once");
  EXPECT_EQ(message(head + "element vertex 1\nproperty list int float x\nend_header\n1 2\n"),
            "p.ply: the vertex property \"x\" is a list; expected a number");
  EXPECT_EQ(message(kAscii + "1 2 3\n4 5"),
            "p.ply: the header declares 2 of \"vertex\", at least 6 bytes each, but only 10 bytes follow; expected a complete file");
  EXPECT_EQ(message(kAscii + "1 2 3.000\n4 5"), "p.ply: vertex 1, property \"z\": found the end of the file, expected a number");
  EXPECT_EQ(message(kAscii + "1 2 3\n4 five 6\n"), "p.ply: vertex 1, property \"y\": found \"five\", expected a number");
  EXPECT_EQ(message(kAscii + "1 2 3\n4 nan 6\n"),
            "p.ply: vertex 1: the position is nan along y; expected a finite number that a 32-bit float can hold");
  EXPECT_EQ(message(kAscii + "1 2 3\n4 5 1e39\n"),
            "p.ply: vertex 1: the position is 1e+39 along z; expected a finite number that a 32-bit float can hold");
  EXPECT_EQ(message(kAscii + "1 2 3\n4 5 1e999\n"),
            "p.ply: vertex 1: the position is inf along z; expected a finite number that a 32-bit float can hold");
}

TEST_F(Ply, MessageOmitsContentOfOtherFiles) {
  for (const std::string& bytes : {"root:x:0:0:root:/root:/bin/sh\n"s, "password=hunter2"s, "plymouth hunter2\nformat ascii 1.0\n"s})
    EXPECT_EQ(message(bytes), "p.ply: does not begin with \"ply\"; expected a PLY file") << bytes;
}

TEST_F(Ply, ChecksCountsAgainstFileSize) {
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_EQ(message("ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\n" + xyz + std::string(120, '\0')),
            "p.ply: the header declares 1,000,000,000,000 of \"vertex\", at least 12 bytes each, but only 120 bytes follow; expected a "
            "complete file");
  EXPECT_EQ(message("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\n" + xyz).find("p.ply: the header declares"),
            0U);
  EXPECT_EQ(message("ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551616\n" + xyz).find("p.ply: the header line"),
            0U);
  const std::string truncated =
      "ply\nformat binary_little_endian 1.0\nelement face 1\nproperty list uint float v\nelement vertex 1\n" + xyz;
  EXPECT_EQ(message(truncated + "\xFF\xFF\xFF\xFF" + std::string(12, '\0')),
            "p.ply: face 0, property \"v\": found the end of the file, expected a number");
}

TEST_F(Ply, RejectsNonFiniteVelocities) {
  const std::string file =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nproperty float vx\nproperty float "
      "vy\nproperty float vz\nend_header\n1 2 3 4 -inf 6\n";
  EXPECT_EQ(message(file), "p.ply: vertex 0: the velocity is -inf along y; expected a finite number that a 32-bit float can hold");
}

TEST_F(Ply, RejectsFileWithoutParticles) {
  const auto set = load("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\nend_header\n");
  ASSERT_FALSE(set);
  EXPECT_NE(set.error().message.find("yields no particles: the file has none"), std::string::npos) << set.error().message;
}

TEST_F(Ply, FileParticlesCountTowardRequestedNumber) {
  std::string bytes = "ply\nformat ascii 1.0\nelement vertex 1000\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (int i = 0; i < 1000; ++i) bytes += "9 " + std::to_string(0.01 * i) + " 9\n";
  const std::string with_box = R"({"rill": "0.1", "fluid": {"particles": 9000}, "fill": [{"particles": {"file": "p.ply"}}, {"box": {}}]})";
  const auto set = load(bytes, with_box);
  ASSERT_TRUE(set) << set.error().message;
  EXPECT_NEAR(static_cast<double>(set->positions.size()), 9000, 100);
}

TEST_F(Ply, HandlesCorruptedFiles) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement a 1\nproperty list uchar short l\nelement vertex 3\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n";
  bytes += bytesOf<uint8_t>(1, false) + bytesOf<int16_t>(5, false);
  for (int i = 0; i < 9; ++i) bytes += bytesOf(static_cast<float>(i), false);
  for (size_t length = 0; length < bytes.size(); ++length) EXPECT_NE(message(bytes.substr(0, length)), "accepted") << length;
  for (size_t at = 0; at < bytes.size(); ++at) {
    for (int bit = 0; bit < 8; bit += 3) {
      std::string flipped = bytes;
      flipped[at] ^= static_cast<char>(1 << bit);
      (void)message(flipped);
    }
  }
}

}  // namespace
}  // namespace rill::test
