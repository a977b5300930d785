// Messages over the image.
#include "view/message_box.hpp"

#include <gtest/gtest.h>

#include "view/cycled.hpp"

namespace rill::test {
namespace {

using view::MessageBox;

TEST(MessageBox, NoticeEndsAndErrorStays) {
  MessageBox box;
  box.update(10);
  EXPECT_TRUE(box.report({}, "saved"));
  box.update(13.9);
  EXPECT_EQ(box.text(), "saved");
  box.update(14.1);
  EXPECT_EQ(box.text(), "");
  EXPECT_TRUE(box.report({}, "saved"));
  EXPECT_TRUE(box.report(Error{ErrorKind::BadInput, "no such key"}, "not shown"));
  box.update(100);
  EXPECT_EQ(box.text(), "no such key");
  EXPECT_TRUE(box.report({})) << "without a notice";
  EXPECT_EQ(box.text(), "no such key");
}

TEST(MessageBox, ReturnsErrorsOfTheDevice) {
  for (const ErrorKind kind : {ErrorKind::DeviceLost, ErrorKind::Failed}) {
    MessageBox box;
    const auto reported = box.report(Error{kind, "lost"});
    ASSERT_FALSE(reported);
    EXPECT_EQ(reported.error().kind, kind);
    EXPECT_EQ(box.text(), "");
  }
}

TEST(MessageBox, EscapesControlCharacters) {
  MessageBox box;
  box.show("a\x1b[31mb\nc");
  EXPECT_EQ(box.text(), "a\\u001b[31mb\nc");
}

TEST(Cycled, WrapsAroundAndStartsWithTheFirst) {
  const std::vector<std::string> names{"a", "b", "c"};
  EXPECT_EQ(view::cycled(names, "c", 1), "a");
  EXPECT_EQ(view::cycled(names, "a", -1), "c");
  EXPECT_EQ(view::cycled(names, "b", 1), "c");
  EXPECT_EQ(view::cycled(names, "x", -1), "a");
  EXPECT_EQ(view::cycled({}, "x", 1), "x");
}

}  // namespace
}  // namespace rill::test
