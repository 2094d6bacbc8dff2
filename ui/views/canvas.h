#pragma once

#include <QPainter>
#include <QWidget>
#include <functional>

namespace volumen {

/// Paints the content of a canvas in its logical pixels.
using PaintCanvas = std::function<void(QPainter&)>;

/// Makes a widget painted by `paint`. It is a QOpenGLWidget if an OpenGL context can be made and the screen
/// has 24 bits per pixel, otherwise a raster widget. Both show the same; VOLUMEN_CANVAS=raster or gl chooses.
/// Mouse events go to the parent. If OpenGL fails later, `broken` is called from the event loop; the caller
/// then replaces the widget by a raster canvas.
QWidget* makeCanvas(PaintCanvas paint, std::function<void()> broken, QWidget* parent);
QWidget* makeRasterCanvas(PaintCanvas paint, QWidget* parent);

/// Returns what draws a canvas made here, for About: "OpenGL" or "raster".
QString canvasKind(const QWidget* canvas);

}  // namespace volumen
