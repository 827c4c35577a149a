// SPDX-License-Identifier: MIT
#include "verdigris/deliver/source_type.h"

#include <fmt/format.h>

#include "verdigris/deliver/delivery.h"

namespace verdigris {
namespace {

const char* code_of(SourceType type) {
    switch (type) {
        case SourceType::capture:
            return "digitalCapture";
        case SourceType::algorithm:
            return "algorithmicMedia";
        case SourceType::trained_algorithm:
            return "trainedAlgorithmicMedia";
        case SourceType::composite_synthetic:
            return "compositeSynthetic";
    }
    return "algorithmicMedia";
}

}  // namespace

SourceType forecast_source(const Forecast& forecast) {
    return forecast.is_trajectory() ? SourceType::algorithm : SourceType::trained_algorithm;
}

std::string xmp_text(SourceType type) {
    return fmt::format(
        R"(<?xpacket begin="" id="W5M0MpCehiHzreSzNTczkc9d"?>)"
        R"(<x:xmpmeta xmlns:x="adobe:ns:meta/">)"
        R"(<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">)"
        R"(<rdf:Description rdf:about="")"
        R"( xmlns:Iptc4xmpExt="http://iptc.org/std/Iptc4xmpExt/2008-02-29/")"
        R"( xmlns:xmp="http://ns.adobe.com/xap/1.0/")"
        R"( Iptc4xmpExt:DigitalSourceType="http://cv.iptc.org/newscodes/digitalsourcetype/{}")"
        R"( xmp:CreatorTool="verdigris {}"/>)"
        R"(</rdf:RDF></x:xmpmeta><?xpacket end="r"?>)",
        code_of(type), writer_version());
}

PngOptions png_options(SourceType type, int level) {
    return {level, {{"XML:com.adobe.xmp", xmp_text(type)}}};
}

}  // namespace verdigris
