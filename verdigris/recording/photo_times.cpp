// SPDX-License-Identifier: MIT
#include "verdigris/recording/photo_times.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

#include "verdigris/error.h"
#include "verdigris/recording/times_csv.h"

namespace verdigris {
namespace {

// Sorts by time; photographs of one time keep the order of their names.
void sort_by_time(std::vector<Photo>& photos, std::vector<double>& times, const std::string& source,
                  RecordingInfo& info) {
    const int backward = backward_steps(times);
    if (backward == 0) return;
    const std::string count =
        std::to_string(backward) + " of " + std::to_string(times.size() - 1) + " steps";
    if (2 * std::size_t(backward) > times.size() - 1) {
        throw Error(ErrorCode::bad_input,
                    "the times from " + source + " run backwards against the file names in " +
                        count + "; rename the files or correct the times",
                    info.path.string());
    }
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    std::vector<Photo> sorted_photos;
    std::vector<double> sorted_times;
    for (std::size_t i : order) {
        sorted_photos.push_back(std::move(photos[i]));
        sorted_times.push_back(times[i]);
    }
    photos = std::move(sorted_photos);
    times = std::move(sorted_times);
    info.notes.push_back({"times_reordered", Severity::caution,
                          "the times from " + source + " run against the file names in " + count +
                              "; the photographs are ordered by time"});
}

// A camera that writes whole seconds gives a burst one time: spread over that second, in order.
bool spread_within_seconds(std::vector<double>& times) {
    bool spread = false;
    for (std::size_t begin = 0, end = 0; begin < times.size(); begin = end) {
        while (end < times.size() && times[end] == times[begin]) ++end;
        if (end - begin < 2 || times[begin] != std::floor(times[begin])) continue;
        const double whole = times[begin];
        for (std::size_t i = begin; i < end; ++i) {
            times[i] = whole + double(i - begin) / double(end - begin);
        }
        spread = true;
    }
    return spread;
}

bool all_have_exif_times(const std::vector<Photo>& photos) {
    const Photo* first = nullptr;
    bool differ = false;
    for (const Photo& photo : photos) {
        if (!photo.broken.empty()) continue;
        if (!photo.info.taken) return false;
        if (!first) first = &photo;
        differ = differ || *photo.info.taken != *first->info.taken;
    }
    return differ;
}

void take_exif(std::vector<Photo>& photos, std::vector<double>& times, RecordingInfo& info) {
    const auto unknown = std::erase_if(photos, [](const Photo& p) { return !p.broken.empty(); });
    if (unknown > 0) {
        info.notes.push_back({"unreadable_pictures", Severity::caution,
                              std::to_string(unknown) +
                                  " pictures cannot be read and have no known time: left out"});
    }
    for (const Photo& photo : photos) times.push_back(*photo.info.taken);
    info.time_source = TimeSource::exif;
    sort_by_time(photos, times, "EXIF", info);
    if (spread_within_seconds(times)) {
        info.notes.push_back({"times_spread", Severity::info,
                              "photographs of one second (EXIF) are spread over it evenly, in the "
                              "order of their names"});
    }
}

}  // namespace

void time_photos(std::vector<Photo>& photos, const std::filesystem::path& sidecar,
                 RecordingInfo& info) {
    std::vector<double> times;
    if (!sidecar.empty()) {
        std::vector<std::string> names;
        for (const Photo& photo : photos) names.push_back(photo.name);
        times = TimesCsv(sidecar).by_file(names);
        info.time_source = TimeSource::sidecar;
        sort_by_time(photos, times, "times.csv", info);
    } else if (all_have_exif_times(photos)) {
        take_exif(photos, times, info);
    } else {
        for (std::size_t i = 0; i < photos.size(); ++i) times.push_back(double(i));
        info.time_source = TimeSource::file_order;
        info.notes.push_back({"no_times", Severity::caution,
                              "nothing says when the pictures were taken: they are taken as evenly "
                              "spaced, 1 s apart, in the order of their names; write times.csv "
                              "(columns file, time) if they are not"});
    }
    const double first = times.empty() ? 0 : times.front();
    for (double& t : times) t -= first;
    info.times = std::move(times);
    info.variable_rate = has_variable_rate(info.times, 0);
}

}  // namespace verdigris
