// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <string>

#include "verdigris/deliver/text_wrap.h"
#include "verdigris/deliver/textures.h"

namespace verdigris {
namespace {

// chosen: text files are read at 80 to 100 columns.
constexpr int kColumns = 96;

std::string paragraph(const std::string& text, const std::string& indent, int first_indent) {
    std::string lines;
    const double width = kColumns - double(first_indent);
    for (const std::string& line :
         wrapped(text, width, 1000, [](const std::string& part) { return double(part.size()); })) {
        lines += (lines.empty() ? std::string() : indent) + line + "\n";
    }
    return lines;
}

// One line per map that Material carries an origin for.
std::string origin_lines(const Delivery& delivery, const DeliveredState& state) {
    std::string lines;
    for (const MapOrigin& origin :
         map_origins(*delivery.forecast, delivery.recipe->observed_is_clean,
                     state.observed() ? MapsOf::observed : MapsOf::forecast)) {
        lines += fmt::format("  {:<10} {:<9} {}", origin.map, to_string(origin.origin),
                             paragraph(origin.sentence, std::string(23, ' '), 23));
    }
    return lines;
}

}  // namespace

std::string texture_readme(const Delivery& delivery, const DeliveredState& state,
                           const std::string& prefix, int width, int height) {
    const std::string what =
        state.observed() ? std::string("The last observed state of the specimen (horizon 0).\n")
                         : fmt::format(
                               "A forecast, {} after the last observed frame. Computed, not "
                               "photographed.\nForecaster: {}\n",
                               units_text(state.horizon), delivery.forecast->forecaster);
    return fmt::format(
        R"({title}
{what}{unit}
Maps, {width} x {height} pixels, row 0 at the top, not made to tile
  {prefix}_Color.png         base color        8 bit   sRGB (tagged)
  {prefix}_NormalGL.png      normal, +Y up     8 bit   linear, Non-Color
  {prefix}_Roughness.png     roughness         8 bit   linear, Non-Color
  {prefix}_Metalness.png     metallic          8 bit   linear, Non-Color
  {prefix}_Displacement.png  height            16 bit  linear, Non-Color
  {prefix}_ORM.png           packed            8 bit   linear, Non-Color
  dx/{prefix}_NormalDX.png   normal, +Y down   8 bit   linear, Non-Color
  masters16/, dx/masters16/  16-bit masters of the same maps; each 8-bit map is its master rounded

Conventions
  Normal     GL (+Y up): Blender, glTF, Maya, Unity. DX (+Y down): Unreal, 3ds Max. They differ in
             green only: 255 - G. Use one of the two.
  ORM        R ambient occlusion (1 everywhere), G roughness, B metallic: the order of glTF and
             Unreal. Not a picture; import it with sRGB off.
  Roughness  perceptual roughness as in glTF; 1 is matte. Not glossiness.
  Height     0 is low, 1 is high, the middle is 0.5. Relative: no physical scale is known.
  Data maps carry no color tag on purpose. Only Color is sRGB.

How the maps are known
{origins}
What is forecast and what is photographed is also in each PNG's XMP (IPTC digital source type).
Written by verdigris {version}.
)",
        fmt::arg("title", delivery.title), fmt::arg("what", what),
        fmt::arg("unit", paragraph(kUnitSentence, "", 0)), fmt::arg("width", width),
        fmt::arg("height", height), fmt::arg("prefix", prefix),
        fmt::arg("origins", origin_lines(delivery, state)), fmt::arg("version", writer_version()));
}

}  // namespace verdigris
