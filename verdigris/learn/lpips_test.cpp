// SPDX-License-Identifier: MIT
// LPIPS with planted weights against the same networks written as plain loops.
#include "verdigris/learn/lpips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "verdigris/error.h"
#include "verdigris/files/safetensors.h"
#include "verdigris/files/testing.h"
#include "verdigris/learn/learn.h"

namespace verdigris {
namespace {

/// Channels of rows; what the naive networks compute on.
struct Volume {
    int channels = 0, height = 0, width = 0;
    std::vector<double> values;
    Volume(int c, int h, int w)
        : channels(c), height(h), width(w), values(std::size_t(c * h * w)) {}
    double& at(int c, int y, int x) { return values[std::size_t((c * height + y) * width + x)]; }
    double at(int c, int y, int x) const {
        return values[std::size_t((c * height + y) * width + x)];
    }
};

/// Planted weights by their names in the file.
class Planted {
  public:
    explicit Planted(std::uint32_t seed) : bits_(seed) {}

    /// Of a size that keeps activations about as large through all layers [He2015].
    void convolution(const std::string& name, int in, int out, int kernel) {
        const double spread = std::sqrt(6.0 / (in * kernel * kernel));
        add(name + ".weight", {out, in, kernel, kernel}, -spread, spread);
        add(name + ".bias", {out}, -0.1, 0.1);
    }
    void head(const std::string& name, int channels) { add(name, {1, channels, 1, 1}, 0, 1); }
    void fire(const std::string& name, int in, int squeezed, int half) {
        convolution(name + ".squeeze", in, squeezed, 1);
        convolution(name + ".expand1x1", squeezed, half, 1);
        convolution(name + ".expand3x3", squeezed, half, 3);
    }

    const std::vector<float>& of(const std::string& name) const { return values_.at(name); }
    SafetensorsFile file(const std::string& net) const {
        SafetensorsFile out;
        out.metadata = {{"net", net}, {"version", "0.1"}};
        for (const auto& [name, values] : values_)
            out.tensors.push_back(float_tensor(name, shapes_.at(name), values));
        return out;
    }

  private:
    void add(const std::string& name, const std::vector<std::int64_t>& shape, double low,
             double high) {
        std::size_t count = 1;
        for (const std::int64_t side : shape) count *= std::size_t(side);
        std::vector<float>& values = values_[name];
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(float(low + (high - low) * double(bits_() >> 8) * 0x1p-24));
        shapes_[name] = shape;
    }
    std::mt19937 bits_;
    std::map<std::string, std::vector<float>> values_;
    std::map<std::string, std::vector<std::int64_t>> shapes_;
};

/// A convolution and the ReLU behind it.
Volume convolved(const Planted& p, const std::string& name, const Volume& in, int kernel,
                 int stride, int padding) {
    const std::vector<float>&weight = p.of(name + ".weight"), &bias = p.of(name + ".bias");
    Volume out(int(bias.size()), (in.height + 2 * padding - kernel) / stride + 1,
               (in.width + 2 * padding - kernel) / stride + 1);
    for (int o = 0; o < out.channels; ++o) {
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                double sum = double(bias[std::size_t(o)]);
                for (int i = 0; i < in.channels; ++i) {
                    for (int v = 0; v < kernel; ++v) {
                        for (int u = 0; u < kernel; ++u) {
                            const int yy = y * stride + v - padding, xx = x * stride + u - padding;
                            if (yy < 0 || xx < 0 || yy >= in.height || xx >= in.width) continue;
                            const int at = ((o * in.channels + i) * kernel + v) * kernel + u;
                            sum += double(weight[std::size_t(at)]) * in.at(i, yy, xx);
                        }
                    }
                }
                out.at(o, y, x) = std::max(sum, 0.0);
            }
        }
    }
    return out;
}

Volume pooled(const Volume& in, int kernel, bool past_the_end) {
    const auto places = [&](int length) {
        return past_the_end ? (length - kernel + 1) / 2 + 1 : (length - kernel) / 2 + 1;
    };
    Volume out(in.channels, places(in.height), places(in.width));
    for (int c = 0; c < in.channels; ++c) {
        for (int y = 0; y < out.height; ++y) {
            for (int x = 0; x < out.width; ++x) {
                double best = 0;  // what comes here is behind a ReLU
                for (int v = 2 * y; v < std::min(2 * y + kernel, in.height); ++v)
                    for (int u = 2 * x; u < std::min(2 * x + kernel, in.width); ++u)
                        best = std::max(best, in.at(c, v, u));
                out.at(c, y, x) = best;
            }
        }
    }
    return out;
}

