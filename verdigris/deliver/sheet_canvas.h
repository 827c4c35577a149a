// SPDX-License-Identifier: MIT
// Drawing on a sheet: rectangles, lines, pictures and text, in pixels from the top-left.
#pragma once

#include <memory>
#include <string>

#include "verdigris/color/pixel_types.h"
#include "verdigris/deliver/text_wrap.h"
#include "verdigris/pixels/image.h"

namespace verdigris {

/// A color of the sheet, encoded sRGB: 0xRRGGBB.
struct Ink {
    unsigned rgb = 0;
};

struct TextStyle {
    double size = 16;  ///< pixels
    Ink ink{0xFFFFFF};
    bool bold = false;
};

/// How wide texts will be, without a sheet to draw on.
double text_width(const std::string& text, const TextStyle& style);
/// The same as a function of the text alone.
TextWidth measure(const TextStyle& style);

class SheetCanvas {
  public:
    /// Throws Error{failed} if the sheet would be larger than 32767 pixels on a side.
    SheetCanvas(int width, int height, Ink background);
    ~SheetCanvas();
    SheetCanvas(const SheetCanvas&) = delete;
    SheetCanvas& operator=(const SheetCanvas&) = delete;

    void fill(Rect rect, Ink ink, double radius = 0);
    /// A one-pixel frame just outside `rect`.
    void frame(Rect rect, Ink ink);
    void line(double x0, double y0, double x1, double y1, Ink ink, double width, bool dashed);
    /// `y` is the baseline. The text must be printable(); a character without a letter in the font
    /// is drawn as "?".
    void text(double x, double y, const std::string& text, const TextStyle& style);
    void picture(int x, int y, ImageView<const SrgbU8> image);

    Image<SrgbU8> pixels() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace verdigris
