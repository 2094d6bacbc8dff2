#pragma once

#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Compiles and links a program of GLSL 3.30: `defines` (whole lines) stand before each shader, the fragment
/// shader's texts one behind the other. Returns its name in the current context; an Error where OpenGL
/// refuses it.
Result<unsigned> makeProgram(const std::string& defines, const char* vertexText,
                             const std::vector<const char*>& fragmentTexts);

/// A buffer that shaders read texel by texel. Its names go with the context.
class BufferTexture {
 public:
  /// Replaces the content; `format` is that of a texel (GL_RGBA32F, ...). An Error where it has more texels
  /// than OpenGL here takes.
  Status upload(unsigned format, std::size_t texels, const void* data, std::size_t bytes);
  void bind(int unit) const;

 private:
  unsigned buffer_ = 0, texture_ = 0;
};

}  // namespace volumen