Volume fired(const Planted& p, const std::string& name, const Volume& in) {
    const Volume squeezed = convolved(p, name + ".squeeze", in, 1, 1, 0),
                 one = convolved(p, name + ".expand1x1", squeezed, 1, 1, 0),
                 three = convolved(p, name + ".expand3x3", squeezed, 3, 1, 1);
    Volume out(one.channels + three.channels, in.height, in.width);
    std::copy(one.values.begin(), one.values.end(), out.values.begin());
    std::copy(three.values.begin(), three.values.end(),
              out.values.begin() + std::ptrdiff_t(one.values.size()));
    return out;
}

std::vector<Volume> alex_sees(const Planted& p, const Volume& x) {
    std::vector<Volume> seen;
    seen.push_back(convolved(p, "features.0", x, 11, 4, 2));
    seen.push_back(convolved(p, "features.3", pooled(seen[0], 3, false), 5, 1, 2));
    seen.push_back(convolved(p, "features.6", pooled(seen[1], 3, false), 3, 1, 1));
    seen.push_back(convolved(p, "features.8", seen[2], 3, 1, 1));
    seen.push_back(convolved(p, "features.10", seen[3], 3, 1, 1));
    return seen;
}

std::vector<Volume> vgg_sees(const Planted& p, Volume x) {
    std::vector<Volume> seen;
    for (const std::vector<int>& block :
         std::vector<std::vector<int>>{{0, 2}, {5, 7}, {10, 12, 14}, {17, 19, 21}, {24, 26, 28}}) {
        if (!seen.empty()) x = pooled(x, 2, false);
        for (const int index : block)
            x = convolved(p, "features." + std::to_string(index), x, 3, 1, 1);
        seen.push_back(x);
    }
    return seen;
}

std::vector<Volume> squeeze_sees(const Planted& p, const Volume& x) {
    std::vector<Volume> seen;
    const auto fire = [&](int index, const Volume& in) {
        return fired(p, "features." + std::to_string(index), in);
    };
    seen.push_back(convolved(p, "features.0", x, 3, 2, 0));
    seen.push_back(fire(4, fire(3, pooled(seen[0], 3, true))));
    seen.push_back(fire(7, fire(6, pooled(seen[1], 3, true))));
    seen.push_back(fire(9, pooled(seen[2], 3, true)));
    for (const int index : {10, 11, 12}) seen.push_back(fire(index, seen.back()));
    return seen;
}

Volume input_of(const Image<SrgbF>& image) {
    constexpr double shift[] = {-0.030, -0.088, -0.188}, scale[] = {0.458, 0.448, 0.450};
    Volume out(3, image.height(), image.width());
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const SrgbF c = image(x, y);
            const double rgb[] = {c.r, c.g, c.b};
            for (int k = 0; k < 3; ++k) out.at(k, y, x) = (2 * rgb[k] - 1 - shift[k]) / scale[k];
        }
    }
    return out;
}

using Sees = std::function<std::vector<Volume>(const Planted&, const Volume&)>;

double naive_distance(const Planted& p, const Sees& sees, const Image<SrgbF>& first,
                      const Image<SrgbF>& second) {
    const std::vector<Volume> a = sees(p, input_of(first)), b = sees(p, input_of(second));
    double distance = 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        const std::vector<float>& head = p.of("lin" + std::to_string(k) + ".weight");
        double sum = 0;
        for (int y = 0; y < a[k].height; ++y) {
            for (int x = 0; x < a[k].width; ++x) {
                double la = 0, lb = 0;
                for (int c = 0; c < a[k].channels; ++c) {
                    la += a[k].at(c, y, x) * a[k].at(c, y, x);
                    lb += b[k].at(c, y, x) * b[k].at(c, y, x);
                }
                for (int c = 0; c < a[k].channels; ++c) {
                    const double d = a[k].at(c, y, x) / (std::sqrt(la) + 1e-10) -
                                     b[k].at(c, y, x) / (std::sqrt(lb) + 1e-10);
                    sum += double(head[std::size_t(c)]) * d * d;
                }
            }
        }
        distance += sum / (a[k].height * a[k].width);
    }
    return distance;
}

