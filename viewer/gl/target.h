#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace volumen {

/// Forgets OpenGL's errors so far, so that the next one comes of what follows.
void clearGlErrors();

/// A 2D texture without content, its texels not interpolated, of a format like GL_RGBA32F. It stays bound.
unsigned makePlainTexture(unsigned format, glm::ivec2 size);

/// A picture that is drawn, four components a pixel. Its names go with the context.
class PictureTarget {
 public:
  /// Makes it, in place of what was there, in a format like GL_RGBA32F. False where OpenGL has no room.
  bool make(unsigned format, glm::ivec2 size);
  glm::ivec2 size() const { return size_; }      ///< 0 where nothing is made
  unsigned texture() const { return texture_; }  ///< to read it; 0 where nothing is made
  /// Makes all of it what is drawn into.
  void use() const;
  /// Four floats a pixel, row by row, until the next call. Empty where OpenGL failed.
  const std::vector<float>& pixels();

 private:
  unsigned framebuffer_ = 0, texture_ = 0;
  glm::ivec2 size_{0};
  std::vector<float> pixels_;
};

/// Samples that are drawn and brought back through a pixel buffer while OpenGL goes on. Its names go with the
/// context.
class SampleTarget {
 public:
  /// Makes it; free() it first where it was made before. False where OpenGL has no room.
  bool make(glm::ivec2 size, bool gradients);
  void free();
  /// Makes all of it what is drawn into.
  void use() const;
  /// Starts to bring the first rows back.
  void startReading(int rows);
  /// Densities row by row; gradients four floats each, null where it has none.
  struct Samples {
    const float *density = nullptr, *gradients = nullptr;
  };
  /// Waits for the rows last asked for. They are there until unmap(); null where OpenGL failed.
  Samples map();
  void unmap();

 private:
  unsigned framebuffer_ = 0, density_ = 0, gradients_ = 0, buffer_ = 0;  ///< gradients_ 0: it has none
  glm::ivec2 size_{0};
  int rows_ = 0;  ///< last asked for
};

}  // namespace volumen
