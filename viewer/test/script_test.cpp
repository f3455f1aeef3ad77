#include "core/script.hpp"

#include <gtest/gtest.h>

namespace halfspace::viewer {
namespace {

TEST(Script, EveryEventGivesItselfBack) {
  const std::string lines =
      "move 10 -20\nmove 1 2 shift ctrl\npress left\nrelease right alt\n"
      "wheel -1.5\nwheel 3 shift\npinch -0.25 9 -3\nkey A\nkey "
      "Ctrl+Shift+Z\nkey Ctrl++\nkey +\n"
      "text Hello, you\ndrop /a b/c.stl\nsize 300 200\nwait\ndump\n"
      "shot window.png\nquit\n";
  const auto events = parse_script(lines);
  ASSERT_TRUE(events) << events.error().message;
  std::string again;
  for (const Event& event : *events) again += to_text(event) + '\n';
  EXPECT_EQ(again, lines);
}

TEST(Script, ADragIsAPressMovesAndARelease) {
  const auto events = parse_script("drag middle 0 0 80 -16 shift");
  ASSERT_TRUE(events);
  ASSERT_EQ(events->size(), 11u);
  EXPECT_EQ((*events)[1].kind, Event::Kind::kPress);
  EXPECT_EQ((*events)[1].button, Button::kMiddle);
  EXPECT_EQ((*events)[5].x, 40);
  EXPECT_EQ((*events)[5].y, -8);
  EXPECT_TRUE((*events)[5].modifiers.shift);
  EXPECT_EQ(events->back().kind, Event::Kind::kRelease);
}

TEST(Script, CommentsAndEmptyLinesSayNothing) {
  const auto events = parse_script("# a comment\n\n   \r\nwait\r\n");
  ASSERT_TRUE(events);
  EXPECT_EQ(events->size(), 1u);
}

TEST(Script, FaultsNameTheLine) {
  for (const char* line :
       {"jump", "move 1", "move 1 2 meta", "press thumb", "wheel fast",
        "wheel nan", "pinch 1 2", "pinch inf 1 2", "key", "key Hyper+A", "text",
        "size 0 5", "wait now", "drag left 1 2 3"}) {
    const auto events = parse_script("wait\n" + std::string(line));
    ASSERT_FALSE(events) << line;
    EXPECT_EQ(events.error().index, 2) << line;
  }
}

}  // namespace
}  // namespace halfspace::viewer
