// SPDX-License-Identifier: MIT
#include "verdigris/simulate/scene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "verdigris/pixels/parallel_rows.h"

namespace verdigris {
namespace {

double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}

// Distance in sides to the border of a rounded rectangle, negative inside.
double rounded_box(double x, double y, double half_width, double half_height, double radius) {
    const double dx = std::abs(x) - half_width + radius, dy = std::abs(y) - half_height + radius;
    return std::min(std::max(dx, dy), 0.0) + std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) -
           radius;
}

}  // namespace

Scene::Scene(const SimulationSpec& spec, const CellGrid& grid)
    : spec_(spec),
      grid_(grid),
      width_(spec.frames.width),
      height_(spec.frames.height),
      sight_(width_, height_),
      still_(width_, height_),
      mount_share_(width_, height_) {
    const SceneSpec& s = spec_.scene;
    const double frame_short = std::min(width_, height_);
    side_px_ = std::min(s.width, s.height) * frame_short;
    const double cosine = std::cos(radians(s.tilt)), sine = std::sin(radians(s.tilt));
    const double cx = s.center_x * width_, cy = s.center_y * height_;
    // Turn the frame back by the tilt about the specimen's center, then count from its corner.
    to_specimen_.a = cosine / side_px_;
    to_specimen_.b = sine / side_px_;
    to_specimen_.d = -sine / side_px_;
    to_specimen_.e = cosine / side_px_;
    to_specimen_.c = grid.width / 2 - to_specimen_.a * cx - to_specimen_.b * cy;
    to_specimen_.f = grid.height / 2 - to_specimen_.d * cx - to_specimen_.e * cy;

    const double along = std::cos(radians(s.texture_angle)),
                 across = std::sin(radians(s.texture_angle));
    // Brush lines: as wide as the scale, 60 times as long; half as strong, coarser ones over them.
    const Random random(spec_.pattern_seed(), RandomStream::texture);
    const GaussianField lines(random, 60 * s.texture_scale, s.texture_scale);
    const GaussianField bands(Random(random.bits(~0ull), RandomStream::texture),
                              90 * s.texture_scale, 6 * s.texture_scale);
    const double direction = radians(s.light_direction);
    // cos^4 of the angle from the axis, a lens's own law, at the loss asked for half a side away.
    const double falloff = (1 / std::sqrt(1 - s.vignette) - 1) / 0.25;
    const Affine& m = to_specimen_;
    parallel_rows(height_, 8, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            for (int x = 0; x < width_; ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double u = (px - 0.5 * width_) / frame_short;
                const double v = (py - 0.5 * height_) / frame_short;
                const double tilted =
                    1 + s.light_gradient * (u * std::cos(direction) + v * std::sin(direction));
                const double off_axis = 1 + falloff * (u * u + v * v);
                const double light = std::max(0.0, tilted) / (off_axis * off_axis);
                const double sx = m.a * px + m.b * py + m.c, sy = m.d * px + m.e * py + m.f;
                const float share = share_of(sx, sy, side_px_);
                Sight& sight = sight_(x, y);
                sight.column = float(sx / grid_.cell - 0.5);
                sight.row = float(sy / grid_.cell - 0.5);
                sight.share = share;
                LinearF still{};
                if (share > 0) {
                    const double tx = sx * along + sy * across, ty = sy * along - sx * across;
                    const double brushed =
                        s.texture > 0
                            ? std::exp(s.texture * (lines.at(tx, ty) + 0.5 * bands.at(tx, ty)))
                            : 1;
                    sight.light = float(light * brushed);
                    if (s.glint > 0) {
                        const double d = std::hypot(sx - s.glint_x, sy - s.glint_y) / s.glint_size;
                        const float g = float(s.glint * std::exp(-d * d / 2)) * share;
                        still = {g, g, g};
                    }
                }
                if (share < 1) {
                    const double rod =
                        s.mount ? std::clamp((s.mount_width / 2 - std::abs(sx - grid_.width / 2)) *
                                                     side_px_ +
                                                 0.5,
                                             0.0, 1.0)
                                : 0.0;
                    // The rod comes from above and ends behind the specimen.
                    const double held = sy < grid_.height / 2 ? rod : 0;
                    mount_share_(x, y) = float(held) * (1 - share);
                    const LinearF b = behind(sx, sy, py / height_, light);
                    // A round bar of dark steel: brightest a third from its left.
                    const double round = (sx - grid_.width / 2) / (s.mount_width / 2);
                    const double steel =
                        light * 0.22 * (0.35 + 0.65 * std::exp(-(round + 0.3) * (round + 0.3) * 2));
                    const auto mix = [&](float back, double tint) {
                        return float((back * (1 - held) + steel * tint * held) * (1 - share));
                    };
                    still.r += mix(b.r, 1.0);
                    still.g += mix(b.g, 1.0);
                    still.b += mix(b.b, 1.02);
                }
                still_(x, y) = still;
            }
        }
    });
}

