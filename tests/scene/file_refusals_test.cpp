// What is refused before any key is read: text that is no JSON, other encodings, files that are no scenes.
#include <sys/stat.h>

#include "support.hpp"

namespace rill::test {
namespace {

TEST(SceneErrors, ReportsLineAndColumnOfInvalidJson) {
  expectRefusals({
      {"", ": empty file; expected a JSON object"},
      {" \n ", ": empty file; expected a JSON object"},
      {"[1]", ": found an array of length 1, expected an object { ... }"},
      {"3", ": found a number, expected an object { ... }"},
      {"{\n  \"rill\": \"0.1\",\n}", ":3:1: invalid JSON: trailing comma before }"},
      {"{\"gravity\": [0, 1, ]}", ":1:20: invalid JSON: trailing comma before ]"},
      {"{\n\"rill\" 1}", ":2:8: invalid JSON: while parsing object separator - unexpected number literal; expected ':'"},
  });
  EXPECT_NE(parseError("{\"rill\": \"0.1\"").find("dam.json:1:15: invalid JSON: while parsing object - unexpected end of input"),
            std::string::npos)
      << parseError("{\"rill\": \"0.1\"");
  EXPECT_NE(parseError("{} {}").find("dam.json:1:4: invalid JSON"), std::string::npos);
  EXPECT_NE(parseError("{\"rill\": NaN}").find("dam.json:1:10: invalid JSON"), std::string::npos) << parseError("{\"rill\": NaN}");
  EXPECT_NE(parseError("{\"rill\": -Infinity}").find("dam.json:1:1"), std::string::npos);
  EXPECT_NE(parseError("{\"rill\": 0x10}").find("invalid JSON"), std::string::npos);
  EXPECT_NE(parseError("{'rill': 1}").find("invalid JSON"), std::string::npos);
  EXPECT_NE(parseError("{ /* no end }").find("invalid JSON"), std::string::npos);
  EXPECT_LT(parseError("{\"rill\": \"" + std::string(100000, 'a')).size(), 600U);
}

TEST(SceneErrors, OmitContentOfFilesThatAreNoScenes) {
  for (const char* text : {"hunter2", "root:hunter2:0:0", "\"hunter2\"", "[\"hunter2\"]", "{\"password\": \"hunter2\"}",
                           "{\"password\": hunter2}", "password=hunter2", "31415926", "31415926e999"}) {
    const std::string message = parseError(text);
    EXPECT_EQ(message.rfind("dam.json:", 0), 0U) << message;
    EXPECT_EQ(message.find("hunter2"), std::string::npos) << message;
    EXPECT_EQ(message.find("31415926"), std::string::npos) << message;
  }
}

TEST(SceneErrors, RejectsDuplicateKeysAtAnyDepth) {
  expectRefusals({
      {"{\"rill\": \"0.1\",\n \"rill\": \"0.1\"}", ":2:2: duplicate key \"rill\"; expected each key once in an object"},
      {"{\"extras\": [{\"a\": {\"b\": 1, \"b\": 2}}]}", ":1:28: duplicate key \"b\"; expected each key once in an object"},
      {"{\"extras\": {\"q\\\"\\\\\": 1, \"q\\\"\\\\\": 2}}", ":1:25: duplicate key \"q\"\\\"; expected each key once in an object"},
      {"{\"a\\u0062\": 1, \"ab\": 2}", ":1:16: duplicate key \"ab\"; expected each key once in an object"},
  });
}

TEST(SceneErrors, RejectsDeepNesting) {
  const std::string deep = "{\"extras\": " + std::string(1'000'000, '[');
  EXPECT_EQ(parseError(deep), "dam.json:1:267: nested deeper than 256 levels");
  const std::string fits = with("\"extras\": " + std::string(255, '[') + std::string(255, ']'));
  EXPECT_EQ(parseError(fits), "accepted");
}

TEST(SceneErrors, NamesUnsupportedEncodings) {
  using namespace std::string_literals;
  expectRefusals({
      {"\xFF\xFE{\0"s, ": the encoding is UTF-16, little-endian; expected UTF-8"},
      {"\xFE\xFF\0{"s, ": the encoding is UTF-16, big-endian; expected UTF-8"},
      {"\xFF\xFE\0\0{\0\0\0"s, ": the encoding is UTF-32, little-endian; expected UTF-8"},
      {"\0\0\xFE\xFF\0\0\0{"s, ": the encoding is UTF-32, big-endian; expected UTF-8"},
      {"{\0\"\0"s, ": the encoding is UTF-16, little-endian; expected UTF-8"},
      {"\0{\0\""s, ": the encoding is UTF-16, big-endian; expected UTF-8"},
      {"{\0\0\0"s, ": the encoding is UTF-32, little-endian; expected UTF-8"},
      {"\0\0\0{"s, ": the encoding is UTF-32, big-endian; expected UTF-8"},
      {"{\n\"title\": \"caf\xE9\"}", ":2:14: the byte 0xE9 is not valid UTF-8; expected UTF-8"},
      {"{ // \xC0\x80\n}", ":1:6: the byte 0xC0 is not valid UTF-8; expected UTF-8"},
      {"{ // \xED\xA0\x80\n}", ":1:6: the byte 0xED is not valid UTF-8; expected UTF-8"},
      {"{\"\xF4\x90\x80\x80\": 1}", ":1:3: the byte 0xF4 is not valid UTF-8; expected UTF-8"},
      {"{\"\xE2\x82", ":1:3: the byte 0xE2 is not valid UTF-8; expected UTF-8"},
  });
  EXPECT_EQ(parseError("\xEF\xBB\xBF" + with(R"("title": "caf)"
                                             "\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x8C\x8A\"")),
            "accepted");
}

TEST(SceneErrors, RejectsFilesThatAreNotScenes) {
  const Folder folder;
  const auto load = [](const std::filesystem::path& file) {
    const auto result = loadScene(file);
    return result ? std::string("accepted") : result.error().message;
  };
  EXPECT_EQ(load(folder.path / "absent.json"), (folder.path / "absent.json").string() + ": no such file");
  EXPECT_EQ(load(folder.path), folder.path.string() + ": found a directory, expected a regular file");
  const auto pipe = folder.path / "pipe.json";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(load(pipe), pipe.string() + ": found a pipe, expected a regular file");
  EXPECT_EQ(load("/dev/zero"), "/dev/zero: found a device, expected a regular file");
  const auto large = folder.write("large.json", with("\"about\": \"" + std::string(16 << 20, 'x') + "\""));
  EXPECT_NE(load(large).find("bytes; expected at most 16,777,216"), std::string::npos) << load(large);
  const auto small = folder.write("small.json", withFluid("\"spacing\": 0.1"));
  const auto good = loadScene(small);
  ASSERT_TRUE(good) << good.error().message;
  EXPECT_EQ(good->name, "small");
  EXPECT_EQ(good->file, small);
  const auto broken = folder.write("broken.json", "{");
  EXPECT_EQ(load(broken).rfind(broken.string() + ":1:", 0), 0U) << load(broken);
}

TEST(SceneErrors, RejectsMissingParticleFile) {
  const Folder folder;
  const std::string text = with(R"("fill": [{"particles": {"file": "settled.ply"}}])");
  const auto missing = parseScene(text, "dam.json", folder.path);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message,
            "dam.json: fill[0].particles.file: \"settled.ply\": no such file (looked for " + (folder.path / "settled.ply").string() + ")");
  folder.write("settled.ply", "ply\n");
  const auto there = parseScene(text, "dam.json", folder.path);
  ASSERT_TRUE(there);
  EXPECT_TRUE(std::get<ParticleFile>(there->fill[0].shape).file.is_absolute());
  EXPECT_NE(parseError(with(R"("fill": [{"particles": {"file": ""}}])")).find("expected a file name"), std::string::npos);
  EXPECT_NE(parseError(with(R"("fill": [{"particles": {}}])")).find("fill[0].particles.file: required key is missing"), std::string::npos);
  EXPECT_NE(parseError(with(R"("fill": [{"particles": {"file": "."}}])")).find("not a regular file; expected a file"), std::string::npos);
}

}  // namespace
}  // namespace rill::test
