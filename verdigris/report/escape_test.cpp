// SPDX-License-Identifier: MIT
#include "verdigris/report/escape.h"

#include <gtest/gtest.h>

#include <string>

namespace verdigris {
namespace {

TEST(Escape, HtmlHoldsNoMarkup) {
    EXPECT_EQ(html_text("<b a=\"1\" c='2'>&amp;</b>"),
              "&lt;b a=&quot;1&quot; c=&#39;2&#39;&gt;&amp;amp;&lt;/b&gt;");
    EXPECT_EQ(html_text("ΔE₀₀ ≤ 1"), "ΔE₀₀ ≤ 1");
}

TEST(Escape, BytesThatAreNoUtf8AreReplacedNotPassedOn) {
    const std::string replaced = "\xef\xbf\xbd";
    EXPECT_EQ(html_text("a\xff"
                        "b"),
              "a" + replaced + "b");
    EXPECT_EQ(one_line("\xc0\xaf"), replaced + replaced);        // overlong "/"
    EXPECT_EQ(one_line("\xed\xa0\x80").substr(0, 3), replaced);  // a surrogate
    EXPECT_EQ(one_line("\xe2\x82"), replaced + replaced);        // cut off
    EXPECT_EQ(one_line("a\nb\tc\x7f"), "a b c ");
    EXPECT_EQ(html_text(std::string("a\0b", 3)), "a b");
    EXPECT_EQ(one_line("\xf0\x9f\x98\x80"), "\xf0\x9f\x98\x80");  // four bytes
}

TEST(Escape, LatexKnownAnswers) {
    EXPECT_EQ(latex_text("50 % of a_b & c #1 ~ ^ {x} $y \\z"),
              "50 \\% of a\\_b \\& c \\#1 \\textasciitilde{} \\textasciicircum{} \\{x\\} \\$y "
              "\\textbackslash{}z");
    EXPECT_EQ(latex_text("−0.5 ± 0.1"), "$-$0.5 $\\pm$ 0.1");
    EXPECT_EQ(latex_text("ΔE₀₀, τ ≤ 2σ"), "$\\Delta$E$_{0}$$_{0}$, $\\tau$ $\\leq$ 2$\\sigma$");
    EXPECT_EQ(latex_text("1.2×10⁻³"), "1.2$\\times$10$^{-}$$^{3}$");
    EXPECT_EQ(latex_text("café"), "café");
    EXPECT_EQ(latex_text("中"), "{[}U+4E2D{]}");
    EXPECT_EQ(latex_text("[1, 2]"), "{[}1, 2{]}");
    EXPECT_EQ(latex_text("a\nb"), "a b");
}

TEST(Escape, IdsAreFileNamesAndLabels) {
    EXPECT_TRUE(is_plain_id("gains-by_block2"));
    for (const char* bad : {"", "a b", "../x", "a.b", "ä", "a/b"}) EXPECT_FALSE(is_plain_id(bad));
    EXPECT_FALSE(is_plain_id(std::string(81, 'a')));
}

TEST(Escape, CharactersAreCountedNotBytes) {
    EXPECT_EQ(character_count("ΔE₀₀"), 4);
    EXPECT_EQ(character_count(""), 0);
}

}  // namespace
}  // namespace verdigris