Planted planted_alex() {
    Planted p(1);
    p.convolution("features.0", 3, 64, 11);
    p.convolution("features.3", 64, 192, 5);
    p.convolution("features.6", 192, 384, 3);
    p.convolution("features.8", 384, 256, 3);
    p.convolution("features.10", 256, 256, 3);
    for (const int k : {0, 1, 2, 3, 4})
        p.head("lin" + std::to_string(k) + ".weight", std::vector{64, 192, 384, 256, 256}[k]);
    return p;
}

Planted planted_vgg() {
    Planted p(2);
    const int layers[][3] = {{0, 3, 64},     {2, 64, 64},    {5, 64, 128},   {7, 128, 128},
                             {10, 128, 256}, {12, 256, 256}, {14, 256, 256}, {17, 256, 512},
                             {19, 512, 512}, {21, 512, 512}, {24, 512, 512}, {26, 512, 512},
                             {28, 512, 512}};
    for (const auto& [index, in, out] : layers)
        p.convolution("features." + std::to_string(index), in, out, 3);
    for (const int k : {0, 1, 2, 3, 4})
        p.head("lin" + std::to_string(k) + ".weight", std::vector{64, 128, 256, 512, 512}[k]);
    return p;
}

Planted planted_squeeze() {
    Planted p(3);
    p.convolution("features.0", 3, 64, 3);
    const int fires[][4] = {{3, 64, 16, 64},    {4, 128, 16, 64},  {6, 128, 32, 128},
                            {7, 256, 32, 128},  {9, 256, 48, 192}, {10, 384, 48, 192},
                            {11, 384, 64, 256}, {12, 512, 64, 256}};
    for (const auto& [index, in, squeezed, half] : fires)
        p.fire("features." + std::to_string(index), in, squeezed, half);
    for (const int k : {0, 1, 2, 3, 4, 5, 6})
        p.head("lin" + std::to_string(k) + ".weight",
               std::vector{64, 128, 256, 384, 384, 512, 512}[k]);
    return p;
}

Image<SrgbF> noise(int width, int height, std::uint32_t seed) {
    std::mt19937 bits(seed);
    Image<SrgbF> image(width, height);
    const auto next = [&] { return float(bits() >> 8) * 0x1p-24f; };
    for (SrgbF& c : image.pixels()) c.r = next(), c.g = next(), c.b = next();
    return image;
}

void expect_agreement(const Planted& planted, const std::string& net, const Sees& sees, int width,
                      int height) {
    const ScratchFolder folder;
    const auto path = folder / (net + ".safetensors");
    write_safetensors(path, planted.file(net));
    const Lpips lpips(path);
    EXPECT_EQ(to_string(lpips.net()), net);
    const Image<SrgbF> a = noise(width, height, 5), b = noise(width, height, 6);
    const double expected = naive_distance(planted, sees, a, b), got = lpips.distance(a, b);
    EXPECT_GT(expected, 0.1);
    EXPECT_NEAR(got / expected, 1, 1e-5);
    EXPECT_NEAR(lpips.distance(b, a) / got, 1, 1e-6);
    EXPECT_EQ(lpips.distance(a, a), 0);

    // One pixel less than the smallest is refused in words, the smallest is not.
    const int least = lpips_smallest(lpips.net());
    EXPECT_GT(lpips.distance(noise(least, least, 1), noise(least, least, 2)), 0);
    const Error small =
        error_of([&] { lpips.distance(noise(least - 1, 64, 1), noise(least - 1, 64, 2)); });
    EXPECT_EQ(small.code(), ErrorCode::bad_input);
    EXPECT_NE(small.sentence().find("at least"), std::string::npos);
}

TEST(Lpips, OfAlexAgreesWithPlainLoops) {
    expect_agreement(planted_alex(), "alex", alex_sees, 67, 45);
}
TEST(Lpips, OfVggAgreesWithPlainLoops) {
    expect_agreement(planted_vgg(), "vgg", vgg_sees, 19, 17);
}
TEST(Lpips, OfSqueezeAgreesWithPlainLoops) {
    expect_agreement(planted_squeeze(), "squeeze", squeeze_sees, 53, 40);
}

