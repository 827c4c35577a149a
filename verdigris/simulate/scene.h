// SPDX-License-Identifier: MIT
// What the camera looks at: the specimen in front of its backdrop under one lamp, in linear light.
#pragma once

#include "verdigris/color/pixel_types.h"
#include "verdigris/pixels/image.h"
#include "verdigris/simulate/field.h"
#include "verdigris/simulate/spec.h"

namespace verdigris {

/// All of the scene that does not change, made once; compose() puts the specimen's colors in.
class Scene {
  public:
    /// ~0.3 us a pixel (texture).
    Scene(const SimulationSpec& spec, const CellGrid& grid);

    /// Linear light of the frame, before the camera. `colors` is of the grid's size, read between
    /// the cells bilinearly. In parallel, ~10 ns a pixel of the specimen.
    void compose(const Image<LinearF>& colors, Image<LinearF>& frame) const;
    /// A map of the cells as the camera sees it; 0 off the specimen.
    Image<float> seen(const Image<double>& cells) const;

    /// Lamp times brushing on the specimen, 0 off it: linear light is this times the color of the
    /// cells, apart from the sheen.
    Image<float> light() const;

    int width() const { return width_; }
    int height() const { return height_; }
    Mask specimen() const;  ///< 255 where the specimen fills at least half of the pixel
    Mask mount() const;     ///< and the mount
    /// Backdrop at least 4 % of the frame's short side away from specimen and mount.
    Mask reference() const;

    /// x, y in the frame (pixels, center of the first at 0.5) to sides on the specimen from its
    /// left top corner: {a, b, c, d, e, f}, X = a x + b y + c, Y = d x + e y + f.
    struct Affine {
        double a, b, c, d, e, f;
    };
    const Affine& specimen_from_frame() const { return to_specimen_; }

  private:
    struct Sight {          ///< of one pixel
        float column, row;  ///< in cells, of its center
        float share;        ///< of the pixel that the specimen fills
        float light;        ///< on the specimen: lamp times texture
    };
    float share_of(double x, double y, double side_px) const;
    LinearF behind(double x, double y, double down, double light) const;

    SimulationSpec spec_;
    CellGrid grid_;
    int width_ = 0, height_ = 0;
    double side_px_ = 0;  ///< the specimen's shorter side in pixels
    Affine to_specimen_{};
    Image<Sight> sight_;
    Image<LinearF> still_;  ///< what does not change, weighted by its share of the pixel
    Image<float> mount_share_;
};

}  // namespace verdigris
