// SPDX-License-Identifier: MIT
// Text of unknown origin (file names, titles; UTF-8 as in [RFC3629]) inside other languages, where
// some characters mean something.
#pragma once

#include <string>
#include <string_view>

namespace verdigris {

/// For element content and for attributes in either kind of quotes. Bytes that are no UTF-8 and
/// characters that no page may hold become U+FFFD.
std::string html_text(std::string_view text);

/// For running text under pdflatex with its default encodings. Greek letters, signs and sub- or
/// superscript digits become mathematics; a character that pdflatex has no glyph for is written by
/// its number, "[U+4E2D]", because an unknown one would stop the run.
std::string latex_text(std::string_view text);

/// What may follow "fig:" or "tab:" or name a file: letters, digits, "-" and "_", at most 80.
bool is_plain_id(std::string_view id);

/// Number of characters: a width in a terminal, for scripts without double-width characters.
int character_count(std::string_view text);

/// The first or the last `count` characters, on one line.
std::string first_characters(std::string_view text, int count);
std::string last_characters(std::string_view text, int count);

/// `text` as valid UTF-8 on one line: what is no UTF-8 becomes U+FFFD, control characters a space.
std::string one_line(std::string_view text);

}  // namespace verdigris
