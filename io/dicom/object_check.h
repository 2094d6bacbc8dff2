#pragma once

#include <vector>

#include "io/presentation.h"
#include "io/segmentation.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Return whether an object from a worker keeps the promises of its struct: as many pixels, points and bits
/// as its sizes say. A file may have taken over the worker.
bool isConsistent(const Frame& frame);
bool isConsistent(const std::vector<Frame>& framesWithoutPixels);
bool isConsistent(const Presentation& presentation);
bool isConsistent(const Segmentation& segmentation);

/// Returns true, as the wire has checked everything that matters of other objects.
template <class T>
bool isConsistent(const T&) {
  return true;
}

}  // namespace volumen::dicom
