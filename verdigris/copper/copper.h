// SPDX-License-Identifier: MIT
// The physics of copper: what its oxides do to light, and how fast they grow. docs/models/copper.md
#pragma once

#include "verdigris/copper/color_table.h"
#include "verdigris/copper/environment.h"
#include "verdigris/copper/growth.h"
#include "verdigris/copper/patina.h"
#include "verdigris/copper/surface.h"
