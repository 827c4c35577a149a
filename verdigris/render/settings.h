// SPDX-License-Identifier: MIT
// Ready scenes and light: what `verdigris render` offers by name.
#pragma once

#include <optional>
#include <string_view>

#include "verdigris/render/render.h"

namespace verdigris {

enum class SceneKind { plate, sphere, drape };
std::string_view to_string(SceneKind kind);
/// Nothing for any other name.
std::optional<SceneKind> scene_kind_from(std::string_view name);

/// A shape and how it is looked at.
struct Setting {
    Shape shape;
    Viewpoint view;
    /// What one round of a turntable is: all the way around, or to and fro where there is a back
    /// that no material belongs on.
    bool swings = false;
    double rest_turn = 0;  ///< RenderScene::turn of a still
};
Setting make_setting(SceneKind kind, double width_over_height);
/// Of a model, moved into the middle and scaled to radius 1.
Setting make_setting(Shape model);

/// RenderScene::turn at `phase` in [0, 1) of a turntable that closes on itself.
double turntable_turn(const Setting& setting, double phase);

/// Softboxes over a dark room: one large key light from the upper left, a strip for the edge on the
/// right, one from above, and a floor that is a little brighter than the walls.
Lighting studio_lighting();
/// Under a sky only.
Lighting sky_lighting(SkyLight sky);
Backdrop studio_backdrop();

}  // namespace verdigris
