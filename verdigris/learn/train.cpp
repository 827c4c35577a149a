// SPDX-License-Identifier: MIT
#include "verdigris/learn/train.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <torch/types.h>
#include <torch/utils.h>
#include <torch/version.h>
// It names torch::stack and friends without including them.
#include <torch/nn/utils/clip_grad.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <thread>

#include "verdigris/error.h"
#include "verdigris/files/atomic_file.h"
#include "verdigris/files/folder_lock.h"
#include "verdigris/learn/augment.h"
#include "verdigris/learn/network_parts.h"
#include "verdigris/learn/training_set.h"
#include "verdigris/learn/training_state.h"
#include "verdigris/learn/validation.h"

namespace verdigris {
namespace fs = std::filesystem;
namespace {

/// Horizons a step is trained on and their weights in the loss. horizonnet answers each horizon by
/// itself at full cost: one from each of three strata stands for its stratum. Of step alone.
struct Horizons {
    std::vector<int> units;
    torch::Tensor weights;
};
Horizons horizons_of_step(NetworkKind kind, int horizons, std::uint64_t seed, std::int64_t step) {
    Horizons h;
    if (kind != NetworkKind::horizonnet || horizons < 4) {
        h.units = units_to(horizons);
        h.weights = torch::full({horizons}, 1.0 / horizons);
        return h;
    }
    std::vector<float> weights;
    for (int i = 0; i < 3; ++i) {
        const int begin = horizons * i / 3, end = horizons * (i + 1) / 3;
        const std::vector<int> order =
            shuffled(end - begin, seed + 1 + std::uint64_t(i), int(step));
        h.units.push_back(begin + 1 + order.front());
        weights.push_back(float(end - begin) / float(horizons));
    }
    h.weights = torch::tensor(weights);
    return h;
}

class Trainer {
  public:
    Trainer(const EvaluationProtocol& protocol, const std::vector<TrainingSource>& sources,
            const TrainOptions& options, const fs::path& folder, const Progress& progress)
        : protocol_(protocol),
          sources_(sources),
          options_(options),
          folder_(folder),
          progress_(progress),
          threads_(options.threads > 0 ? options.threads
                                       : int(std::max(1u, std::thread::hardware_concurrency()))),
          config_{options.kind, protocol.context,
                  learned_size(sources.front().observation->width(),
                               sources.front().observation->height())} {
        for (const TrainingSource& source : sources) add(source);
        set_facts();
        use_cpu_for_networks(threads_);
        network_ = std::make_shared<Network>(config_, options.seed);
        network_->move_to(options.device);
        optimizer_ = make_optimizer(module(), options.learning_rate, options.weight_decay);
        steps_per_epoch_ = (int(chosen_.size()) + options.batch - 1) / options.batch;
        persistence_ = persistence_error();
    }

    TrainedNetwork run(const EpochDone& epoch_done) {
        const FolderLock lock(folder_, "trained into");
        resume_or_begin();
        for (int epoch = int(epochs_.size()) + 1; epoch <= options_.epochs; ++epoch) {
            const auto start = std::chrono::steady_clock::now();
            EpochRecord record;
            record.epoch = epoch;
            train_epoch(record);
            record.learning_rate = learning_rate(std::int64_t(epoch) * steps_per_epoch_);
            const ValidationErrors errors = validation_errors();
            record.validation_error = errors.network;
            record.validation_persistence = errors.persistence;
            if (!std::isfinite(errors.network)) fail_diverged("validation error", epoch, "the end");
            record.seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            save(record);
            if (epoch_done) epoch_done(record);
        }
        Checkpoint best = read_checkpoint(folder_ / kBestFile);
        return {best.network, best.facts, epochs_};
    }

  private:
    /// A training window: of which source, and which of its windows.
    struct Window {
        std::size_t source;
        int index;
    };

    NetworkModule& module() { return *network_->parts().module; }

