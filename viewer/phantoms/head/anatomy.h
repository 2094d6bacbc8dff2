#pragma once

#include "viewer/phantoms/head/sdf.h"

/// The parts of a synthetic head as signed distances (mm). Patient space: +x left, +y posterior, +z superior;
/// the eyes are at about z = 4, the ear canals at y = 14, z = -12, vertex and chin at z = 116 and -113.
namespace volumen::head {

float cranialCavity(Vec p);   ///< the inside of the braincase
float skullThickness(Vec p);  ///< of the braincase, mm

// What lies at or around the braincase is told its distance: cavity = cranialCavity(p).

float skin(Vec p, float cavity);   ///< the outer surface of the head and neck
float skull(Vec p, float cavity);  ///< braincase (filled) and upper face, orbits and sinuses cut out
float orbit(Vec p, float cavity);  ///< the bony socket's inside
/// Air inside bone: frontal, maxillary, ethmoid, sphenoid sinuses, mastoid cells.
float sinuses(Vec p, float cavity);
float veins(Vec p, float cavity);  ///< sinuses of the dura and jugular veins
float arteries(Vec p);             ///< carotid and vertebral arteries, circle of Willis and its branches
float facialRelief(Vec p);         ///< cheek bone and rim of the left orbit, which show through the skin
float jaw(Vec p);                  ///< mandible
float spine(Vec p);                ///< cervical vertebrae and hyoid
float spinalCanal(Vec p);
float sutureGap(Vec p);   ///< sheets in which the vault's bones meet
float airways(Vec p);     ///< nasal cavity without turbinates and septum, pharynx, trachea, ear canals
float ventricles(Vec p);  ///< the brain's inner spaces

/// Distances to the nearest tooth.
struct Tooth {
  float distance;  ///< to the tooth
  float crown;     ///< to its crown
  float pulp;      ///< to its pulp
};
Tooth teeth(Vec p);

/// HU of what is inside the eye socket / the braincase / the soft tissue at p, `w` half the width of edges.
/// `depth`: distance to the inside of the wall, mm, positive.
float orbitValue(Vec p, float w);
float brainValue(Vec p, float depth, float w);
float softTissueValue(Vec p, float depth, float w);

}  // namespace volumen::head
