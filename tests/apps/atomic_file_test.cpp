#include "shared/atomic_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "shared/folder_lock.hpp"
#include "support/temporary_folder.hpp"

namespace rill::apps {
namespace {

using test::contentOf;
using test::TemporaryFolder;
namespace fs = std::filesystem;

TEST(WriteFile, ReplacesFileAndLeavesNoPartFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeFile(folder / "a.json", "first"));
  ASSERT_TRUE(writeFile(folder / "a.json", "second, longer"));
  EXPECT_EQ(contentOf(folder / "a.json"), "second, longer");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a.json"});
}

TEST(WriteFile, OpenReaderKeepsOldContent) {
  const TemporaryFolder folder;
  folder.write("a", "old");
  std::ifstream reader(folder / "a");
  ASSERT_TRUE(writeFile(folder / "a", "new"));
  std::string text;
  reader >> text;
  EXPECT_EQ(text, "old");
}

TEST(WriteFile, FollowsLinkAndKeepsMode) {
  const TemporaryFolder folder;
  folder.write("target", "old");
  ASSERT_EQ(::chmod((folder / "target").c_str(), 0640), 0);
  fs::create_symlink("target", folder / "link");
  ASSERT_TRUE(writeFile(folder / "link", "new"));
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(contentOf(folder / "target"), "new");
  struct stat info {};
  ASSERT_EQ(::stat((folder / "target").c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777, 0640u);
}

TEST(WriteFile, FullDiskReportsFileAndReason) {
  const auto written = writeFile("/dev/full", "text");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, ErrorKind::Io);
  EXPECT_NE(written.error().message.find("/dev/full"), std::string::npos);
  EXPECT_NE(written.error().message.find("No space left"), std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(WriteFile, FailsInMissingFolder) {
  const TemporaryFolder folder;
  EXPECT_FALSE(writeFile(folder / "none/a", "text"));
  EXPECT_TRUE(folder.names().empty());
}

TEST(WriteFile, WritesPipeInPlace) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = contentOf(folder / "pipe"); });
  EXPECT_TRUE(writeFile(folder / "pipe", "through"));
  reader.join();
  EXPECT_EQ(read, "through");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(SpecialFile, RecognizesStreamsAndDevices) {
  for (const char* name : {"-", "/dev/stdout", "/dev/null", "/dev/full", "/proc/self/fd/1", "/dev/../dev/stdout"})
    EXPECT_TRUE(isSpecialFile(name)) << name;
  for (const char* name : {"a.json", "/tmp/a", "./-"}) EXPECT_FALSE(isSpecialFile(name)) << name;
  EXPECT_TRUE(isStandardOutput("-"));
  EXPECT_TRUE(isStandardOutput("/dev/stdout"));
  EXPECT_FALSE(isStandardOutput("/dev/stderr"));
}

TEST(CheckPlace, RejectsUnwritablePaths) {
  const TemporaryFolder folder;
  folder.write("file", "");
  const auto message = [](const Expected<void>& result) { return result ? std::string() : result.error().message; };
  EXPECT_EQ(message(checkFilePlace("--stats", folder / "new.json")), "");
  EXPECT_EQ(message(checkFilePlace("--stats", folder / "a/b/new.json")), "");
  EXPECT_EQ(message(checkFilePlace("--stats", "new.json")), "");
  EXPECT_EQ(message(checkFilePlace("--stats", "-")), "");
  EXPECT_NE(message(checkFilePlace("--stats", folder.path())).find("is a folder"), std::string::npos);
  EXPECT_NE(message(checkFilePlace("--stats", folder / "file/x.json")).find("is a file"), std::string::npos);
  EXPECT_NE(message(checkFilePlace("--stats", "/dev/rill-none")).find("no such file"), std::string::npos);
  EXPECT_EQ(message(checkFolderPlace("--out", folder / "x/y")), "");
  EXPECT_NE(message(checkFolderPlace("--out", folder / "file")).find("--out"), std::string::npos);
  EXPECT_EQ(folder.names(), std::vector<std::string>{"file"}) << "checking creates nothing";
}

TEST(MakeFolder, CreatesParentsAndAcceptsTrailingSlash) {
  const TemporaryFolder folder;
  EXPECT_TRUE(makeFolder("--out", folder / "a/b/"));
  EXPECT_TRUE(makeFolder("--out", folder / "a/b"));
  folder.write("file", "");
  EXPECT_FALSE(makeFolder("--out", folder / "file/b"));
}

TEST(PartFile, ReplacesTargetOnlyOnCommit) {
  const TemporaryFolder folder;
  folder.write("a", "old");
  {
    auto part = PartFile::create(folder / "a");
    ASSERT_TRUE(part);
    ASSERT_TRUE(writeAll(part->descriptor(), "a", "new"));
    EXPECT_EQ(contentOf(part->path()), "new");
    EXPECT_EQ(contentOf(folder / "a"), "old");
  }
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"}) << "removed without commit()";
  auto part = PartFile::create(folder / "a");
  ASSERT_TRUE(part);
  std::string_view target;
  const std::string name = part->path().filename().string();
  EXPECT_TRUE(isPartFile(name, target));
  ASSERT_TRUE(writeAll(part->descriptor(), "a", "new"));
  ASSERT_TRUE(part->commit());
  EXPECT_EQ(contentOf(folder / "a"), "new");
  EXPECT_EQ(folder.names(), std::vector<std::string>{"a"});
}

TEST(PartFile, IsRecognizedByName) {
  std::string_view target;
  ASSERT_TRUE(isPartFile(".frame_00001.png.4711.part", target));
  EXPECT_EQ(target, "frame_00001.png");
  for (const char* name : {"frame_00001.png", ".frame_00001.png.part", "frame_00001.png.1.part", ".a.b.part", ".part"})
    EXPECT_FALSE(isPartFile(name, target)) << name;
}

TEST(FolderLock, IsExclusive) {
  const TemporaryFolder folder;
  {
    auto first = FolderLock::take(folder.path());
    ASSERT_TRUE(first);
    auto second = FolderLock::take(folder.path());
    ASSERT_FALSE(second);
    EXPECT_NE(second.error().message.find("another capture is writing"), std::string::npos);
  }
  EXPECT_TRUE(FolderLock::take(folder.path()));
  EXPECT_TRUE(folder.names().empty()) << "no lock file";
}

}  // namespace
}  // namespace rill::apps
