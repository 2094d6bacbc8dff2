#pragma once

#include <map>
#include <string>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Programs built from the same shader texts, compiled on first use and kept by their defines. Names end with
/// the context.
class Programs {
 public:
  /// Compiles and links a program of GLSL 3.30. `defines` (whole lines) precede each shader; the fragment
  /// shader's texts are concatenated. Returns its name in the current context, or an Error if OpenGL refuses
  /// it.
  Result<unsigned> of(const std::string& defines, const char* vertexText,
                      const std::vector<const char*>& fragmentTexts);

 private:
  std::map<std::string, unsigned> made_;
};

/// Binds a texture of a kind like GL_TEXTURE_2D to a texture unit; 0 unbinds.
void bindTexture(int unit, unsigned kind, unsigned texture);

/// A buffer that shaders read texel by texel. Its names end with the context.
class BufferTexture {
 public:
  /// Replaces the content. `format` is that of a texel (GL_RGBA32F, ...). Returns an Error if there are more
  /// texels than OpenGL accepts.
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
