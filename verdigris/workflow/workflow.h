// SPDX-License-Identifier: MIT
// A longer work as tasks that are command lines, done side by side, each only if it must be.
// Path: files -> [workflow].
#pragma once

#include "verdigris/workflow/fingerprint.h"
#include "verdigris/workflow/run_tasks.h"
#include "verdigris/workflow/task.h"
#include "verdigris/workflow/task_graph.h"
#include "verdigris/workflow/task_record.h"
