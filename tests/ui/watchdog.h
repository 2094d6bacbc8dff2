#pragma once

#include <time.h>

#include <QApplication>
#include <QMetaEnum>
#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

namespace volumen::tests {

/// Measures how long the UI thread computes for each event, during which the window would not answer. It uses
/// processor time, so that a loaded machine does not count. Tests of the services check that the thread never
/// waits.
class WatchedApplication : public QApplication {
 public:
  using QApplication::QApplication;
  ~WatchedApplication() override { report(); }

  /// Returns the longest event since the last call, in ms of processor time.
  double takeMostMs() { return std::exchange(mostMs_, 0); }

  bool notify(QObject* receiver, QEvent* event) override {
    if (depth_ > 0) return QApplication::notify(receiver, event);
    const QObject* parent = receiver->parent();
    const QString what =
        QStringLiteral("%1 %2 of %3, %4")
            .arg(QLatin1String(receiver->metaObject()->className()), receiver->objectName(),
                 QLatin1String(parent ? parent->metaObject()->className() : "nobody"))
            .arg(QLatin1String(QMetaEnum::fromType<QEvent::Type>().valueToKey(event->type())));
    ++depth_;
    const double before = cpuMs();
    const bool done = QApplication::notify(receiver, event);
    const double ms = cpuMs() - before;
    --depth_;
    mostMs_ = std::max(mostMs_, ms);
    double& most = longest_[what];
    most = std::max(most, ms);
    return done;
  }

 private:
  static double cpuMs() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return 1e3 * double(now.tv_sec) + 1e-6 * double(now.tv_nsec);
  }

  // Reports events that take longer than a user may notice.
  void report() const {
    constexpr double mostMs = 20;
    for (const auto& [what, ms] : longest_)
      if (ms > mostMs) std::printf("UI thread: %6.1f ms for %s\n", ms, qPrintable(what));
  }

  int depth_ = 0;
  double mostMs_ = 0;
  std::map<QString, double> longest_;
};

}  // namespace volumen::tests