    void add(const TrainingSource& source) {
        sets_.emplace_back(protocol_, *source.observation, source.train, progress_);
        if (sets_.back().size() != config_.size) {
            throw Error(
                ErrorCode::bad_input,
                fmt::format("has samples of {} x {} where {} has {} x {}", sets_.back().size(),
                            sets_.back().size(), sources_.front().name, config_.size, config_.size),
                source.name);
        }
        validation_.emplace_back(protocol_, source, progress_);
        for (const int index : sets_.back().chosen(options_.max_windows))
            chosen_.push_back({sets_.size() - 1, index});
    }

    /// Of all sources, each window counting once.
    ValidationErrors validation_errors() {
        ValidationErrors all;
        int windows = 0;
        for (const ValidationSet& set : validation_) {
            const ValidationErrors e = set.errors(*network_, options_.batch, progress_);
            all.network += e.network * set.count();
            all.persistence += e.persistence * set.count();
            windows += set.count();
        }
        return {all.network / windows, all.persistence / windows};
    }

    torch::Tensor windows_of(const std::vector<Window>& batch) const {
        std::vector<torch::Tensor> list;
        for (const Window& w : batch) list.push_back(sets_[w.source].windows({w.index}));
        return torch::cat(list);
    }

    void set_facts() {
        for (const TrainingSource& source : sources_) {
            facts_.sources.push_back({source.name, source.observation->source_sha256,
                                      learned_data_hash(*source.observation->store, source.train,
                                                        source.validation, progress_),
                                      source.train, source.validation});
        }
        for (std::size_t i = 1; i < facts_.sources.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (facts_.sources[i].data_sha256 != facts_.sources[j].data_sha256) continue;
                throw Error(ErrorCode::refused,
                            "is the same recording as " + facts_.sources[j].recording +
                                ", and would count twice",
                            facts_.sources[i].recording);
            }
        }
        facts_.stride = protocol_.stride;
        facts_.horizons = protocol_.horizons;
        facts_.epochs = options_.epochs;
        facts_.batch = options_.batch;
        facts_.max_windows = options_.max_windows;
        facts_.threads = threads_;
        facts_.device = options_.device == Device::cuda ? "cuda" : "cpu";
        facts_.seed = options_.seed;
        facts_.learning_rate = options_.learning_rate;
        facts_.weight_decay = options_.weight_decay;
        facts_.clip_norm = options_.clip_norm;
        facts_.augment = options_.augment;
        facts_.version = VERDIGRIS_VERSION;
        facts_.torch = TORCH_VERSION;
    }

    /// Of holding still on the training windows as they are.
    double persistence_error() {
        const torch::NoGradGuard frozen;
        double sum = 0, windows = 0;
        for (const Window& window : chosen_) {
            const torch::Tensor w = windows_of({window});
            const torch::Tensor truth = w.narrow(1, protocol_.context, protocol_.horizons);
            const torch::Tensor tau = torch::full({1}, sets_[window.source].tau());
            const WindowErrors e = window_errors_of(w.narrow(1, protocol_.context - 1, 1), truth,
                                                    foreground_mask(w, protocol_.context, tau),
                                                    protocol_.min_foreground);
            sum += e.foreground.mean().item<double>();
            windows += e.counted.item<double>();
        }
        if (!(windows > 0) || !(sum > 0)) {
            throw Error(ErrorCode::refused,
                        "nothing changes in the part that would be learned from: too few "
                        "foreground pixels in every window",
                        facts_.source_names());
        }
        return sum / windows;
    }

    double learning_rate(std::int64_t step) const {
        const double all = double(options_.epochs) * steps_per_epoch_;
        return 0.5 * options_.learning_rate * (1 + std::cos(std::numbers::pi * double(step) / all));
    }

