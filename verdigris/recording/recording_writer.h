// SPDX-License-Identifier: MIT
// Recordings out: the inverse of open_recording, for what is simulated or rendered. Frame by frame,
// never held whole; written whole or not at all. Same frames, same options, same bytes, on any
// number of cores: no dates, no names of libraries (another version of an encoder may code
// otherwise).
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

struct WriterOptions {
    int width = 0, height = 0;  ///< of every frame; .mp4 takes even sizes only
    double fps = 24;            ///< frames per second, one a day (1/86400) to 1000
    /// Of a stored sample, 8 or 16; .mp4 holds 8. add() takes the pixel type of these bits.
    int bits = 8;
    bool replace = false;  ///< an existing file, or a folder that holds only what we write
    /// x264's constant rate factor, .mp4 only, 0 to 51. chosen, 12: camera noise should survive.
    /// Of a temporal noise of one code value 41 % is left at 12, pixel by pixel (its strength is
    /// right to 10 %, the rest is coding noise), 62 % at 8, 87 % at 4, all at 0, nothing at 24; of
    /// a noise of three codes 77 % at 12 (writer_noise_test.cpp prints these). Where the noise
    /// itself counts, write .mkv or a folder. 0 is lossless after 4:2:0; many browsers do not
    /// play it.
    double crf = 12;
    /// x264's name for the time it takes, "ultrafast" to "placebo", .mp4 only. chosen: x264's usual
    /// fast one. "ultrafast" takes a quarter of the time, and the noise of smooth areas with it.
    std::string preset = "veryfast";
};

/// A recording under construction. Until commit() the target is untouched; if the object dies
/// before, nothing of it remains. For one thread at a time.
class RecordingWriter {
  public:
    virtual ~RecordingWriter() = default;
    /// The next frame, which is copied or coded before this returns; frame n is shown at n / fps.
    /// Throws Error{usage} naming the frame: another size or other bits than announced (the frame
    /// is left out, the recording may go on). Error{failed} naming the target: disk full; nothing
    /// but giving up is possible then. It may only be said frames later, or by commit().
    virtual void add(ImageView<const SrgbU8> frame) = 0;
    virtual void add(ImageView<const SrgbU16> frame) = 0;
    /// Codes what is left and moves the recording to its target. Throws as add; Error{usage} if
    /// there is no frame; Error{refused} if the target has come to exist since.
    virtual void commit() = 0;
};

/// What is written follows from the name:
///   .mp4                          H.264, 4:2:0 with left-sited chroma, BT.709, limited range
///   .mkv                          FFV1, RGB, lossless, from 4 x 4 pixels on. Times are rounded to
///                                 milliseconds, as Matroska keeps them
///   no ending, or "/" at the end  a folder of 000000.png ... and times.csv (columns file, time)
/// All are tagged with what they hold: open_recording() has nothing to guess. Missing parent
/// folders are made; of an existing target that is a link, what it points to is replaced.
/// Throws Error{usage} naming the target: an option out of range, an ending that is none of these,
/// a size the format does not take. Error{refused}: the target exists (an empty folder does not
/// count) and `replace` is false, or is a folder with anything in it but a recording of this kind.
/// Error{failed}: no permission; this FFmpeg lacks the encoder (the sentence says what to write
/// instead).
/// Cost of a 1080p frame: docs/BENCHMARKS.md. Memory at 1080p in 8 bit: 160 MB for .mp4, 390 MB for
/// .mkv, 240 MB for a folder.
std::unique_ptr<RecordingWriter> write_recording(const std::filesystem::path& target,
                                                 const WriterOptions& options);

}  // namespace verdigris
