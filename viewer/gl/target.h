#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace volumen {

/// Discards OpenGL's pending errors, so that the next error belongs to the calls that follow.
void clearGlErrors();

/// Makes an empty 2D texture without interpolation, of a format like GL_RGBA32F. It stays bound.
unsigned makePlainTexture(unsigned format, glm::ivec2 size);

/// A picture to draw into, four components per pixel. Its names end with the context.
class PictureTarget {
 public:
  /// Makes or replaces the picture in a format like GL_RGBA32F. Returns false if OpenGL runs out of memory.
  bool make(unsigned format, glm::ivec2 size);
  glm::ivec2 size() const { return size_; }      ///< 0 if nothing is made.
  unsigned texture() const { return texture_; }  ///< Texture to read from; 0 if nothing is made.
  /// Makes the whole picture the current draw target.
  void use() const;
  /// Returns four floats per pixel, row by row, valid until the next call; empty if OpenGL failed.
  const std::vector<float>& pixels();

 private:
  unsigned framebuffer_ = 0, texture_ = 0;
  glm::ivec2 size_{0};
  std::vector<float> pixels_;
};

/// Samples that are drawn and read back asynchronously through a pixel buffer. Its names end with the
/// context.
class SampleTarget {
 public:
  /// Makes the target; call free() before making it again. Returns false if OpenGL runs out of memory.
  bool make(glm::ivec2 size, bool gradients);
  void free();
  /// Makes the whole target the current draw target.
  void use() const;
  /// Starts to read back the first `rows` rows.
  void startReading(int rows);
  /// Densities row by row; gradients of four floats each, null if it has none.
  struct Samples {
    const float *density = nullptr, *gradients = nullptr;
  };
  /// Waits for the rows last requested and returns them, valid until unmap(); null if OpenGL failed.
  Samples map();
  void unmap();

 private:
  unsigned framebuffer_ = 0, density_ = 0, gradients_ = 0, buffer_ = 0;  ///< gradients_ 0: without gradients.
  glm::ivec2 size_{0};
  int rows_ = 0;  ///< Last requested.
};

}  // namespace volumen
