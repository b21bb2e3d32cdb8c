// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Work that a shadow adds to a frame, as counted before it is done.
struct ShadowWork {
    double calls = 0.0;     ///< draws and full-screen steps.
    double triangles = 0.0; ///< drawn without colour: casters into a map, flattened ones, polygons on terrain.
    double texels = 0.0;    ///< of maps that are cleared and filled.
    double pixels = 0.0;    ///< whose depth is copied or compared.
    double taps = 0.0;      ///< comparisons of 2 × 2 texels, over all pixels.
    double relit = 0.0;     ///< triangles of the scene that are drawn once more.
    double filled = 0.0;    ///< pixels that those cover, or that are blended.
    double rays = 0.0;      ///< cast by the processor.
    double objects = 0.0;   ///< shadows found on terrain, or sides of shadow volumes.

    ShadowWork& operator+=(const ShadowWork& other);
};
ShadowWork operator*(double share, ShadowWork work);

/// What a unit of each kind of work takes, milliseconds of processor time. The defaults are those of one core of an AMD
/// EPYC that draws with llvmpipe.
struct CostRates {
    double call = 0.05;
    double triangle = 8e-5;
    double texel = 1.3e-6;
    double pixel = 7e-6;
    double tap = 3.4e-6;
    double relit = 2.1e-4;
    double filled = 6e-6;
    double ray = 2e-4;
    double object = 2.5e-4;

    bool operator==(const CostRates& other) const;
};

/// Milliseconds.
double timeOf(const ShadowWork& work, const CostRates& rates);

} // namespace gnomon
