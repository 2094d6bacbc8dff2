#pragma once

#include "viewer/gl/gl_context.h"

namespace volumen {

/// Makes the offscreen surface for Qt's contexts on other threads. Call it on the UI thread. Returns false if
/// the platform has no OpenGL, which affects nothing else. Later calls return at once.
bool makeOffscreenGlSurface();

/// Returns a context from Qt for the calling thread on that surface. It uses the platform's OpenGL, so the
/// GPU if there is one. An Error means that makeOffscreenGlSurface() has not succeeded or no 3.3 core context
/// can be made.
Result<std::unique_ptr<GlContext>> makeQtGlContext();

}  // namespace volumen
