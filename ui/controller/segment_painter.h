#pragma once

#include <QObject>
#include <optional>

#include "ui/workspace/segment_stroke.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Restrictions of strokes.
struct PaintLimits {
  enum class Beside { anywhere, inside, outside };
  std::optional<ValueRange> range{};  ///< paints and erases only values of this range; empty for all
  Beside beside = Beside::anywhere;   ///< position of painted voxels relative to another segment
  int other = 0;                      ///< number of that segment
};

/// Paints or erases the current segment during a stroke; each stroke is one undo step. The first stroke
/// creates a segment if there is none. Locked segments stay unchanged.
class SegmentPainter : public QObject {
  Q_OBJECT
 public:
  explicit SegmentPainter(Session& session, QObject* parent = nullptr) : QObject(parent), session_(session) {}

  /// Paints the next part of a stroke, with the limits of its start. Nothing is painted if the stroke could
  /// not begin, the segment is gone or locked, or the series was closed.
  void paint(const SegmentStroke& stroke, const PaintLimits& limits);
  /// Returns whether a stroke is being drawn.
  bool isPainting() const { return target_.has_value(); }

 Q_SIGNALS:
  /// `said` is a sentence about voxels taken from other segments; empty if there are none.
  void ended(const QString& said);
  /// A sentence why a stroke paints nothing.
  void failed(const QString& sentence);

 private:
  // The target of a stroke that has begun.
  struct Target {
    VolumePtr volume;
    int map;
    int number;  // of the segment in `map`; 0 if painting will create it
    PaintLimits limits;
    SegmentMap before;
  };
  QString whyNot(const SegmentStroke& stroke) const;
  void add(const SegmentStroke& stroke);
  void end();

  Session& session_;
  std::optional<Target> target_;
};

}  // namespace volumen
