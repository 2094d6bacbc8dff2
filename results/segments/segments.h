#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/segments/segment_map.h"
#include "viewer/segment/bit_mask.h"

namespace volumen {

/// Returns the segment with this number, or null.
const Segment* findSegment(const SegmentMap& map, int number);
/// Returns the segment that panel and tools work on: the chosen one, else the first; null if there are none.
const Segment* currentSegment(const SegmentMap& map);
/// Returns the smallest unused number; empty if all 255 are taken.
std::optional<int> freeNumber(const SegmentMap& map);
/// Returns `wanted`, with a number behind it if another segment has that name: "Bone (2)".
std::string freeName(const SegmentMap& map, const std::string& wanted);
/// Returns the colour of a number, which new segments get as their own (freeColour()). Every file states it,
/// as other programs choose colours for segments without one.
glm::u8vec3 colourOfNumber(int number);
/// Returns the numbers of locked segments.
std::vector<std::uint8_t> lockedNumbers(const SegmentMap& map);
/// Returns whether the labels lie on this grid; false if they were not read.
bool isOn(const SegmentMap& map, const VoxelGeometry& grid);

// The functions below are slow in large volumes: call them on other threads. The map has labels.

/// Gives a segment exactly these voxels, but none of a locked segment. Does nothing if there is no such
/// segment or it is locked.
SegmentMap withMask(SegmentMap map, int number, const BitMask& mask);
/// Removes a segment; its voxels become background, and the segment before it is current. Does nothing if
/// there is no such segment or it is locked.
SegmentMap withoutSegment(SegmentMap map, int number);

// The functions below are fast.

/// Adds a segment without voxels and makes it current; its number must be free. Without a colour it gets one
/// that no other segment there has.
SegmentMap withSegment(SegmentMap map, Segment segment);
/// Adds a segment without voxels and makes it current. It keeps its number if free, else gets the smallest
/// free one. It gets a colour and a name if it has none, and another name if its own is taken. Does nothing
/// if there are 255.
SegmentMap withSegmentAdded(SegmentMap map, Segment segment);

}  // namespace volumen
