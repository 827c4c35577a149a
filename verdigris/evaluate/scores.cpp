// SPDX-License-Identifier: MIT
#include "verdigris/evaluate/scores.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "verdigris/error.h"

namespace verdigris {

std::vector<double> horizon_means(const ErrorTable& table) {
    std::vector<double> means(std::size_t(table.horizons));
    for (int k = 0; k < table.horizons; ++k) {
        double sum = 0;
        for (int w = 0; w < table.windows; ++w) sum += table.at(w, k);
        means[std::size_t(k)] = sum / table.windows;
    }
    return means;
}

std::vector<double> known_means(const ErrorTable& table) {
    std::vector<double> means;
    for (int k = 0; k < table.horizons; ++k) {
        double sum = 0, count = 0;
        for (int w = 0; w < table.windows; ++w) {
            if (!std::isfinite(table.at(w, k))) continue;
            sum += table.at(w, k);
            ++count;
        }
        means.push_back(count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN());
    }
    return means;
}

double overall_mean(const ErrorTable& table) {
    double sum = 0;
    for (const double m : horizon_means(table)) sum += m;
    return sum / table.horizons;
}

std::vector<double> window_means(const ErrorTable& table) {
    std::vector<double> means(std::size_t(table.windows));
    for (int w = 0; w < table.windows; ++w) {
        double sum = 0;
        for (int k = 0; k < table.horizons; ++k) sum += table.at(w, k);
        means[std::size_t(w)] = sum / table.horizons;
    }
    return means;
}

double gain_over(double model_mean, double reference_mean) {
    if (reference_mean == 0) return std::numeric_limits<double>::quiet_NaN();
    return 1 - model_mean / reference_mean;
}

std::string Direction::label() const {
    if (sources.empty()) return "within " + held_out;
    return fmt::format("{} -> {}", fmt::join(sources, " + "), held_out);
}

const EntrantScores& Direction::entrant(const std::string& name) const {
    std::vector<std::string> names;
    for (const EntrantScores& e : entrants) {
        if (e.name == name) return e;
        names.push_back(e.name);
    }
    throw Error(ErrorCode::usage, fmt::format("no forecaster '{}' was evaluated; there are: {}",
                                              name, fmt::join(names, ", ")));
}

double gain(const Direction& direction, const EntrantScores& entrant) {
    return gain_over(overall_mean(entrant.foreground),
                     overall_mean(direction.persistence().foreground));
}

std::vector<double> horizon_gains(const Direction& direction, const EntrantScores& entrant) {
    const std::vector<double> model = horizon_means(entrant.foreground),
                              held = horizon_means(direction.persistence().foreground);
    std::vector<double> gains;
    for (std::size_t k = 0; k < model.size(); ++k) gains.push_back(gain_over(model[k], held[k]));
    return gains;
}

}  // namespace verdigris