float Scene::share_of(double x, double y, double side_px) const {
    const double d = rounded_box(x - grid_.width / 2, y - grid_.height / 2, grid_.width / 2,
                                 grid_.height / 2, spec_.scene.corner);
    return float(std::clamp(0.5 - d * side_px, 0.0, 1.0));
}

LinearF Scene::behind(double x, double y, double down, double light) const {
    const SceneSpec& s = spec_.scene;
    // The lamp is opposite to where the shadow falls: down and to the right, in the frame.
    const double turn = radians(s.tilt), right = 0.02, below = 0.03;
    const double dx = right * std::cos(turn) + below * std::sin(turn);
    const double dy = below * std::cos(turn) - right * std::sin(turn);
    const double d = std::max(0.0, rounded_box(x - grid_.width / 2 - dx, y - grid_.height / 2 - dy,
                                               grid_.width / 2, grid_.height / 2, 0.05));
    const double shade = 1 - s.shadow * std::exp(-d * d / (2 * 0.05 * 0.05));
    const double slope = 1 + s.backdrop_gradient * (0.5 - down);
    const float v = float(s.backdrop * light * shade * slope);
    return {v, v, v};
}

void Scene::compose(const Image<LinearF>& colors, Image<LinearF>& frame) const {
    if (!frame.same_size(width_, height_)) frame = Image<LinearF>::for_overwrite(width_, height_);
    const int last_column = colors.width() - 2, last_row = colors.height() - 2;
    parallel_rows(height_, 16, [&](RowRun run) {
        for (int y = run.begin; y < run.end; ++y) {
            const Sight* sight = sight_.row(y);
            const LinearF* still = still_.row(y);
            LinearF* out = frame.row(y);
            for (int x = 0; x < width_; ++x) {
                const Sight s = sight[x];
                if (s.share == 0) {
                    out[x] = still[x];
                    continue;
                }
                const int column = std::clamp(int(s.column), 0, last_column);
                const int row = std::clamp(int(s.row), 0, last_row);
                const float fx = std::clamp(s.column - float(column), 0.0f, 1.0f);
                const float fy = std::clamp(s.row - float(row), 0.0f, 1.0f);
                const LinearF* a = colors.row(row) + column;
                const LinearF* b = colors.row(row + 1) + column;
                const float w = s.share * s.light;
                const float wa = (1 - fx) * (1 - fy) * w, wb = fx * (1 - fy) * w;
                const float wc = (1 - fx) * fy * w, wd = fx * fy * w;
                // No camera sees less than no light: some greens lie outside of sRGB.
                const auto channel = [&](float p, float q, float r, float t, float background) {
                    return background + std::max(0.0f, p * wa + q * wb + r * wc + t * wd);
                };
                out[x] = {channel(a[0].r, a[1].r, b[0].r, b[1].r, still[x].r),
                          channel(a[0].g, a[1].g, b[0].g, b[1].g, still[x].g),
                          channel(a[0].b, a[1].b, b[0].b, b[1].b, still[x].b)};
            }
        }
    });
}

Image<float> Scene::seen(const Image<double>& cells) const {
    Image<float> map(width_, height_);
    for (int y = 0; y < height_; ++y) {
        for (int x = 0; x < width_; ++x) {
            const Sight& s = sight_(x, y);
            if (s.share < 0.5f) continue;
            map(x, y) = float(read_between(cells, double(s.column), double(s.row)));
        }
    }
    return map;
}

Image<float> Scene::light() const {
    Image<float> map(width_, height_);
    for (std::size_t i = 0; i < map.pixel_count(); ++i) {
        const Sight& s = sight_.pixels()[i];
        map.pixels()[i] = s.share > 0 ? s.light : 0;
    }
    return map;
}

Mask Scene::specimen() const {
    Mask mask(width_, height_);
    for (std::size_t i = 0; i < mask.pixel_count(); ++i)
        mask.pixels()[i] = sight_.pixels()[i].share >= 0.5f ? kInside : 0;
    return mask;
}

Mask Scene::mount() const {
    Mask mask(width_, height_);
    for (std::size_t i = 0; i < mask.pixel_count(); ++i)
        mask.pixels()[i] = mount_share_.pixels()[i] >= 0.5f ? kInside : 0;
    return mask;
}

Mask Scene::reference() const {
    Mask mask(width_, height_);
    for (std::size_t i = 0; i < mask.pixel_count(); ++i) {
        const bool taken = sight_.pixels()[i].share > 0 || mount_share_.pixels()[i] > 0;
        mask.pixels()[i] = taken ? 0 : kInside;
    }
    // Far enough from whatever is not backdrop; a border of it, so that all distances have an end.
    const double margin = 0.04 * std::min(width_, height_);
    cv::Mat view(height_, width_, CV_8UC1, mask.row(0)), distance;
    if (cv::countNonZero(view) == int(mask.pixel_count())) return mask;
    cv::distanceTransform(view, distance, cv::DIST_L2, cv::DIST_MASK_5, CV_32F);
    view.setTo(cv::Scalar(0), distance < margin);
    return mask;
}

}  // namespace verdigris
