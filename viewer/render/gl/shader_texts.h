#pragma once

namespace volumen {

/// The files of resources/shaders, compiled in; without their #version line.
extern const char* const planesVertexShader;
extern const char* const planesFragmentShader;

}  // namespace volumen
