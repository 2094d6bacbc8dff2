#pragma once

#include <QObject>
#include <optional>

#include "ui/workspace/segment_options.h"
#include "ui/workspace/session.h"
#include "viewer/segment/brush.h"

namespace volumen {

/// The answer to a request to edit segments, in a sentence for the user.
struct SegmentAnswer {
  enum class Kind {
    done,
    noted,    ///< done, and the sentence says something about the result that should not be missed
    refused,  ///< impossible now; nothing has begun
    failed
  };
  Kind kind = Kind::done;
  QString sentence;
};

/// A part of a stroke that paints or erases the current segment of a series. It is the first, a further one,
/// or the end, which paints nothing.
struct SegmentStroke {
  enum class Phase { begins, goesOn, ends };
  Phase phase = Phase::begins;
  SeriesKey series{};
  VoxelSpans spans{};  ///< on the grid of its volume
  bool erases = false;
  bool onFrame = false;  ///< on a picture that is no slice of a volume
};

/// Paints or erases the current segment during a stroke; each stroke is one undo step. The first stroke
/// creates a segment if there is none. Locked segments stay unchanged.
class SegmentPainter : public QObject {
  Q_OBJECT
 public:
  explicit SegmentPainter(Session& session, QObject* parent = nullptr) : QObject(parent), session_(session) {}

  /// Paints the next part of a stroke, with the limits chosen at its start. Nothing is painted if the stroke
  /// could not begin, the segment is gone or locked, or the series was closed.
  void paint(const SegmentStroke& stroke, const SegmentOptions& options);
  /// Returns whether a stroke is being drawn.
  bool isPainting() const { return target_.has_value(); }

 Q_SIGNALS:
  /// A stroke ended.
  void ended();
  /// A stroke took voxels from other segments, or a stroke is refused.
  void answered(const volumen::SegmentAnswer& answer);

 private:
  // The target of a stroke that has begun.
  struct Target {
    VolumePtr volume;
    int map;
    int number;             // of the segment in `map`; 0 if painting will create it
    SegmentOptions limits;  // its `other` is a segment of `map`, or 0
    SegmentMap before;
  };
  QString whyNot(const SegmentStroke& stroke) const;
  void add(const SegmentStroke& stroke);
  void end();

  Session& session_;
  std::optional<Target> target_;
};

}  // namespace volumen
