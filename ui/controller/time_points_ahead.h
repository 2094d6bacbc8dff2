#pragma once

#include <QObject>
#include <vector>

#include "ui/workspace/session.h"

namespace volumen {

class Loader;

/// Has the time points next to the one of the view in focus loaded before they are asked for, on both sides,
/// where the memory for series has room for them beside what is on screen.
class TimePointsAhead : public QObject {
  Q_OBJECT
 public:
  TimePointsAhead(Session& session, Loader& loader, QObject* parent);

 private:
  void look();
  void loadNext();

  Session& session_;
  Loader& loader_;
  std::weak_ptr<const LoadedSeries> seen_;  // the one that `wanted_` lie next to
  std::vector<SeriesKey> wanted_;           // those not looked for yet
};

}  // namespace volumen
