// SPDX-License-Identifier: MIT
#include "verdigris/workflow/task_record.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "verdigris-task/1";

std::string text(RecordState state) {
    return state == RecordState::done ? "done" : state == RecordState::failed ? "failed" : "begun";
}

Json json_of(const std::map<std::string, Fingerprint>& prints) {
    Json out = Json::object();
    for (const auto& [path, print] : prints)
        out[path] = {{"stamp", print.stamp}, {"content", print.content}};
    return out;
}

std::map<std::string, Fingerprint> prints_from(const Json& json) {
    std::map<std::string, Fingerprint> prints;
    for (const auto& [path, print] : json.items())
        prints[path] = {print.at("stamp").get<std::string>(),
                        print.at("content").get<std::string>()};
    return prints;
}

std::map<std::string, Fingerprint> prints_of(const fs::path& folder,
                                             const std::vector<fs::path>& paths,
                                             const std::map<std::string, Fingerprint>& known) {
    std::map<std::string, Fingerprint> prints;
    for (const fs::path& path : paths) {
        const auto before = known.find(path.string());
        prints[path.string()] = fingerprint(
            folder / path,
            before == known.end() ? std::nullopt : std::optional<Fingerprint>(before->second));
    }
    return prints;
}

}  // namespace

fs::path record_path(const fs::path& folder, const Task& task) {
    return folder / "tasks" / (task.id + ".json");
}
fs::path log_path(const fs::path& folder, const Task& task) {
    return folder / "tasks" / (task.id + ".log");
}

std::optional<TaskRecord> read_record(const fs::path& folder, const Task& task) {
    std::error_code error;
    const fs::path path = record_path(folder, task);
    if (!fs::is_regular_file(path, error)) return {};
    try {
        const Json json = Json::parse(read_text(path, 1 << 22));
        if (json.at("format") != kFormat || json.at("id") != task.id) return {};
        TaskRecord record;
        const std::string state = json.at("state");
        record.state = state == "done"     ? RecordState::done
                       : state == "failed" ? RecordState::failed
                                           : RecordState::begun;
        record.command = json.at("command").get<std::vector<std::string>>();
        record.version = json.at("version");
        record.build = json.at("build");
        record.inputs = prints_from(json.at("inputs"));
        record.outputs = prints_from(json.at("outputs"));
        record.wall_seconds = json.at("wall_seconds");
        record.cpu_seconds = json.at("cpu_seconds");
        record.threads = json.at("threads");
        record.exit_status = json.at("exit_status");
        return record;
    } catch (const nlohmann::json::exception&) {
        return {};
    } catch (const Error&) {
        return {};
    }
}

void write_record(const fs::path& folder, const Task& task, const TaskRecord& record) {
    const Json json = {{"format", kFormat},
                       {"id", task.id},
                       {"title", task.title},
                       {"state", text(record.state)},
                       {"command", record.command},
                       {"version", record.version},
                       {"build", record.build},
                       {"inputs", json_of(record.inputs)},
                       {"outputs", json_of(record.outputs)},
                       {"wall_seconds", record.wall_seconds},
                       {"cpu_seconds", record.cpu_seconds},
                       {"threads", record.threads},
                       {"exit_status", record.exit_status}};
    write_file(record_path(folder, task),
               json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::map<std::string, Fingerprint> input_prints(const fs::path& folder, const Task& task,
                                                const std::optional<TaskRecord>& known) {
    return prints_of(folder, task.inputs,
                     known ? known->inputs : std::map<std::string, Fingerprint>());
}

std::map<std::string, Fingerprint> output_prints(const fs::path& folder, const Task& task,
                                                 const std::optional<TaskRecord>& known) {
    return prints_of(folder, all_outputs(task),
                     known ? known->outputs : std::map<std::string, Fingerprint>());
}

bool same_work(const TaskRecord& record, const Task& task, const std::string& version,
               const std::map<std::string, Fingerprint>& inputs) {
    return record.command == task.arguments && record.version == version &&
           std::ranges::equal(record.inputs, inputs, [](const auto& a, const auto& b) {
               return a.first == b.first && a.second.content == b.second.content;
           });
}

}  // namespace verdigris
