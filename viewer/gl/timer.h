#pragma once

#include <epoxy/gl.h>

#include <array>

namespace volumen {

/// Measures the time OpenGL spends on the commands between begin() and end(), with one query for each of two
/// slots. Names end with the context.
class GlTimer {
 public:
  void begin(int slot) {
    if (!queries_[0]) glGenQueries(2, queries_.data());
    glBeginQuery(GL_TIME_ELAPSED, queries_[slot]);
  }
  void end() { glEndQuery(GL_TIME_ELAPSED); }
  /// Waits for the slot's work and returns its time in ms.
  double ms(int slot) const {
    GLuint64 ns = 0;
    glGetQueryObjectui64v(queries_[slot], GL_QUERY_RESULT, &ns);
    return double(ns) * 1e-6;
  }

 private:
  std::array<GLuint, 2> queries_{};
};

}  // namespace volumen
