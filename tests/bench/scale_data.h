#pragma once

#include <string>

#include "viewer/volume/volume.h"

// Made-up studies of any size for bench_scale: the same bytes for the same numbers.

namespace volumen::bench {

/// Writes an enhanced MR of 64 x 64 x 40 voxels at each of `timePoints` as one file, of this series.
inline constexpr const char* enhancedUid = "1.2.3.4.500";
void writeEnhanced(const std::string& path, int timePoints);

/// Writes CT slices of 8 x 8 pixels into `folder`, `aSeries` in each series.
void writeSlices(const std::string& folder, int files, int aSeries);

/// Writes a radiograph of `edge` x `edge` pixels.
void writeRadiograph(const std::string& path, int edge);

/// Writes a head of 512 x 512 x `slices` voxels as NRRD. Past the slices of the phantom `ct-head` those of
/// the head return in turn, upwards and downwards.
void writeHead(const std::string& path, int slices);

/// Writes a volume of 512 x 512 x 138 random values from 0 to 999 as NRRD.
void writeNoise(const std::string& path);

/// Writes a recipe of `segments` segments, each of an even share of the values from 0 to 999.
void writeNoiseRecipe(const std::string& path, int segments);

}  // namespace volumen::bench
