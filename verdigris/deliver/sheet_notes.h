// SPDX-License-Identifier: MIT
// The text of a contact sheet: why this forecaster, and every guard in words.
#pragma once

#include <string>
#include <vector>

#include "verdigris/deliver/delivery.h"
#include "verdigris/deliver/sheet_canvas.h"

namespace verdigris {

/// Set for a given width; knows its height before it is drawn.
class SheetNotes {
  public:
    SheetNotes(const Delivery& delivery, int width);
    /// From the baseline of the heading to below the last line.
    int height() const;
    /// `y` is the baseline of the heading.
    void draw(SheetCanvas& canvas, int x, int y) const;

  private:
    struct Line {
        std::string text;
        TextStyle style;
        int indent = 0;
        int advance = 0;  ///< from the line before
    };
    void add(const std::string& text, const TextStyle& style, int indent, int advance);
    void add_paragraph(const std::string& text, const TextStyle& style, int indent, int before,
                       int max_lines);

    int width_ = 0;
    std::vector<Line> lines_;
};

}  // namespace verdigris
