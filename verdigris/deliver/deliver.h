// SPDX-License-Identifier: MIT
// A material on disk: texture packs, one GLB with variants, the HTML viewer, a contact sheet, and
// the manifest that says how all of it came to be.
// Path: material -> [deliver].
#pragma once

#include "verdigris/deliver/asset_stem.h"
#include "verdigris/deliver/contact_sheet.h"
#include "verdigris/deliver/delivery.h"
#include "verdigris/deliver/gltf.h"
#include "verdigris/deliver/manifest.h"
#include "verdigris/deliver/textures.h"
#include "verdigris/deliver/viewer.h"
