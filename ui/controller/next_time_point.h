#pragma once

#include <QObject>

#include "ui/workspace/session.h"

namespace volumen {

class Loader;

/// Has the next time point of the view in focus loaded before it is asked for, where the memory for series
/// has room for it beside what is on screen.
class NextTimePoint : public QObject {
  Q_OBJECT
 public:
  NextTimePoint(Session& session, Loader& loader, QObject* parent);

 private:
  void look();

  Session& session_;
  Loader& loader_;
  std::weak_ptr<const ShownSeries> seen_;  // the next one of which was looked for
};

}  // namespace volumen
