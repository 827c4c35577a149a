// SPDX-License-Identifier: MIT
// Compares a picture with its golden one, or makes it the golden one:
//   verdigris_compare check ACTUAL GOLDEN WORST MEAN BLOCK FAILED_DIR
//   verdigris_compare update ACTUAL GOLDEN BLOCK
//   verdigris_compare nudge IN OUT CODES      a copy with a patch of CODES more, to prove a check
// WORST and MEAN are what is allowed, in codes of 255 (also for 16-bit pictures). BLOCK > 1
// compares means over BLOCK x BLOCK pixels, and such a small golden is stored.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <variant>

#include "verdigris/error.h"
#include "verdigris/files/image_file.h"
#include "verdigris/files/png.h"

namespace {
using namespace verdigris;
namespace fs = std::filesystem;

constexpr double kGain = 16;  // chosen: one code is visible in the difference picture

// In codes of 255.
struct Picture {
    Image<SrgbF> codes;
    bool deep = false;  // 16 bits per sample
};

Picture read_codes(const fs::path& path) {
    const ImageFile file = read_image(path);
    Picture picture;
    const auto fill = [&](const auto& image, double scale) {
        picture.codes = Image<SrgbF>::for_overwrite(image.width(), image.height());
        std::transform(image.pixels().begin(), image.pixels().end(), picture.codes.pixels().begin(),
                       [scale](const auto& c) {
                           return SrgbF{float(c.r * scale), float(c.g * scale), float(c.b * scale)};
                       });
    };
    if (const auto* u8 = std::get_if<Image<SrgbU8>>(&file.pixels)) {
        fill(*u8, 1);
    } else if (const auto* u16 = std::get_if<Image<SrgbU16>>(&file.pixels)) {
        fill(*u16, 1 / 257.0);
        picture.deep = true;
    } else {
        throw Error(ErrorCode::bad_input, "is not an 8- or 16-bit picture", path.string());
    }
    return picture;
}

void write_codes(const fs::path& path, const Picture& picture) {
    const PngOptions smallest{.level = 12};
    const auto encode = [&](auto image, double scale, double most) {
        using Channel = decltype(image(0, 0).r);
        std::transform(
            picture.codes.pixels().begin(), picture.codes.pixels().end(), image.pixels().begin(),
            [=](SrgbF c) {
                const auto code = [=](float v) {
                    return Channel(std::lround(std::clamp(v * scale, 0.0, most)));
                };
                return std::decay_t<decltype(image(0, 0))>{code(c.r), code(c.g), code(c.b)};
            });
        write_png(path, image, smallest);
    };
    const int width = picture.codes.width(), height = picture.codes.height();
    if (picture.deep) {
        encode(Image<SrgbU16>::for_overwrite(width, height), 257, 65535);
    } else {
        encode(Image<SrgbU8>::for_overwrite(width, height), 1, 255);
    }
}

// Means over block x block pixels; the last ones may be narrower.
Picture in_blocks(const Picture& in, int block) {
    if (block == 1) return {in.codes.clone(), in.deep};
    const int width = (in.codes.width() + block - 1) / block,
              height = (in.codes.height() + block - 1) / block;
    Picture out{Image<SrgbF>(width, height), in.deep};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            double r = 0, g = 0, b = 0, count = 0;
            for (int v = y * block; v < std::min((y + 1) * block, in.codes.height()); ++v) {
                for (int u = x * block; u < std::min((x + 1) * block, in.codes.width()); ++u) {
                    const SrgbF c = in.codes(u, v);
                    r += double(c.r), g += double(c.g), b += double(c.b), ++count;
                }
            }
            out.codes(x, y) = {float(r / count), float(g / count), float(b / count)};
        }
    }
    return out;
}

struct Difference {
    double worst = 0, mean = 0;
    int x = 0, y = 0;
    Picture shown;
};

