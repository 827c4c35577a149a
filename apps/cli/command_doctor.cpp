// SPDX-License-Identifier: MIT
// What this build can do on this machine, and what each missing piece costs.
extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hwy/highway.h>
#include <filesystem>
#include <thread>

#include "commands.h"
#include "learned.h"
#include "verdigris/deliver/deliver.h"
#include "verdigris/report/child_process.h"
#include "verdigris/report/page.h"

namespace verdigris::cli {
namespace fs = std::filesystem;
namespace {

std::string version_text(unsigned v) {
    return fmt::format("{}.{}.{}", v >> 16, (v >> 8) & 255, v & 255);
}

void run(Session& session) {
    const auto line = [&](const std::string& name, const std::string& text) {
        session.say(fmt::format("{:<14}{}", name, text));
    };
    Json out;
    out["version"] = VERDIGRIS_VERSION;
    line("verdigris", VERDIGRIS_VERSION);
    line("ffmpeg libs",
         fmt::format("libavformat {}, libavcodec {}", version_text(avformat_version()),
                     version_text(avcodec_version())));
    out["libavformat"] = version_text(avformat_version());
    out["libavcodec"] = version_text(avcodec_version());

    Json decoders = Json::object();
    std::vector<std::string> have, lack;
    for (const char* name : {"h264", "hevc", "mjpeg", "vp9", "av1", "ffv1"}) {
        const AVCodecDescriptor* codec = avcodec_descriptor_get_by_name(name);
        const bool found = codec && avcodec_find_decoder(codec->id);
        decoders[name] = found;
        (found ? have : lack).emplace_back(name);
    }
    out["decoders"] = decoders;
    line("decoders", fmt::format("{}", fmt::join(have, ", ")));
    if (!lack.empty()) {
        line("", fmt::format("missing: {} (videos in these codecs are refused; install "
                             "libavcodec-extra)",
                             fmt::join(lack, ", ")));
    }

    std::vector<std::string> targets;
    const auto supported = hwy::SupportedTargets();
    for (auto bits = supported; bits != 0; bits &= bits - 1) {
        targets.emplace_back(hwy::TargetName(bits & -bits));
    }
    out["cpu_threads"] = std::thread::hardware_concurrency();
    out["simd"] = targets;
    line("processor", fmt::format("{} threads; vector code for {}",
                                  std::thread::hardware_concurrency(), fmt::join(targets, ", ")));
    out["viewer_built_in"] = viewer_is_built_in();
    line("viewer", viewer_is_built_in()
                       ? "built in"
                       : "missing: `age` writes no viewer.html; build with node >= 18 and npm");

    out["report_interactive"] = report_is_interactive();
    line("reports", report_is_interactive()
                        ? "with interactive charts"
                        : "without interactive charts: built without node >= 18 and npm");

    const std::string no_networks = no_networks_because();
    out["networks"] = no_networks.empty();
    line("networks", no_networks.empty()
                         ? "built in: `train`, `susceptibility`, `study`, and LPIPS with weights"
                         : no_networks + "; LPIPS is n/a");

    struct Program {
        const char *name, *use, *cost;
    };
    Json programs = Json::object();
    for (const Program& p :
         {Program{"gnuplot", "draws the figures of a report",
                  "figures are left out, tables are written; install gnuplot-nox"},
          Program{"xdg-open", "opens the viewer", "`view` only prints the path; open it yourself"},
          Program{"chromium", "one browser that shows the viewer", "any other browser will do"},
          Program{"blender", "imports aged.glb and the textures",
                  "nothing: files are made without it"},
          Program{"ffmpeg", "makes test clips", "only some tests are skipped"}}) {
        const fs::path path = find_program(p.name);
        programs[p.name] = !path.empty();
        line(p.name, path.empty() ? fmt::format("not found ({}); without it: {}", p.use, p.cost)
                                  : fmt::format("found ({})", p.use));
    }
    out["programs"] = programs;
    session.result(out);
}

}  // namespace

void add_doctor(CLI::App& app, Session& session) {
    CLI::App* command =
        app.add_subcommand("doctor", "Versions, CPU features, what is missing and what it costs");
    session.add_options(*command);
    command->callback([&session] { session.action = [](Session& s) { run(s); }; });
}

}  // namespace verdigris::cli
