// SPDX-License-Identifier: MIT
// How the library says that the world is wrong: a missing file, a broken video, a full disk.
// Problems of the data (too few frames, a color reversal) are never exceptions: see status.h.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace verdigris {

/// What went wrong, as the command line reports it. The values are the documented exit statuses.
enum class ErrorCode {
    failed = 1,         ///< could not finish: disk full, no permission, out of memory
    usage = 2,          ///< an option or an argument makes no sense
    bad_input = 3,      ///< the recording or the file cannot be used; `where` names it
    refused = 4,        ///< possible, but the answer would not be worth having; --force overrides
    interrupted = 130,  ///< the progress callback asked to stop
};

/// One clear sentence. `where` names the file and, if there is one, the frame:
/// "IMG_0042.png" or "clip.mp4, frame 17". what() is "where: sentence".
class Error : public std::runtime_error {
  public:
    Error(ErrorCode code, const std::string& sentence, std::string where = {})
        : std::runtime_error(where.empty() ? sentence : where + ": " + sentence),
          code_(code),
          sentence_(sentence),
          where_(std::move(where)) {}

    ErrorCode code() const { return code_; }
    const std::string& sentence() const { return sentence_; }
    const std::string& where() const { return where_; }

  private:
    ErrorCode code_;
    std::string sentence_;
    std::string where_;
};

}  // namespace verdigris