    void resume_or_begin() {
        const fs::path last = folder_ / kLastFile;
        const fs::path best = folder_ / kBestFile;
        std::error_code error;
        if (!options_.resume) return refuse_to_begin_over(folder_);
        if (!fs::exists(last, error)) {
            if (!fs::exists(best, error)) return;
            // This run, stopped while it first saved, begins anew; a checkpoint put here stays.
            const Checkpoint kept = read_checkpoint(best);
            if (!(kept.network->config() == config_)) {
                throw Error(ErrorCode::refused, "holds another network's checkpoint",
                            best.string());
            }
            refuse_another_run(kept.facts);
            return;
        }
        const TrainingState state = read_training_state(last, config_, module(), *optimizer_);
        refuse_another_run(state.facts);
        epochs_ = state.epochs;
        for (const EpochRecord& e : epochs_) best_ = std::min(best_, e.validation_error);
        // Now and not after hours: it is what the run is for.
        if (!fs::exists(best, error)) {
            throw Error(ErrorCode::bad_input,
                        fmt::format("has no {} beside its {}: the best epoch so far is lost, and "
                                    "the run cannot go on without it",
                                    kBestFile, kLastFile),
                        folder_.string());
        }
        write_file(folder_ / kMetricsFile, metrics_text(epochs_));  // may lack what was saved last
    }

    void refuse_another_run(TrainingFacts same) const {
        // What differs from epoch to epoch is no other run.
        same.epoch = facts_.epoch;
        same.validation_error = facts_.validation_error;
        same.validation_persistence = facts_.validation_persistence;
        same.version = facts_.version;
        if (!(same == facts_)) {
            throw Error(ErrorCode::refused,
                        fmt::format("is a run that differs in {}; it could not go on as it began",
                                    fmt::join(differing_options(same, facts_), ", ")),
                        folder_.string());
        }
    }

