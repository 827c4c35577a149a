// SPDX-License-Identifier: MIT
// Forecasts judged by the pictures of their materials.
// Path: evaluate, material, render, metrics -> [appearance].   Model: docs/PROTOCOL.md
#pragma once

#include "verdigris/appearance/frame_sheet.h"
#include "verdigris/appearance/material_contact.h"
#include "verdigris/appearance/material_judgment.h"
#include "verdigris/appearance/material_report.h"
#include "verdigris/appearance/material_view.h"
#include "verdigris/appearance/window_materials.h"
