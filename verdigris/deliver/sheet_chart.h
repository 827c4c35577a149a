// SPDX-License-Identifier: MIT
// The small chart of a contact sheet: how fast the specimen changed, and how fast it is forecast
// to.
#pragma once

#include <vector>

#include "verdigris/deliver/delivery.h"
#include "verdigris/deliver/sheet_canvas.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// Mean change from the last observed frame, over the specimen; 1 is full scale.
struct ChangePoint {
    double unit = 0, change = 0;
};
struct ChangeCurve {
    std::vector<ChangePoint> observed;  ///< unit <= 0, ascending, the last is (0, 0)
    std::vector<ChangePoint> forecast;  ///< (0, 0), then one per horizon
    double trusted_until = 0;           ///< twice the context
};

/// Of at most 24 observed frames, evenly chosen, and every horizon.
ChangeCurve change_curve(const Delivery& delivery);

/// Draws axes, both curves and labels inside `area`.
void draw_chart(SheetCanvas& canvas, const Rect& area, const ChangeCurve& curve);

}  // namespace verdigris
