// SPDX-License-Identifier: MIT
#include "verdigris/deliver/text_wrap.h"

#include <gtest/gtest.h>

namespace verdigris {
namespace {

const std::string kEllipsis = "\xE2\x80\xA6";

// Every character is one wide.
double characters(const std::string& text) {
    int count = 0;
    for (char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    return count;
}

TEST(Wrapped, BreaksAtSpaces) {
    EXPECT_EQ(wrapped("the quick brown fox", 9, 10, characters),
              (std::vector<std::string>{"the quick", "brown fox"}));
    EXPECT_EQ(wrapped("  two   spaces ", 20, 10, characters),
              (std::vector<std::string>{"two spaces"}));
    EXPECT_TRUE(wrapped("", 9, 10, characters).empty());
}

TEST(Wrapped, BreaksAWordOnlyIfItAloneIsTooWide) {
    EXPECT_EQ(wrapped("a abcdefgh b", 4, 10, characters),
              (std::vector<std::string>{"a", "abcd", "efgh", "b"}));
    EXPECT_EQ(wrapped("\xC3\xBC\xC3\xBC\xC3\xBC", 2, 10, characters),
              (std::vector<std::string>{"\xC3\xBC\xC3\xBC", "\xC3\xBC"}));
}

TEST(Wrapped, EndsWithAnEllipsisWhereLinesRunOut) {
    EXPECT_EQ(wrapped("one two three four", 8, 2, characters),
              (std::vector<std::string>{"one two", "three f" + kEllipsis}));
    EXPECT_EQ(wrapped("abcdefghij", 4, 1, characters),
              (std::vector<std::string>{"abc" + kEllipsis}));
    EXPECT_EQ(wrapped("one two", 8, 1, characters), (std::vector<std::string>{"one two"}));
}

TEST(Wrapped, NeverExceedsWidthOrLines) {
    const std::string text = "Lorem ipsum dolor sit amet, consecteturadipiscingelit sed do.";
    for (int width = 2; width < 70; ++width) {
        for (int lines = 1; lines < 9; ++lines) {
            const std::vector<std::string> result = wrapped(text, width, lines, characters);
            EXPECT_LE(int(result.size()), lines);
            for (const std::string& line : result) EXPECT_LE(characters(line), width) << line;
        }
    }
}

TEST(Wrapped, EndsEvenIfNotOneCharacterFits) {
    EXPECT_EQ(wrapped("ab", 0.5, 9, characters), (std::vector<std::string>{"a", "b"}));
}

TEST(Ellipsized, KeepsWhatFits) {
    EXPECT_EQ(ellipsized("short", 5, characters), "short");
    EXPECT_EQ(ellipsized("longer", 5, characters), "long" + kEllipsis);
}

TEST(Printable, RepairsHostileText) {
    EXPECT_EQ(printable("a\nb\tc\x7F"), "a b c ");
    EXPECT_EQ(printable("\xE6\x97\xA5"), "\xE6\x97\xA5");
    EXPECT_EQ(printable("\xFFx"), "\xEF\xBF\xBDx");
    EXPECT_EQ(printable("\xE6\x97"), "\xEF\xBF\xBD\xEF\xBF\xBD");
    EXPECT_EQ(printable("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");  // overlong
    EXPECT_EQ(printable("\xED\xA0\x80").size(), 9u);               // a surrogate
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a b");
}

}  // namespace
}  // namespace verdigris
