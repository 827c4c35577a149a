// SPDX-License-Identifier: MIT
#include "verdigris/learn/checkpoint.h"

#include <gtest/gtest.h>
#include <torch/utils.h>

#include <fstream>
#include <functional>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/safetensors.h"
#include "verdigris/learn/network_parts.h"
#include "verdigris/learn/testing.h"

namespace verdigris {
namespace {

using namespace verdigris::testing;

TrainingFacts some_facts() {
    TrainingFacts f;
    f.sources = {{"plate \"A\"", "", std::string(64, 'a'), {17, 509}, {649, 895}},
                 {"b", std::string(64, 'b'), std::string(64, 'c'), {0, 100}, {200, 300}}};
    f.epoch = 7, f.epochs = 12, f.batch = 4, f.threads = 2, f.device = "cpu";
    f.seed = 0xffffffffffffffffu;
    f.learning_rate = 2e-4, f.weight_decay = 1e-2, f.clip_norm = 1;
    f.validation_error = 1.234e-5, f.validation_persistence = 2e-5;
    f.version = "0.1.0", f.torch = "1.13";
    return f;
}

class Checkpoints : public ::testing::TestWithParam<NetworkKind> {};
INSTANTIATE_TEST_SUITE_P(, Checkpoints, ::testing::ValuesIn(kNetworkKinds),
                         [](const auto& one) { return to_string(one.param); });

TEST_P(Checkpoints, ComeBackToTheBit) {
    const ScratchFolder folder;
    const Network network({.kind = GetParam(), .context = 3, .size = 16}, 4);
    write_checkpoint(folder.path() / "a.safetensors", network, some_facts());
    const Checkpoint back = read_checkpoint(folder.path() / "a.safetensors");
    EXPECT_EQ(back.network->config(), network.config());
    EXPECT_EQ(back.facts, some_facts());
    const auto a = network.parts().module->named_parameters(),
               b = back.network->parts().module->named_parameters();
    ASSERT_EQ(a.size(), b.size());
    for (const auto& item : a) EXPECT_TRUE(torch::equal(item.value(), b[item.key()])) << item.key();
}

/// The sentence of what reading gives after `change`; fails if it reads.
std::string refused(const std::function<void(SafetensorsFile&)>& change) {
    const ScratchFolder folder;
    const auto path = folder.path() / "x.safetensors";
    write_checkpoint(path, Network({.context = 3, .size = 16}), some_facts());
    SafetensorsFile file = read_safetensors(path);
    change(file);
    write_safetensors(path, file);
    try {
        read_checkpoint(path);
    } catch (const Error& e) {
        EXPECT_EQ(e.code(), ErrorCode::bad_input);
        EXPECT_EQ(e.where(), path.string());
        return e.sentence();
    }
    ADD_FAILURE() << "was read";
    return "";
}

TEST(Checkpoint, OfAnotherNetworkIsRefused) {
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.metadata["network"] = R"({"kind":"convlstm","context":3,"size":16})";
              }).find("lacks the weights"),
              std::string::npos);
    // Another context, another first layer.
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.metadata["network"] = R"({"kind":"patinanet","context":4,"size":16})";
              }).find("where the network has"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.metadata["network"] = R"({"kind":"patinanet","context":4000,"size":16})";
              }).find("context"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) { f.metadata["network"] = "[[[[[["; }).find("network"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) { f.metadata.clear(); }).find("no checkpoint"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.metadata["training"] = R"({"sources":[{"recording":5}]})";
              }).find("recording"),
              std::string::npos);
}

// The reader of JSON would make 5 of 5.7 and of 2^32 + 5, 1 of true, and anything of 1e300.
TEST(Checkpoint, WithNumbersThatAreNoneIsRefused) {
    for (const char* context : {"5.7", "4294967299", "true", "1e300", "-3", "\"3\"", "null"}) {
        EXPECT_NE(refused([&](SafetensorsFile& f) {
                      f.metadata["network"] =
                          std::string(R"({"kind":"patinanet","size":16,"context":)") + context +
                          "}";
                  }).find("context"),
                  std::string::npos)
            << context;
    }
    const auto changed = [](const std::string& from, const std::string& to) {
        return refused([&](SafetensorsFile& f) {
            std::string& text = f.metadata["training"];
            const std::size_t at = text.find(from);
            ASSERT_NE(at, std::string::npos) << text;
            text.replace(at, from.size(), to);
        });
    };
    EXPECT_NE(changed("\"stride\":10", "\"stride\":0").find("cannot have been"), std::string::npos);
    EXPECT_NE(changed("\"horizons\":10", "\"horizons\":1e9").find("horizons"), std::string::npos);
    EXPECT_NE(changed("[17,509]", "[17.5,509]").find("train"), std::string::npos);
    EXPECT_NE(changed("\"epoch\":7", "\"epoch\":13").find("cannot have been"), std::string::npos);
    EXPECT_NE(changed("\"augment\":true", "\"augment\":1").find("augment"), std::string::npos);
    // Five million brackets would take half a gigabyte.
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.metadata["network"] = std::string(5'000'000, '[');
              }).find("too long"),
              std::string::npos);
}

TEST(Checkpoint, NamesWhatItLearnedFrom) {
    TrainingFacts f;
    f.sources.resize(3);
    f.sources[0].recording = "a", f.sources[1].recording = "b", f.sources[2].recording = "c";
    EXPECT_EQ(f.source_names(), "a, b and c");
    f.sources.resize(1);
    EXPECT_EQ(f.source_names(), "a");
}

TEST(Checkpoint, WithDamagedTensorsIsRefused) {
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  float nan = std::numeric_limits<float>::quiet_NaN();
                  std::memcpy(f.tensors[1].bytes.data(), &nan, sizeof nan);
              }).find("not finite"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.tensors.push_back(float_tensor("extra", {}, std::vector<float>{1}));
              }).find("extra"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) { f.tensors.pop_back(); }).find("lacks"),
              std::string::npos);
    EXPECT_NE(refused([](SafetensorsFile& f) {
                  f.tensors[0].type = TensorType::i32;
              }).find("where F16, BF16, F32 or F64 is expected"),
              std::string::npos);
}

TEST(Checkpoint, CutAnywhereIsRefused) {
    const ScratchFolder folder;
    const auto path = folder.path() / "x.safetensors";
    write_checkpoint(path, Network({.context = 3, .size = 16}), some_facts());
    const auto bytes = read_file(path);
    for (std::size_t length = 0; length < bytes.size(); length += 1 + length / 3) {
        write_file(path, std::span(bytes.data(), length));
        EXPECT_THROW(read_checkpoint(path), Error) << length;
    }
    EXPECT_THROW(read_checkpoint(folder.path() / "absent.safetensors"), Error);
    EXPECT_THROW(read_checkpoint(folder.path()), Error);
}

TEST(Checkpoint, DataHashIsOfTheSamplesAndTheirRoles) {
    const Observation one = changing_recording(16, 40, "one"),
                      two = changing_recording(16, 40, "two");
    const std::string hash = learned_data_hash(*one.store, {0, 20}, {30, 40});
    EXPECT_EQ(hash, learned_data_hash(*two.store, {0, 20}, {30, 40}));  // names do not matter
    EXPECT_NE(hash, learned_data_hash(*one.store, {0, 21}, {30, 40}));
    EXPECT_NE(hash, learned_data_hash(*one.store, {30, 40}, {0, 20}));
}

}  // namespace
}  // namespace verdigris
