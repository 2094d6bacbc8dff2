#pragma once

#include "viewer/gl/gl_context.h"

namespace volumen {

/// Makes, on the UI thread, the surface without a window that Qt's contexts of other threads draw to. False
/// where the platform has no OpenGL; nothing else depends on it. Later calls answer at once.
bool makeOffscreenGlSurface();

/// A context of Qt's for the thread that calls it, on the surface above: the platform's own OpenGL, so on a
/// machine with a GPU the GPU's. An Error where makeOffscreenGlSurface() has not succeeded or no context
/// of 3.3 core can be made.
Result<std::unique_ptr<GlContext>> makeQtGlContext();

}  // namespace volumen
