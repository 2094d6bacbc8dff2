#pragma once

#include <QPainter>
#include <QWidget>
#include <functional>

namespace volumen {

/// Paints the content of a canvas, in its logical pixels.
using PaintCanvas = std::function<void(QPainter&)>;

/// A widget that is painted by `paint`: a QOpenGLWidget where an OpenGL context can be made and the
/// screen has 24 bits a pixel, else a raster widget; both show the same. VOLUMEN_CANVAS=raster or gl chooses.
/// Mouse events go to the parent. `broken` is called, from the event loop, if OpenGL fails later: put a
/// raster canvas in its place.
QWidget* makeCanvas(PaintCanvas paint, std::function<void()> broken, QWidget* parent);
QWidget* makeRasterCanvas(PaintCanvas paint, QWidget* parent);

/// What draws a canvas made by one of these, for About: "OpenGL" or "raster".
QString canvasKind(const QWidget* canvas);

}  // namespace volumen
