#pragma once

#include "viewer/phantoms/head/sdf.h"

/// The parts of a synthetic head as signed distances (mm). Patient space: +x left, +y posterior, +z superior.
/// The eyes are at about z = 4, the ear canals at y = 14, z = -12, the vertex at z = 116 and the chin at z =
/// -113.
namespace volumen::head {

float cranialCavity(Vec p);   ///< Inside of the braincase.
float skullThickness(Vec p);  ///< Thickness of the braincase, mm.

// Functions of structures at or around the braincase take `cavity` = cranialCavity(p).

float skin(Vec p, float cavity);   ///< Outer surface of the head and neck.
float skull(Vec p, float cavity);  ///< Braincase (filled) and upper face, without orbits and sinuses.
float orbit(Vec p, float cavity);  ///< Inside of the bony socket.
/// Air inside bone: frontal, maxillary, ethmoid, sphenoid sinuses, mastoid cells.
float sinuses(Vec p, float cavity);
float veins(Vec p, float cavity);  ///< Sinuses of the dura and jugular veins.
float arteries(Vec p);             ///< Carotid and vertebral arteries, circle of Willis and its branches.
float facialRelief(Vec p);         ///< Cheek bone and rim of the left orbit, which show through the skin.
float jaw(Vec p);                  ///< Mandible.
float spine(Vec p);                ///< Cervical vertebrae and hyoid.
float spinalCanal(Vec p);
float sutureGap(Vec p);   ///< Gaps in which the vault's bones meet.
float airways(Vec p);     ///< Nasal cavity without turbinates and septum, pharynx, trachea, ear canals.
float ventricles(Vec p);  ///< Inner spaces of the brain.

/// Signed distances to the nearest tooth.
struct Tooth {
  float distance;  ///< Distance to the tooth.
  float crown;     ///< Distance to its crown.
  float pulp;      ///< Distance to its pulp.
};
Tooth teeth(Vec p);

/// Return the HU inside the eye socket, the braincase and the soft tissue at p. `w`: half the width of edges.
/// `depth`: distance to the inside of the wall, mm, positive.
float orbitValue(Vec p, float w);
float brainValue(Vec p, float depth, float w);
float softTissueValue(Vec p, float depth, float w);

}  // namespace volumen::head
