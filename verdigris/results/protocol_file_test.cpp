// SPDX-License-Identifier: MIT
#include "verdigris/results/protocol_file.h"

#include <gtest/gtest.h>

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/testing.h"

namespace verdigris {
namespace {

class ProtocolFile : public testing::Test {
  protected:
    std::filesystem::path file(const std::string& text) {
        write_file(folder_ / "paper.toml", text);
        return folder_ / "paper.toml";
    }
    std::string refused(const std::string& text) {
        const Error e = error_of([&] { read_protocol(file(text)); });
        EXPECT_EQ(e.code(), ErrorCode::bad_input);
        const std::string what = e.what();
        return what.substr(what.find("paper.toml"));
    }
    ScratchFolder folder_;
};

TEST_F(ProtocolFile, WhatIsWrittenReadsBack) {
    EvaluationProtocol p;
    p.context = 10;
    p.tau = 0.002;
    p.embargo = 30;
    p.area = EvaluatedArea::specimen;
    p.mask = MaskRule::per_horizon;
    p.hold_out = "plate \"A\" \\ 2";
    EXPECT_EQ(read_protocol(file(protocol_text(p))).hold_out, p.hold_out);
    p.single = true;
    EXPECT_NE(refused(protocol_text(p)).find("single holds nothing out"), std::string::npos);
    p.hold_out.clear();
    EXPECT_EQ(protocol_text(read_protocol(file(protocol_text(p)))), protocol_text(p));
    EXPECT_EQ(protocol_text(read_protocol(file(""))), protocol_text(EvaluationProtocol()));
    const EvaluationProtocol back = read_protocol(file(protocol_text(p)));
    EXPECT_EQ(back.context, 10);
    EXPECT_EQ(back.tau, 0.002);
    EXPECT_EQ(back.embargo, 30);
    EXPECT_EQ(back.area, EvaluatedArea::specimen);
}

TEST_F(ProtocolFile, ABadOneIsRefusedWithItsLine) {
    EXPECT_NE(refused("context = 5\ncontxt = 3\n").find("line 2: there is no key 'contxt'"),
              std::string::npos);
    EXPECT_NE(refused("\ncontext = -5\n").find("line 2: context"), std::string::npos);
    EXPECT_NE(refused("area = \"plate\"\n")
                  .find("line 1: area cannot be this; allowed are "
                        "\"frame\" and \"specimen\""),
              std::string::npos);
    EXPECT_NE(refused("train_fraction = 0.9\n").find("line 1: "), std::string::npos)
        << "splits that overlap";
    EXPECT_NE(refused("context 5\n").find("line 1: is not TOML"), std::string::npos);
}

TEST_F(ProtocolFile, BlocksAreSpansOfARecording) {
    const auto blocks = read_blocks(file("[air]\nlate = [50, 98.4]\nearly = [0, 50]\n"));
    ASSERT_EQ(blocks.size(), 2u);
    EXPECT_EQ(blocks[0].name, "early");
    EXPECT_EQ(blocks[1].end, 98.4);
    EXPECT_EQ(error_of([&] { read_blocks(file("[a]\nx = [0, 5]\ny = [4, 6]\n")); }).code(),
              ErrorCode::bad_input);
    EXPECT_EQ(error_of([&] { read_blocks(file("[a]\nx = [5, 5]\n")); }).code(),
              ErrorCode::bad_input);
    EXPECT_EQ(error_of([&] { read_blocks(file("x = 3\n")); }).code(), ErrorCode::bad_input);
}

}  // namespace
}  // namespace verdigris
