#include "base/utf8.h"

#include <string>

#include <gtest/gtest.h>

namespace radfarm {
namespace {

TEST(Utf8, TellsTextFromOtherBytes) {
  for (const char* text : {"", "plain", "Küche", "厨房", "🏠", "\xf4\x8f\xbf\xbf"}) EXPECT_TRUE(is_utf8(text)) << text;
  // Latin-1, a lone continuation, cut short, overlong '/', a surrogate, above U+10FFFF.
  for (const char* text : {"K\xfc" "che", "\x80", "\xe5\x8e", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xff"}) {
    EXPECT_FALSE(is_utf8(text)) << testing::PrintToString(text);
  }
}

TEST(Utf8, FindsControlCharactersOfOneAndTwoBytes) {
  for (const std::string& text : {std::string("a\nb"), std::string("\0", 1), std::string("\x1b[0m"),
                                  std::string("\x7f"), std::string("é\xc2\x9b")}) {
    EXPECT_TRUE(has_control_characters(text)) << testing::PrintToString(text);
  }
  for (const char* text : {"", "a b", "é", "\xc2\xa0", "厨房"}) EXPECT_FALSE(has_control_characters(text)) << text;
}

TEST(Utf8, APrefixEndsBetweenCharacters) {
  EXPECT_EQ(utf8_prefix("abc", 9), "abc");
  EXPECT_EQ(utf8_prefix("abc", 2), "ab");
  EXPECT_EQ(utf8_prefix("aé", 2), "a");
  EXPECT_EQ(utf8_prefix("aé", 3), "aé");
  EXPECT_EQ(utf8_prefix("🏠", 3), "");
}

}  // namespace
}  // namespace radfarm
