#pragma once

#include <string>
#include <vector>

#include "viewer/scene/scene.h"
#include "viewer/volume/volume.h"

namespace volumen::tests {

/// A volume and a scene that every renderer is tried on.
struct PictureCase {
  const char* name;    ///< what the case proves
  const char* volume;  ///< for caseVolume
  Scene scene;
};

/// Cameras, lights, clips, curves and modes over oblique, sheared, left-handed and anisotropic grids, made
/// and real. Curves are set by the volume's percentiles.
const std::vector<PictureCase>& pictureCases();

/// The volume of a case: one made here ("bumpy", "bumpy oblique" ...) or a path inside the real test data,
/// loaded once. Null where the real data are absent; throws where they cannot be loaded.
VolumePtr caseVolume(const std::string& name);

}  // namespace volumen::tests
