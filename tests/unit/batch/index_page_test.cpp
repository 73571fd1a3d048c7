// SPDX-License-Identifier: MIT
#include "batch/index_page.h"

#include <string>

#include <gtest/gtest.h>

namespace vantage::batch {
namespace {

TEST(IndexPage, DataCannotEndItsScript) {
  const std::string safe = script_safe(R"(["</script><!--<script>"])");
  EXPECT_EQ(safe.find('<'), std::string::npos);
}

TEST(IndexPage, AsksForNothingFromOutside) {
  const std::string page = index_page("", {"index.html"}, 0, {});
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
}

TEST(IndexPage, AnAddressHoldsEveryByteOfAPath) {
  EXPECT_EQ(url_path("a b/\xFF#?%25\xC3\xA9/~x-y_.z"), "a%20b/%FF%23%3F%2525%C3%A9/~x-y_.z");
}

TEST(IndexPage, OneDuplicateIsToldOfAsOne) {
  const std::string page = index_page("", {"index.html"}, 0, {});
  EXPECT_NE(page.find("page.duplicates === 1 ? \" duplicate\" : \" duplicates\""),
            std::string::npos);
}

}  // namespace
}  // namespace vantage::batch
