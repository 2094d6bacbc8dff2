#pragma once

#include "io/presentation.h"
#include "io/segmentation.h"
#include "viewer/slice/frame.h"

namespace volumen::dicom {

/// Whether what comes from a worker keeps to what the struct promises: as many pixels, points and bits as its
/// sizes say. A file may have taken over the worker.
bool isConsistent(const Frame& frame);
bool isConsistent(const Presentation& presentation);
bool isConsistent(const Segmentation& segmentation);

/// Of other things the wire has checked all that counts.
template <class T>
bool isConsistent(const T&) {
  return true;
}

}  // namespace volumen::dicom
