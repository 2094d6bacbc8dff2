#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A volume and a scene that every renderer draws.
struct PictureCase {
  const char* name;    ///< says what the case proves
  const char* volume;  ///< argument of caseVolume
  Scene scene;
};

/// Returns cameras, lights, clips, curves and modes over oblique, sheared, left-handed and anisotropic grids,
/// synthetic and real. Curves are set by the volume's percentiles.
const std::vector<PictureCase>& pictureCases();

/// Returns the volume of a case: a synthetic one ("bumpy", "bumpy oblique" ...) or a path inside the real
/// test data, loaded once. Returns null if the real data are absent and throws if they cannot be loaded.
VolumePtr caseVolume(const std::string& name);

}  // namespace volumen::tests
