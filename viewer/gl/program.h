#pragma once

#include <map>
#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Programs of the same texts, made when first asked for and kept by their defines. Names go with the
/// context.
class Programs {
 public:
  /// Compiles and links a program of GLSL 3.30: `defines` (whole lines) stand before each shader, the
  /// fragment shader's texts one behind the other. Returns its name in the current context; an Error where
  /// OpenGL refuses it.
  Result<unsigned> of(const std::string& defines, const char* vertexText,
                      const std::vector<const char*>& fragmentTexts);

 private:
  std::map<std::string, unsigned> made_;
};

/// Binds a texture of a kind like GL_TEXTURE_2D to a texture unit; 0: none.
void bindTexture(int unit, unsigned kind, unsigned texture);

/// A buffer that shaders read texel by texel. Its names go with the context.
class BufferTexture {
 public:
  /// Replaces the content; `format` is that of a texel (GL_RGBA32F, ...). An Error where it has more texels
  /// than OpenGL here takes.
  template <class T>
  Status upload(unsigned format, int texelBytes, const std::vector<T>& values) {
    const std::size_t bytes = values.size() * sizeof(T);
    return uploadBytes(format, bytes / texelBytes, values.data(), bytes);
  }
  void bind(int unit) const;

 private:
  Status uploadBytes(unsigned format, std::size_t texels, const void* data, std::size_t bytes);

  unsigned buffer_ = 0, texture_ = 0;
};

}  // namespace volumen
