// SPDX-License-Identifier: MIT
// Networks trained beforehand, as they enter the held-out protocol.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "verdigris/evaluate/evaluate.h"
#include "verdigris/learn/checkpoint.h"

namespace verdigris {

struct NamedCheckpoint {
    std::filesystem::path path;
    Checkpoint checkpoint;
};

/// One entrant of one kind of network with a checkpoint per recording it was trained on: for each
/// held-out recording the one is taken that learned from others only, the most of them. That it did
/// is not believed: the samples in its splits are read again (which the audit sees) and must have
/// the hash it carries. `train` of the entrant throws Error{refused} where no checkpoint learned
/// from a source as this protocol splits it, naming the checkpoints and the recordings. Throws
/// Error{usage}: no checkpoint, checkpoints of different networks or contexts.
Entrant checkpoint_entrant(std::string name, std::vector<NamedCheckpoint> checkpoints,
                           const EvaluationProtocol& protocol);

/// Entrants of any checkpoints: one per kind of network ("patinanet"), a further one
/// ("patinanet 2") for a second checkpoint of the same kind that learned from the same samples.
std::vector<Entrant> checkpoint_entrants(std::vector<NamedCheckpoint> checkpoints,
                                         const EvaluationProtocol& protocol);

}  // namespace verdigris
