#pragma once

#include <memory>
#include <optional>

#include "ui/controller/frame_service.h"
#include "ui/document/derivation.h"
#include "ui/workspace/links.h"
#include "ui/workspace/session.h"
#include "viewer/measure/measure.h"

namespace volumen {

using MeasuredPtr = std::shared_ptr<const Result<Measured>>;

/// Inputs of the numbers of a measurement. Volumes are not kept in memory.
struct NumbersKey {
  Measurement measurement;
  PetUnit petUnit = PetUnit::file;
  std::weak_ptr<const Volume> volume{};      ///< of its series; empty for a frame
  std::optional<SeriesOver> over{};          ///< the series overlaid on that of a region
  std::weak_ptr<const Volume> overVolume{};  ///< of `over`; empty if not in memory
  bool operator==(const NumbersKey& other) const;
};

/// Returns the inputs of a measurement's numbers; nothing if its series is not in memory. Frames are read.
std::optional<NumbersKey> numbersKeyOf(const Session& session, const Measurement& measurement);

/// The numbers of all measurements of a session, and of one that is being drawn. Fast ones are there at once.
/// Others keep those of the shape before until theirs are computed. Regions have numbers of their series and
/// of one overlaid on it.
class MeasuredNumbers : public QObject {
  Q_OBJECT
 public:
  MeasuredNumbers(const Session& session, FrameService& frames);

  /// Returns the latest numbers of a measurement, or null if there are none yet.
  MeasuredPtr numbersOf(const Measurement& measurement);
  /// Returns the same, but null if the numbers belong to another shape.
  MeasuredPtr exactNumbersOf(const Measurement& measurement);

 Q_SIGNALS:
  /// Other numbers are ready.
  void changed();

 private:
  using Numbers = Derivation<NumbersKey, Result<Measured>>;
  Numbers::Rule rule();
  std::vector<NumbersKey> wanted() const;
  Numbers::Work workOf(const NumbersKey& key) const;
  bool isQuick(const NumbersKey& key) const;
  MeasuredPtr numbersOf(const Measurement& measurement, bool isExact);
  MeasuredPtr named(const Numbers::Entry& entry) const;

  const Session& session_;
  FrameService& frames_;
  std::optional<Measurement> drawn_;  // the last one that is not in the workspace
  Numbers numbers_;
};

}  // namespace volumen
