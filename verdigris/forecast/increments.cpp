// SPDX-License-Identifier: MIT
#include "verdigris/forecast/increments.h"

#include <algorithm>

#include "verdigris/forecast/backdrop_light.h"
#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
Increments increments_of(const Context& context, const Mask& moving, const LightGains& light) {
    const int n = context.length();
    std::vector<Image<SrgbF>> relit_frames(std::size_t(n - 1));
    for (int i = 0; i + 1 < n; ++i)
        relit_frames[std::size_t(i)] =
            light.empty() ? context.frames[std::size_t(i)].clone()
                          : relit(context.frames[std::size_t(i)], light[std::size_t(i)]);
    const auto frame = [&](int i) {
        return i + 1 < n ? relit_frames[std::size_t(i)].pixels() : context.frames.back().pixels();
    };
    Increments out(std::size_t(n - 1));
    const auto inside = moving.pixels();
    parallel_for(n - 1, [&](int i) {
        const auto before = frame(i), after = frame(i + 1);
        ColorField& d = out[std::size_t(i)];
        for (Field& p : d) p.resize(inside.size());
        for (std::size_t at = 0; at < inside.size(); ++at) {
            const float on = inside[at] ? 1.0f : 0.0f;
            d[0][at] = on * (after[at].r - before[at].r);
            d[1][at] = on * (after[at].g - before[at].g);
            d[2][at] = on * (after[at].b - before[at].b);
        }
    });
    return out;
}

Image<SrgbF> image_of(const std::vector<const ColorField*>& planes,
                      const Eigen::RowVectorXd& weights, const Image<SrgbF>& like) {
    Image<SrgbF> out(like.width(), like.height());
    const auto width = std::size_t(like.width());
    parallel_rows(like.height(), 32, [&](RowRun run) {
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const float w = float(weights[Eigen::Index(i)]);
            const ColorField& p = *planes[i];
            for (int y = run.begin; y < run.end; ++y) {
                SrgbF* to = out.row(y);
                const std::size_t row = std::size_t(y) * width;
                for (std::size_t x = 0; x < width; ++x)
                    to[x] = {to[x].r + w * p[0][row + x], to[x].g + w * p[1][row + x],
                             to[x].b + w * p[2][row + x]};
            }
        }
    });
    return out;
}

double mean_square_difference(const Image<SrgbF>& a, const Image<SrgbF>& b, const Mask& inside) {
    struct Sum {
        double squares = 0, count = 0;
    };
    const auto sums = map_rows<Sum>(a.height(), 32, [&](RowRun run) {
        Sum s;
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < a.width(); ++x) {
                if (inside(x, y) == 0) continue;
                const SrgbF p = a(x, y), q = b(x, y);
                const double r = double(p.r - q.r), g = double(p.g - q.g), c = double(p.b - q.b);
                s.squares += r * r + g * g + c * c;
                s.count += 3;
            }
        }
        return s;
    });
    Sum all;
    for (const Sum& s : sums) all.squares += s.squares, all.count += s.count;
    return all.count > 0 ? all.squares / all.count : 0;
}

}  // namespace verdigris
