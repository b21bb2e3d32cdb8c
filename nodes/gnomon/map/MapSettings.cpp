// SPDX-License-Identifier: MIT
#include <gnomon/map/MapSettings.h>

#include <glm/trigonometric.hpp>

#include <cmath>

namespace gnomon {
namespace {

/// On a side of a texel, where it is widest. Soft: penumbras of a pixel or two are wider than the filter.
double pixelsOf(const ShadowMapOptions& options) {
    constexpr double plain = 1.5, fine = 0.7, soft = 0.33;
    if (options.edges == ShadowMapOptions::SOFT) return soft;
    return options.edges == ShadowMapOptions::SMOOTH && options.filter == ShadowMapOptions::FINE ? fine : plain;
}

std::optional<MapSoftness> softnessOf(const ShadowMapOptions& options) {
    if (options.edges != ShadowMapOptions::SOFT) return std::nullopt;
    return MapSoftness{std::tan(glm::radians(options.sunAngle / 2.0)), options.lampSize / 2.0, options.radius};
}

} // namespace

MapSettings::MapSettings(const ShadowMapOptions& options)
    : ShadowMapOptions(options),
      pixels(pixelsOf(options)),
      compare(filter == NEAREST ? osg::Texture::NEAREST : osg::Texture::LINEAR),
      defines(definesOf(filter)),
      smooth(edges == SMOOTH && filter != NEAREST),
      softness(softnessOf(options)) {}

std::string definesOf(ShadowMapOptions::Filter filter) {
    constexpr const char* defines[] = {"#define NEAREST\n", "#define BILINEAR\n",
                                       "#define BICUBIC\n#define SAMPLES 4.0\n",
                                       "#define BICUBIC\n#define FINE\n#define SAMPLES 16.0\n"};
    return defines[filter];
}

} // namespace gnomon