TEST(Lpips, LimitsToTheUnitRangeAndReadsViews) {
    const ScratchFolder folder;
    write_safetensors(folder / "w.safetensors", planted_squeeze().file("squeeze"));
    const Lpips lpips(folder / "w.safetensors");
    Image<SrgbF> a(40, 40), b(40, 40);
    for (SrgbF& c : a.pixels()) c = {1.5f, -2, std::numeric_limits<float>::quiet_NaN()};
    for (SrgbF& c : b.pixels()) c = {1, 0, 0};
    EXPECT_EQ(lpips.distance(a, b), 0);
    const Image<SrgbF> large = noise(60, 50, 1), other = noise(60, 50, 2);
    const Rect rect{7, 5, 40, 40};
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 40; ++x) {
            a(x, y) = large(rect.x + x, rect.y + y);
            b(x, y) = other(rect.x + x, rect.y + y);
        }
    }
    EXPECT_EQ(lpips.distance(large.view().window(rect), other.view().window(rect)),
              lpips.distance(a, b));
    EXPECT_EQ(error_of([&] { lpips.distance(large, a); }).code(), ErrorCode::bad_input);
}

TEST(Lpips, RefusesWhatAreNoWeights) {
    const ScratchFolder folder;
    const SafetensorsFile good = planted_squeeze().file("squeeze");
    const auto refused = [&](const char* pattern,
                             const std::function<void(SafetensorsFile&)>& spoil) {
        SafetensorsFile file = good;
        spoil(file);
        const auto path = folder / "w.safetensors";
        write_safetensors(path, file);
        const Error e = error_of([&] { Lpips{path}; });
        EXPECT_EQ(e.code(), ErrorCode::bad_input) << pattern;
        EXPECT_EQ(e.where(), path.string());
        EXPECT_NE(e.sentence().find(pattern), std::string::npos) << e.sentence();
    };
    refused("no 'version'", [](auto& f) { f.metadata = {{"net", "squeeze"}}; });
    refused("no 'net'", [](auto& f) { f.metadata = {{"version", "0.1"}}; });
    refused("of version '0.0'", [](auto& f) { f.metadata["version"] = "0.0"; });
    refused("none of alex, vgg and squeeze", [](auto& f) { f.metadata["net"] = "resnet"; });
    refused("which LPIPS of vgg does not have", [](auto& f) { f.metadata["net"] = "vgg"; });
    refused("lacks the weights 'lin", [](auto& f) {
        std::erase_if(f.tensors, [](const Tensor& t) { return t.name == "lin3.weight"; });
    });
    refused("holds 'lin7.weight', which", [](auto& f) {
        f.tensors.push_back(float_tensor("lin7.weight", {1}, std::vector<float>{1}));
    });
    const auto replace = [](SafetensorsFile& f, const std::string& name,
                            const std::vector<std::int64_t>& shape, std::size_t count,
                            float value) {
        for (Tensor& t : f.tensors) {
            if (t.name == name) t = float_tensor(name, shape, std::vector<float>(count, value));
        }
    };
    refused("has the shape [64, 1] where LPIPS of squeeze has [1, 64, 1, 1]", [&](auto& f) {
        replace(f, "lin0.weight", {64, 1}, 64, 1);
    });
    refused("not finite", [&](auto& f) {
        replace(f, "features.0.bias", {64}, 64, std::numeric_limits<float>::quiet_NaN());
    });
    refused("negative", [&](auto& f) { replace(f, "lin0.weight", {1, 64, 1, 1}, 64, -1e-3f); });
    EXPECT_EQ(error_of([&] { Lpips{folder / "absent.safetensors"}; }).code(), ErrorCode::bad_input);
}

TEST(Lpips, NamesItsNets) {
    for (const LpipsNet net : {LpipsNet::alex, LpipsNet::vgg, LpipsNet::squeeze})
        EXPECT_EQ(lpips_net(to_string(net)), net);
    EXPECT_EQ(error_of([] { lpips_net("resnet"); }).code(), ErrorCode::usage);
}

}  // namespace
}  // namespace verdigris
