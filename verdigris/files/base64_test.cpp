// SPDX-License-Identifier: MIT
#include "verdigris/files/base64.h"

#include <gtest/gtest.h>

#include <span>
#include <string>

namespace verdigris {
namespace {

std::string encoded(const std::string& text) {
    return base64(std::as_bytes(std::span(text.data(), text.size())));
}

TEST(Base64, Rfc4648Vectors) {
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg==");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encoded("\xFB\xFF"), "+/8=");
}

}  // namespace
}  // namespace verdigris
