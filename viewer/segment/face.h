#pragma once

#include "viewer/segment/bit_mask.h"
#include "viewer/volume/cancel.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Returns the voxels by which a person could be recognised in a rendering of a head of CT or MR: the outer
/// layer of face, forehead and most of the ears, and the air in front of them, so that no contour is left.
///
/// The point of the head that lies deepest below its surface, searched from above down to the neck, is the
/// middle of the skull, and its depth the scale: the lengths here are those of an adult, 73 mm deep. The
/// region is in front of a plane 20 mm behind the middle, which leans back by 15 degrees, and within 190 mm
/// of the middle. There it takes what is less than 25 mm deep, but keeps the skull: balls of three quarters
/// of the depth that fit into the head, with centres at the height of the middle or above, less 5 mm, the
/// skin. It holds for parts of heads, for heads turned by some 20 degrees, and for all grids.
///
/// What it cannot promise: that nobody recognises what is left (skull, jaw and the shape of the head stay,
/// and so do faces in other series). Nor can it tell a head from a limb, or from a brain cut out of its head,
/// whose front it would take away.
///
/// The Error: the modality is known and neither CT nor MR, the volume is not calibrated, thinner than
/// 30 mm or larger than a cubic metre, it shows no head with air around it, or cancelled.
Result<BitMask> faceOf(const Volume& volume, const CancelToken& cancel = {});

/// Returns a copy of the volume in which the face (faceOf()) is air. The Errors are those of faceOf(), or too
/// little memory.
Result<VolumePtr> defaced(const Volume& volume, const CancelToken& cancel = {});

}  // namespace volumen
