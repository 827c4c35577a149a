// SPDX-License-Identifier: MIT
// Ground: pixels and tables on disk. The only room that links image codecs.
// Every writer goes through AtomicFile: a file is there whole, or not at all.
#pragma once

#include "verdigris/files/atomic_file.h"
#include "verdigris/files/base64.h"
#include "verdigris/files/csv.h"
#include "verdigris/files/folder_lock.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/npy.h"
#include "verdigris/files/png.h"
#include "verdigris/files/safetensors.h"
#include "verdigris/files/sha256.h"
#include "verdigris/files/staged_folder.h"
