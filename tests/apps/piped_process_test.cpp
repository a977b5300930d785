#include "shared/piped_process.hpp"

#include <gtest/gtest.h>

#include "support/temporary_folder.hpp"

namespace rill::apps {
namespace {

using test::contentOf;
using test::TemporaryFolder;

std::span<const std::byte> bytesOf(std::string_view text) { return std::as_bytes(std::span(text.data(), text.size())); }

Expected<PipedProcess> shell(const std::string& script) {
  const std::string arguments[] = {"-c", script};
  return PipedProcess::start("/bin/sh", arguments);
}

TEST(FindProgram, SearchesPath) {
  const auto found = findProgram("sh");
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_absolute());
  EXPECT_FALSE(findProgram("no-such-program-of-rill"));
}

TEST(PipedProcess, ReceivesAllBytesAndExitsAtEndOfInput) {
  const TemporaryFolder folder;
  auto program = shell("cat >'" + (folder / "copy").string() + "'");
  ASSERT_TRUE(program) << program.error().message;
  const std::string text(1 << 20, 'x');
  ASSERT_TRUE(program->write(bytesOf(text)));
  ASSERT_TRUE(program->write(bytesOf("end")));
  ASSERT_TRUE(program->finish());
  EXPECT_EQ(contentOf(folder / "copy"), text + "end");
}

TEST(PipedProcess, FailureReportsEndOfOutput) {
  auto program = shell("i=0; while [ $i -lt 20000 ]; do echo \"line $i of much\"; i=$((i+1)); done; echo 'the reason' >&2; exit 3");
  ASSERT_TRUE(program);
  const auto done = program->finish();
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("sh failed with exit code 3\nline 19"), std::string::npos) << done.error().message;
  EXPECT_TRUE(done.error().message.ends_with("\nthe reason")) << done.error().message;
  EXPECT_LT(done.error().message.size(), 700u);
}

TEST(PipedProcess, ReportsProgramThatCannotBeStarted) {
  const auto program = PipedProcess::start("/no/such/program", {});
  ASSERT_FALSE(program);
  EXPECT_EQ(program.error().kind, ErrorKind::Io);
  EXPECT_NE(program.error().message.find("can't start program: No such file"), std::string::npos) << program.error().message;
}

}  // namespace
}  // namespace rill::apps
