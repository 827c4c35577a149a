// SPDX-License-Identifier: MIT
// Every table and figure of the paper by one command: the plan, the printed values, the comparison.
// Path: workflow, results, report -> [reproduce].
#pragma once

#include "verdigris/reproduce/paper_values.h"
#include "verdigris/reproduce/plan.h"
#include "verdigris/reproduce/reproduced.h"
#include "verdigris/reproduce/reproduction_report.h"
