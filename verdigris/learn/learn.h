// SPDX-License-Identifier: MIT
// Trained forecasters: four networks that learn from one recording how its frames go on, each
// handed over as a Forecaster like any other. Optional: the only room that needs libtorch.
// Path: evaluate, forecast -> [learn].   Model: docs/models/learn.md
//
// Nothing in this header, nor in any that users include, names libtorch.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "verdigris/forecast/forecast.h"

namespace verdigris {

enum class NetworkKind {
    patinanet,   ///< a growing state per pixel, paced globally, spread by a static susceptibility
    convlstm,    ///< convolutional recurrence, encoder and forecaster
    predformer,  ///< gated attention over time and space in turn
    horizonnet,  ///< encodes once, answers any horizon in one pass
};
inline constexpr NetworkKind kNetworkKinds[] = {NetworkKind::patinanet, NetworkKind::convlstm,
                                                NetworkKind::predformer, NetworkKind::horizonnet};
std::string to_string(NetworkKind kind);  ///< "patinanet", ...
/// Throws Error{usage} listing the names.
NetworkKind network_kind(std::string_view name);

/// What the shape of a network depends on.
struct NetworkConfig {
    NetworkKind kind{NetworkKind::patinanet};
    int context = 5;  ///< frames observed, one unit apart
    int size = 128;   ///< side of the frames it is trained on; a multiple of 8
    bool operator==(const NetworkConfig&) const = default;
};
/// Throws Error{usage}: context in 2 .. 64, size in 16 .. 1024 and a multiple of 8.
void check_network_config(const NetworkConfig& config);

enum class Device { cpu, cuda };
/// Throws Error{usage} for another name; Error{failed} for "cuda" where there is none.
Device device_from(std::string_view name);
/// Of the whole process: threads (at least 1) for libtorch, whose own default is half of the cores,
/// and for OpenBLAS; and memory that networks free is kept for their next step.
void use_cpu_for_networks(int threads);

/// A network and its weights. Shared by forecasters; never changes once they have it.
class Network {
  public:
    struct Parts;  // libtorch's side
    /// Freshly initialized; same seed, same weights. Throws as check_network_config.
    explicit Network(const NetworkConfig& config, std::uint64_t seed = 0);
    ~Network();
    Network(Network&&) noexcept;
    Network& operator=(Network&&) noexcept;

    const NetworkConfig& config() const;
    /// Trainable numbers: 170,623 of patinanet, 1,653,000 of convlstm, 1,668,288 of predformer and
    /// 920,227 of horizonnet for five frames of 128 x 128.
    std::int64_t parameter_count() const;
    /// Where it computes from now on. Throws Error{failed} for cuda where there is none.
    void move_to(Device device);
    Parts& parts() const { return *parts_; }

  private:
    std::unique_ptr<Parts> parts_;
};

/// Forecasts the units in `horizons` (from 1, increasing), linear in between and from the last
/// frame on; it answers nothing beyond. Frames of another size than the network's are reduced to
/// it, and the change that it forecasts is enlarged and added to the last frame: detail stays, and
/// the network sees what it was trained on. The forecast function can be called from several
/// threads; it works on one window at a time. Throws Error{usage} for horizons that do not increase
/// or are over 1000; the function throws it where the context has other than config().context
/// frames.
Forecaster as_forecaster(std::shared_ptr<const Network> network, std::string name,
                         std::vector<int> horizons);
/// 1 .. last.
std::vector<int> units_to(int last);

}  // namespace verdigris
