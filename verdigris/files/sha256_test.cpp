// SPDX-License-Identifier: MIT
#include "verdigris/files/sha256.h"

#include <gtest/gtest.h>

#include <string>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

std::string hash(std::string_view text) {
    Sha256 sha;
    sha.update(text);
    return sha.hex();
}

// The examples of [FIPS180], one and two blocks and a million letters.
TEST(Sha256, MatchesThePublishedExamples) {
    EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(hash(std::string(1000000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, DoesNotDependOnThePieces) {
    Sha256 sha;
    sha.update("ab");
    Sha256 moved = std::move(sha);
    moved.update("");
    moved.update("c");
    EXPECT_EQ(moved.hex(), hash("abc"));
}

TEST(Sha256, StreamsFiles) {
    const ScratchFolder folder;
    const std::string text(3'000'000, 'v');  // more than one block of the reader
    write_file(folder / "a", text);
    EXPECT_EQ(sha256_of_file(folder / "a"), hash(text));
    EXPECT_EQ(error_of([&] { sha256_of_file(folder / "b"); }).sentence(), "does not exist");
    EXPECT_EQ(error_of([&] { sha256_of_file(folder.path()); }).code(), ErrorCode::bad_input);
}

}  // namespace
}  // namespace verdigris
