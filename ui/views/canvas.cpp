#include "ui/views/canvas.h"

#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QOpenGLWidget>
#include <QScreen>
#include <QTimer>

namespace volumen {

namespace {

class RasterCanvas : public QWidget {
 public:
  RasterCanvas(PaintCanvas paint, QWidget* parent) : QWidget(parent), paint_(std::move(paint)) {
    setAttribute(Qt::WA_OpaquePaintEvent);
  }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    paint_(painter);
  }

 private:
  PaintCanvas paint_;
};

class GlCanvas : public QOpenGLWidget {
 public:
  GlCanvas(PaintCanvas paint, std::function<void()> broken, QWidget* parent)
      : QOpenGLWidget(parent), paint_(std::move(paint)), broken_(std::move(broken)) {}

 protected:
  void paintGL() override {
    {
      QPainter painter(this);
      paint_(painter);
    }
    const GLenum error = context()->functions()->glGetError();
    if (error == GL_OUT_OF_MEMORY || !context()->isValid()) giveUp();
  }

  // An invalid context never paints, which shows only once the widget is visible.
  void showEvent(QShowEvent* event) override {
    QOpenGLWidget::showEvent(event);
    QTimer::singleShot(500, this, [this] {
      if (isVisible() && !isValid()) giveUp();
    });
  }

 private:
  void giveUp() {
    if (broken_) QTimer::singleShot(0, this, std::exchange(broken_, nullptr));
  }

  PaintCanvas paint_;
  std::function<void()> broken_;
};

// Tries a context first, because without one QOpenGLWidget shows nothing or the program ends. On screens with
// fewer than 24 bits per pixel it is black without an error.
bool openGlWorks() {
  const QScreen* screen = QGuiApplication::primaryScreen();
  if (!screen || screen->depth() < 24) return false;
  QOpenGLContext context;
  if (!context.create()) return false;
  QOffscreenSurface surface;
  surface.setFormat(context.format());
  surface.create();
  if (!surface.isValid() || !context.makeCurrent(&surface)) return false;
  const bool works = context.functions()->glGetString(GL_VERSION) != nullptr;
  context.doneCurrent();
  return works;
}

}  // namespace

QWidget* makeRasterCanvas(PaintCanvas paint, QWidget* parent) {
  auto* canvas = new RasterCanvas(std::move(paint), parent);
  canvas->setAttribute(Qt::WA_TransparentForMouseEvents);
  canvas->setObjectName(QStringLiteral("rasterCanvas"));
  return canvas;
}

QWidget* makeCanvas(PaintCanvas paint, std::function<void()> broken, QWidget* parent) {
  const QByteArray chosen = qgetenv("VOLUMEN_CANVAS");
  const bool gl = chosen == "gl" || (chosen != "raster" && openGlWorks());
  if (!gl) return makeRasterCanvas(std::move(paint), parent);
  auto* canvas = new GlCanvas(std::move(paint), std::move(broken), parent);
  canvas->setAttribute(Qt::WA_TransparentForMouseEvents);
  canvas->setObjectName(QStringLiteral("glCanvas"));
  return canvas;
}

QString canvasKind(const QWidget* canvas) {
  return qobject_cast<const QOpenGLWidget*>(canvas) ? QStringLiteral("OpenGL") : QStringLiteral("raster");
}

}  // namespace volumen
