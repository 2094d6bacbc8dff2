#pragma once

#include <functional>
#include <memory>

#include "viewer/volume/result.h"

namespace volumen {

/// An OpenGL context of at least 3.3 core, of one RenderCaches alone: what is made in it goes with it, and
/// nobody else changes its state. It is made, used and current only on the thread that renders.
class GlContext {
 public:
  virtual ~GlContext() = default;
  /// Makes it the calling thread's context; false where that cannot be.
  virtual bool makeCurrent() = 0;
  virtual void doneCurrent() = 0;
};

/// Makes a context, or says in half a sentence why there is none ("there is no libEGL").
using GlContextFactory = std::function<Result<std::unique_ptr<GlContext>>()>;

/// A context without display or window: EGL's surfaceless platform (Mesa), else the first EGL device that has
/// OpenGL. Nothing fails harder than an Error where there is no EGL or no OpenGL.
Result<std::unique_ptr<GlContext>> makeEglContext();

/// Keeps a context current in a scope.
class CurrentContext {
 public:
  explicit CurrentContext(GlContext& context) : context_(context), current_(context.makeCurrent()) {}
  ~CurrentContext() {
    if (current_) context_.doneCurrent();
  }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  explicit operator bool() const { return current_; }

 private:
  GlContext& context_;
  bool current_;
};

}  // namespace volumen
