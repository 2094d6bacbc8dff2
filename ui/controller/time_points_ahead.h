#pragma once

#include <QObject>
#include <vector>

#include "ui/workspace/session.h"

namespace volumen {

class Loader;

/// Loads the time points before and after the one in focus ahead of time, if memory for series has room
/// beside what is on screen.
class TimePointsAhead : public QObject {
  Q_OBJECT
 public:
  TimePointsAhead(Session& session, Loader& loader, QObject* parent);

 private:
  void look();
  void loadNext();

  Session& session_;
  Loader& loader_;
  std::weak_ptr<const LoadedSeries> seen_;  // series whose neighbours are in `wanted_`
  std::vector<SeriesKey> wanted_;           // neighbours not requested yet
};

}  // namespace volumen
