#pragma once

#include <functional>
#include <memory>

#include "viewer/volume/result.h"

namespace volumen {

/// An OpenGL context of at least 3.3 core for one RenderCaches alone. All objects made in it end with it, and
/// no other code changes its state. It is made, used and current only on the rendering thread.
class GlContext {
 public:
  virtual ~GlContext() = default;
  /// Makes it the calling thread's context. Returns false on failure.
  virtual bool makeCurrent() = 0;
  virtual void doneCurrent() = 0;
};

/// Makes a context, or returns the reason for failure as half a sentence ("there is no libEGL").
using GlContextFactory = std::function<Result<std::unique_ptr<GlContext>>()>;

/// Makes a context without display or window: by EGL's surfaceless platform (Mesa), else on the first EGL
/// device that has OpenGL. Returns an Error, and never crashes, if EGL or OpenGL is missing.
Result<std::unique_ptr<GlContext>> makeEglContext();

/// Keeps a context current during a scope.
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
