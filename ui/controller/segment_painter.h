#pragma once

#include <QObject>
#include <optional>

#include "ui/workspace/segment_stroke.h"
#include "ui/workspace/session.h"

namespace volumen {

/// Where strokes paint.
struct PaintLimits {
  enum class Beside { anywhere, inside, outside };
  std::optional<ValueRange> range{};  ///< only values of this range, erased ones too; none: all
  Beside beside = Beside::anywhere;   ///< what is painted, with another segment
  int other = 0;                      ///< its number
};

/// Paints the current segment, or erases from it, while a stroke is drawn: one undo step each. Where there is
/// no segment, the first stroke makes one. Locked ones stay as they are.
class SegmentPainter : public QObject {
  Q_OBJECT
 public:
  explicit SegmentPainter(Session& session, QObject* parent = nullptr) : QObject(parent), session_(session) {}

  /// The next part of a stroke, limited as it began. Nothing more is painted where it could not begin, the
  /// segment is gone or locked, or the series closed meanwhile.
  void paint(const SegmentStroke& stroke, const PaintLimits& limits);
  /// Whether a stroke is being drawn.
  bool isPainting() const { return target_.has_value(); }

 Q_SIGNALS:
  /// `said`: what the stroke took from other segments, a sentence; empty: nothing.
  void ended(const QString& said);
  /// Why a stroke paints nothing, a sentence.
  void failed(const QString& sentence);

 private:
  // What a stroke that began works on.
  struct Target {
    VolumePtr volume;
    int map;
    int number;  // of the segment in it; 0: it is made once something is painted
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