    /// Fills in the loss and the time of a step.
    void train_epoch(EpochRecord& record) {
        const int epoch = record.epoch;
        module().train();
        const std::vector<int> order = shuffled(int(chosen_.size()), options_.seed, epoch);
        double sum = 0;
        std::vector<double> seconds;
        for (int i = 0; i < steps_per_epoch_; ++i) {
            const std::int64_t step = std::int64_t(epoch - 1) * steps_per_epoch_ + i;
            report(progress_, "train", step, std::int64_t(options_.epochs) * steps_per_epoch_);
            std::vector<Window> batch;
            for (int j = i * options_.batch;
                 j < std::min((i + 1) * options_.batch, int(order.size())); ++j) {
                batch.push_back(chosen_[std::size_t(order[std::size_t(j)])]);
            }
            set_learning_rate(*optimizer_, learning_rate(step));
            const auto start = std::chrono::steady_clock::now();
            sum += train_step(batch, epoch, step);
            seconds.push_back(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        }
        record.train_loss = sum / steps_per_epoch_;
        std::ranges::nth_element(seconds, seconds.begin() + std::ptrdiff_t(seconds.size() / 2));
        record.step_seconds = seconds[seconds.size() / 2];
    }

    double train_step(const std::vector<Window>& batch, int epoch, std::int64_t step) {
        const int n = protocol_.context;
        torch::Tensor windows = windows_of(batch).to(network_->parts().device);
        std::vector<WindowAugmentation> draws;
        std::vector<float> tau;
        for (std::size_t i = 0; i < batch.size(); ++i) {
            draws.push_back(options_.augment ? draw_augmentation(options_.seed, step, int(i))
                                             : WindowAugmentation());
            tau.push_back(float(sets_[batch[i].source].tau() * draws.back().gain));
        }
        if (options_.augment) windows = augmented(windows, draws);
        const torch::Device device = network_->parts().device;
        const torch::Tensor mask = foreground_mask(windows, n, torch::tensor(tau).to(device));
        const Horizons h = horizons_of_step(options_.kind, protocol_.horizons, options_.seed, step);
        std::vector<std::int64_t> at;
        for (const int k : h.units) at.push_back(n + k - 1);
        const torch::Tensor truth = windows.index_select(1, torch::tensor(at).to(device));

        optimizer_->zero_grad();
        const torch::Tensor predicted = module().predict(windows.narrow(1, 0, n), h.units);
        const torch::Tensor loss =
            window_loss(window_errors_of(predicted, truth, mask, protocol_.min_foreground),
                        h.weights.to(device), persistence_);
        const double value = loss.item<double>();
        loss.backward();
        const double norm =
            torch::nn::utils::clip_grad_norm_(module().parameters(), options_.clip_norm);
        if (!std::isfinite(value) || !std::isfinite(norm)) {
            fail_diverged("loss", epoch, fmt::format("step {}", step % steps_per_epoch_ + 1));
        }
        optimizer_->step();
        return value;
    }

    [[noreturn]] void fail_diverged(const char* what, int epoch, const std::string& where) const {
        throw Error(ErrorCode::failed,
                    fmt::format("the {} is not a number any more at {} of epoch {}; {}; try a "
                                "smaller --learning-rate",
                                what, where, epoch,
                                epochs_.empty() ? "nothing was saved yet"
                                                : "what was saved after earlier epochs stays in " +
                                                      folder_.string()));
    }

    void save(const EpochRecord& record) {
        epochs_.push_back(record);
        TrainingFacts facts = facts_;
        facts.epoch = record.epoch;
        facts.validation_error = record.validation_error;
        facts.validation_persistence = record.validation_persistence;
        // The best first: a run that dies in between makes the same best again.
        if (record.validation_error < best_) {
            best_ = record.validation_error;
            write_checkpoint(folder_ / kBestFile, *network_, facts);
        }
        write_training_state(folder_ / kLastFile, config_, facts, epochs_, module(), *optimizer_);
        write_file(folder_ / kMetricsFile, metrics_text(epochs_));
    }

    const EvaluationProtocol& protocol_;
    const std::vector<TrainingSource>& sources_;
    const TrainOptions& options_;
    const fs::path& folder_;
    const Progress& progress_;
    int threads_;
    NetworkConfig config_;
    std::vector<TrainingSet> sets_;
    std::vector<ValidationSet> validation_;
    std::vector<Window> chosen_;
    std::shared_ptr<Network> network_;
    std::unique_ptr<torch::optim::AdamW> optimizer_;
    int steps_per_epoch_ = 0;
    TrainingFacts facts_;
    double persistence_ = 0;
    std::vector<EpochRecord> epochs_;
    double best_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void check_train_options(const TrainOptions& o) {
    const auto must = [](bool holds, const char* what) {
        if (!holds) throw Error(ErrorCode::usage, what);
    };
    must(o.epochs >= 1 && o.epochs <= 100000, "epochs must be 1 to 100000");
    must(o.batch >= 1 && o.batch <= 1024, "the batch must be 1 to 1024 windows");
    must(o.learning_rate > 0 && o.learning_rate <= 1, "the learning rate must be above 0, up to 1");
    must(o.weight_decay >= 0 && o.weight_decay < 1, "the weight decay must be 0 or more, below 1");
    must(o.clip_norm > 0 && std::isfinite(o.clip_norm), "the gradient's limit must be above 0");
    must(o.max_windows >= 0, "the number of windows cannot be negative");
    must(o.threads >= 0, "the number of threads cannot be negative");
}

void refuse_to_begin_over(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder / kLastFile, error) || fs::exists(folder / kBestFile, error)) {
        throw Error(ErrorCode::refused,
                    "holds a run already; go on with it with --resume, or choose another folder",
                    folder.string());
    }
}

TrainedNetwork train_network(const EvaluationProtocol& protocol,
                             const std::vector<TrainingSource>& sources,
                             const TrainOptions& options, const fs::path& folder,
                             const Progress& progress, const EpochDone& epoch_done) {
    check_train_options(options);
    check_protocol(protocol);
    if (sources.empty()) throw Error(ErrorCode::usage, "there is no recording to learn from");
    Trainer trainer(protocol, sources, options, folder, progress);
    return trainer.run(epoch_done);
}

}  // namespace verdigris
