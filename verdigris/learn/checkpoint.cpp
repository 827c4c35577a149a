// SPDX-License-Identifier: MIT
#include "verdigris/learn/checkpoint.h"

#include "verdigris/evaluate/held_recording.h"
#include "verdigris/files/sha256.h"
#include "verdigris/learn/network_parts.h"
#include "verdigris/learn/tensor_file.h"

namespace verdigris {

std::string learned_data_hash(const SampleStore& samples, SampleRange train, SampleRange validation,
                              const Progress& progress) {
    Sha256 hash;
    for (const SampleRange& range : {train, validation}) {
        for (const std::string& frame : frame_hashes(samples, range, progress)) hash.update(frame);
        hash.update("|");
    }
    return hash.hex();
}

std::string TrainingFacts::source_names() const {
    std::string names;
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (i > 0) names += i + 1 == sources.size() ? " and " : ", ";
        names += sources[i].recording;
    }
    return names;
}

void write_checkpoint(const std::filesystem::path& path, const Network& network,
                      const TrainingFacts& facts) {
    SafetensorsFile file;
    file.metadata = metadata_of(network.config(), facts);
    store_weights(*network.parts().module, file);
    write_safetensors(path, file);
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
    const SafetensorsFile file = read_safetensors(path);
    Checkpoint checkpoint;
    const NetworkConfig config = config_of(file.metadata, path.string());
    checkpoint.facts = facts_of(file.metadata, path.string());
    checkpoint.network = std::make_shared<Network>(config);
    load_weights(file, path.string(), "", *checkpoint.network->parts().module);
    return checkpoint;
}

}  // namespace verdigris