Difference difference_of(const Picture& actual, const Picture& golden) {
    Difference d;
    d.shown.codes = Image<SrgbF>(golden.codes.width(), golden.codes.height());
    for (int y = 0; y < golden.codes.height(); ++y) {
        for (int x = 0; x < golden.codes.width(); ++x) {
            const SrgbF a = actual.codes(x, y), g = golden.codes(x, y);
            const SrgbF apart{std::fabs(a.r - g.r), std::fabs(a.g - g.g), std::fabs(a.b - g.b)};
            d.mean += (double(apart.r) + double(apart.g) + double(apart.b)) / 3;
            const double most = double(std::max({apart.r, apart.g, apart.b}));
            if (most > d.worst) d.worst = most, d.x = x, d.y = y;
            d.shown.codes(x, y) = {float(kGain) * apart.r, float(kGain) * apart.g,
                                   float(kGain) * apart.b};
        }
    }
    d.mean /= double(golden.codes.pixel_count());
    return d;
}

int check(const fs::path& actual_file, const fs::path& golden_file, double worst, double mean,
          int block, const fs::path& failed) {
    const std::string name = golden_file.stem().string();
    const Picture whole = read_codes(actual_file);
    const Picture actual = in_blocks(whole, block), golden = read_codes(golden_file);
    const fs::path actual_copy = failed / (name + ".actual.png"),
                   difference_file = failed / (name + ".difference.png");
    if (!actual.codes.same_size(golden.codes) || actual.deep != golden.deep) {
        write_codes(actual_copy, actual);
        fmt::print(stderr,
                   "FAIL: {}: {} x {} pixels of {} bits, the golden one {} x {} of {}\n"
                   "  actual      {}\n  golden      {}\n",
                   name, actual.codes.width(), actual.codes.height(), actual.deep ? 16 : 8,
                   golden.codes.width(), golden.codes.height(), golden.deep ? 16 : 8,
                   actual_copy.string(), golden_file.string());
        return 1;
    }
    const Difference d = difference_of(actual, golden);
    const bool fine = d.worst <= worst && d.mean <= mean;
    fmt::print(fine ? stdout : stderr,
               "{}{}: worst difference {:.2f} of 255 at {},{} (allowed {:g}), mean {:.4f} "
               "(allowed {:g})\n",
               fine ? "" : "FAIL: ", name, d.worst, d.x, d.y, worst, d.mean, mean);
    if (fine) return 0;
    write_codes(actual_copy, actual);
    write_codes(difference_file, d.shown);
    fmt::print(stderr, "  actual      {}\n  difference  {} ({:g} times)\n  golden      {}\n",
               actual_copy.string(), difference_file.string(), kGain, golden_file.string());
    return 1;
}

int nudge(const fs::path& in, const fs::path& out, double codes) {
    Picture picture = read_codes(in);
    for (int y = 0; y < std::min(4, picture.codes.height()); ++y) {
        for (int x = 0; x < std::min(4, picture.codes.width()); ++x) {
            SrgbF& c = picture.codes(x, y);
            c.g += float(c.g < 128 ? codes : -codes);
        }
    }
    write_codes(out, picture);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "";
    try {
        if (what == "check" && argc == 8) {
            return check(argv[2], argv[3], std::stod(argv[4]), std::stod(argv[5]),
                         std::stoi(argv[6]), argv[7]);
        }
        if (what == "update" && argc == 5) {
            write_codes(argv[3], in_blocks(read_codes(argv[2]), std::stoi(argv[4])));
            return 0;
        }
        if (what == "nudge" && argc == 5) return nudge(argv[2], argv[3], std::stod(argv[4]));
    } catch (const std::exception& e) {
        fmt::print(stderr, "verdigris_compare: {}\n", e.what());
        return 1;
    }
    fmt::print(stderr,
               "usage: verdigris_compare check ACTUAL GOLDEN WORST MEAN BLOCK FAILED_DIR\n"
               "       verdigris_compare update ACTUAL GOLDEN BLOCK\n"
               "       verdigris_compare nudge IN OUT CODES\n");
    return 2;
}
