#include "cli/html.h"

#include <span>

#include <gmock/gmock.h>

namespace radfarm::cli {
namespace {

std::string encoded(const std::string& text) { return base64(std::as_bytes(std::span(text))); }

TEST(Base64, AsInRfc4648) {
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
  EXPECT_EQ(encoded("\xff\xfe\xfd"), "//79");
}

TEST(Html, ShowsTextAsItIs) {
  EXPECT_EQ(escaped("<a href=\"x\">&'"), "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_THAT(html_page("<script>", "body"), testing::HasSubstr("<title>&lt;script&gt;</title>"));
}

TEST(Html, TablesHaveTheirCells) {
  const std::string table = html_table({"a", "b"}, {{"1", "2"}});
  EXPECT_THAT(table, testing::HasSubstr("<th>a</th><th>b</th>"));
  EXPECT_THAT(table, testing::HasSubstr("<td>1</td><td>2</td>"));
}

}  // namespace
}  // namespace radfarm::cli
