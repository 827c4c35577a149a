// SPDX-License-Identifier: MIT
// How alike the surfaces of recordings are, each with each (docs/PROTOCOL.md, near copies):
//   verdigris_likeness RECORDING...
#include <fmt/core.h>

#include <exception>
#include <string>
#include <vector>

#include "verdigris/evaluate/near_copy.h"
#include "verdigris/observe/observe.h"
#include "verdigris/recording/recording.h"

int main(int count, char** arguments) {
    using namespace verdigris;
    try {
        std::vector<SurfacePrint> prints;
        for (int i = 1; i < count; ++i) {
            ObserveOptions options;
            options.size = 128;  // as `evaluate`
            options.keep = Keep::every_sample;
            const Observation seen = observe(open_recording(arguments[i]), options);
            prints.push_back(surface_print(seen, {0, seen.store->count()}));
            std::string row;
            for (const SurfacePrint& other : prints)
                row += fmt::format(" {:5.2f}", surface_likeness(other, prints.back()));
            fmt::print("{:<28}{}\n", seen.source_name, row);
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
