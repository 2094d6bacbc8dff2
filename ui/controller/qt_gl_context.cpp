#include "ui/controller/qt_gl_context.h"

#include <QCoreApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QSurfaceFormat>
#include <atomic>

namespace volumen {

namespace {

QSurfaceFormat core33() {
  QSurfaceFormat format;
  format.setVersion(3, 3);
  format.setProfile(QSurfaceFormat::CoreProfile);
  return format;
}

// Made and destroyed on the UI thread, owned by the application. Other threads only make contexts current on
// it.
std::atomic<QOffscreenSurface*> surface{nullptr};

class QtGlContext : public GlContext {
 public:
  bool create() {
    context_.setFormat(core33());
    return context_.create() && context_.format().version() >= qMakePair(3, 3);
  }
  bool makeCurrent() override { return context_.makeCurrent(surface.load()); }
  void doneCurrent() override { context_.doneCurrent(); }

 private:
  QOpenGLContext context_;
};

}  // namespace

bool makeOffscreenGlSurface() {
  if (surface.load()) return true;
  QOpenGLContext probe;
  probe.setFormat(core33());
  if (!probe.create()) return false;
  auto made = std::make_unique<QOffscreenSurface>(nullptr, QCoreApplication::instance());
  made->setFormat(probe.format());
  made->create();
  if (!made->isValid() || !probe.makeCurrent(made.get())) return false;
  probe.doneCurrent();
  QObject::connect(made.get(), &QObject::destroyed, [] { surface = nullptr; });
  surface = made.release();
  return true;
}

Result<std::unique_ptr<GlContext>> makeQtGlContext() {
  if (!surface.load()) return Error{"the platform has no OpenGL without a window"};
  auto context = std::make_unique<QtGlContext>();
  if (!context->create() || !context->makeCurrent()) return Error{"Qt could make no context of OpenGL 3.3"};
  context->doneCurrent();
  return Result<std::unique_ptr<GlContext>>(std::move(context));
}

}  // namespace volumen
