// SPDX-License-Identifier: MIT
// Never compiled: a room reaching up the path, for the layer test to catch. [NoSuchKey2001]
#pragma once
#include "verdigris/forecast/forecast.h"
