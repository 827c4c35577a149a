// SPDX-License-Identifier: MIT
#include "verdigris/workflow/task_record.h"

#include <gtest/gtest.h>

#include "verdigris/workflow/testing.h"

namespace verdigris {
namespace {
namespace fs = std::filesystem;

TEST(Fingerprint, IsOfBytesAndNames) {
    const ScratchFolder folder;
    write_file(folder / "a/x", "1");
    write_file(folder / "a/y", "2");
    const Fingerprint before = fingerprint(folder / "a");
    write_file(folder / "a/.half", "no part of it");
    EXPECT_EQ(fingerprint(folder / "a").content, before.content);
    // Written again with the same bytes: another stamp, the same content.
    write_file(folder / "a/y", "2");
    EXPECT_NE(fingerprint(folder / "a").stamp, before.stamp);
    EXPECT_EQ(fingerprint(folder / "a", before).content, before.content);
    write_file(folder / "a/y", "3");
    EXPECT_NE(fingerprint(folder / "a", before).content, before.content);
    write_file(folder / "a/y", "2");
    fs::rename(folder / "a/y", folder / "a/z");
    EXPECT_NE(fingerprint(folder / "a").content, before.content);
    EXPECT_THROW(fingerprint(folder / "nowhere"), Error);
    write_file(folder / "f", "1");
    const Fingerprint file = fingerprint(folder / "f");
    EXPECT_EQ(fingerprint(folder / "f", Fingerprint{file.stamp, "known"}).content, "known")
        << "read though nothing has changed";
}

TEST(TaskRecord, ReadsBackWhatWasWritten) {
    const ScratchFolder folder;
    const Task task = shell_task("a", "true", {"in"}, {"out"});
    EXPECT_FALSE(read_record(folder.path(), task));
    TaskRecord record;
    record.state = RecordState::failed;
    record.command = {"-c", "a \"b\" \xff"};
    record.version = "0.1.0";
    record.inputs["in"] = {"s", "c"};
    record.wall_seconds = 1.5;
    record.cpu_seconds = 2.5;
    record.threads = 3;
    record.exit_status = 4;
    write_record(folder.path(), task, record);
    const auto read = read_record(folder.path(), task);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->state, RecordState::failed);
    EXPECT_EQ(read->version, "0.1.0");
    EXPECT_EQ(read->inputs.at("in").content, "c");
    EXPECT_EQ(read->wall_seconds, 1.5);
    EXPECT_EQ(read->threads, 3);
    EXPECT_EQ(read->exit_status, 4);
}

TEST(TaskRecord, OfADamagedFileThereIsNone) {
    const ScratchFolder folder;
    const Task task = shell_task("a", "true", {}, {"out"});
    write_record(folder.path(), task, {});
    const std::string whole = read_text(record_path(folder.path(), task));
    write_file(record_path(folder.path(), task), whole.substr(0, whole.size() / 2));
    EXPECT_FALSE(read_record(folder.path(), task));
    write_file(record_path(folder.path(), task), "{\"format\": 3}");
    EXPECT_FALSE(read_record(folder.path(), task));
}

TEST(TaskRecord, IsOfTheSameWorkOnlyIfNothingDiffers) {
    const Task task = shell_task("a", "true", {"in"}, {"out"});
    TaskRecord record;
    record.command = task.arguments;
    record.version = "1";
    record.inputs["in"] = {"s", "c"};
    EXPECT_TRUE(same_work(record, task, "1", {{"in", {"another stamp", "c"}}}));
    EXPECT_FALSE(same_work(record, task, "2", {{"in", {"s", "c"}}}));
    EXPECT_FALSE(same_work(record, task, "1", {{"in", {"s", "d"}}}));
    EXPECT_FALSE(same_work(record, task, "1", {}));
    record.command.push_back("more");
    EXPECT_FALSE(same_work(record, task, "1", {{"in", {"s", "c"}}}));
}

}  // namespace
}  // namespace verdigris
