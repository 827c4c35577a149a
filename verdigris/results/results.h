// SPDX-License-Identifier: MIT
// What an evaluation says, for people and for programs: tables, figures, sentences, JSON.
// Path: evaluate, report -> [results].
#pragma once

#include "verdigris/results/characterization_report.h"
#include "verdigris/results/characterization_verdict.h"
#include "verdigris/results/drift_report.h"
#include "verdigris/results/drift_verdict.h"
#include "verdigris/results/evaluation_json.h"
#include "verdigris/results/evaluation_report.h"
#include "verdigris/results/protocol_file.h"
#include "verdigris/results/resolved.h"
#include "verdigris/results/result_files.h"
