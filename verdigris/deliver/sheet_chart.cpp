// SPDX-License-Identifier: MIT
#include "verdigris/deliver/sheet_chart.h"

#include <fmt/format.h>

#include <algorithm>

#include "verdigris/deliver/sheet_layout.h"
#include "verdigris/deliver/visible_change.h"

namespace verdigris {
namespace {

constexpr Ink kText{0xECEAE6}, kMuted{0x9DA3A8}, kRule{0x3A3E42}, kForecast{0x6FD0B4};
constexpr TextStyle kTick{14, kMuted};
// chosen: enough points for the eye to see a curve.
constexpr int kMaxObserved = 24;
constexpr int kTickWidth = 52, kTickHeight = 30;

// Where the curve's numbers stand on the sheet.
struct Scales {
    Rect plot;
    double first = 0, last = 1, top = 1;
    double x(double unit) const { return plot.x + plot.width * (unit - first) / (last - first); }
    double y(double change) const { return plot.y + plot.height * (1 - change / top); }
};

void draw_curve(SheetCanvas& canvas, const Scales& s, const std::vector<ChangePoint>& points,
                Ink ink, double solid_until) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        canvas.line(s.x(points[i - 1].unit), s.y(points[i - 1].change), s.x(points[i].unit),
                    s.y(points[i].change), ink, 2, points[i].unit > solid_until);
    }
    for (const ChangePoint& point : points) {
        const int x = int(s.x(point.unit)), y = int(s.y(point.change));
        canvas.fill({x - 3, y - 3, 7, 7}, ink, 3.5);
    }
}

}  // namespace

ChangeCurve change_curve(const Delivery& delivery) {
    static const Mask kEverywhere;
    const Mask& where = delivery.specimen ? *delivery.specimen : kEverywhere;
    const Image<SrgbF> base = delivery.forecast->at(0);
    ChangeCurve curve;
    curve.trusted_until = 2.0 * delivery.forecast->context_length;
    for (int index : evenly_chosen(int(delivery.observed.size()), kMaxObserved)) {
        const ObservedFrame& frame = delivery.observed[std::size_t(index)];
        if (!frame.image.same_size(base)) continue;
        curve.observed.push_back(
            {frame.unit, mean_inside(change_between(base, frame.image), where)});
    }
    curve.forecast.push_back({});
    for (double horizon : delivery.horizons) {
        const Image<SrgbF> frame = delivery.forecast->at(horizon);
        curve.forecast.push_back({horizon, mean_inside(change_between(base, frame), where)});
    }
    return curve;
}

void draw_chart(SheetCanvas& canvas, const Rect& area, const ChangeCurve& curve) {
    Scales s;
    s.plot = {area.x + kTickWidth, area.y + 6, area.width - kTickWidth - 12,
              area.height - kTickHeight - 6};
    s.first = std::min(0.0, curve.observed.empty() ? 0.0 : curve.observed.front().unit);
    s.last = std::max(curve.forecast.back().unit, s.first < 0 ? 0.0 : 1.0);
    double largest = 0;
    for (const auto* points : {&curve.observed, &curve.forecast}) {
        for (const ChangePoint& point : *points) largest = std::max(largest, point.change);
    }
    s.top = round_scale(largest);

    const TextWidth width = measure(kTick);
    for (double share : {0.0, 0.5, 1.0}) {
        const double y = s.y(share * s.top);
        canvas.line(s.plot.x, y, s.plot.x + s.plot.width, y, kRule, 1, false);
        const std::string label = fmt::format("{:g} %", 100 * share * s.top);
        canvas.text(s.plot.x - 12 - width(label), y + 5, label, kTick);
    }
    const double bottom = s.plot.y + s.plot.height;
    canvas.line(s.x(0), s.plot.y, s.x(0), bottom, kForecast, 1, true);
    // Tick labels that would touch their neighbor are left out; "now" always stays.
    const double now_width = width("now"), gap = 12;
    const double now_x =
        std::clamp(s.x(0) - now_width / 2, double(s.plot.x), s.plot.x + s.plot.width - now_width);
    canvas.text(now_x, bottom + 24, "now", {kTick.size, kForecast});
    if (const std::string label = fmt::format("{:+.4g} u", s.first);
        s.first < 0 && s.plot.x + width(label) + gap < now_x) {
        canvas.text(s.plot.x, bottom + 24, label, kTick);
    }
    const std::string label = fmt::format("{:+.4g} u", s.last);
    const double label_x = s.plot.x + s.plot.width - width(label);
    if (s.last > 0 && label_x > now_x + now_width + gap) {
        canvas.text(label_x, bottom + 24, label, kTick);
    }
    draw_curve(canvas, s, curve.observed, kText, 0);
    draw_curve(canvas, s, curve.forecast, kForecast, curve.trusted_until);
}

}  // namespace verdigris
