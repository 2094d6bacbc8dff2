#pragma once

#include <QObject>

#include "ui/exports/picture_sink.h"

namespace volumen {

/// Pictures that leave the window: which, and where to.
struct Export {
  JobName doing;  ///< an empty name is not listed
  PictureMakerPtr pictures;
  PictureSink sink;
};

/// Executes exports, each as a job with progress, and reports the end of each by one signal.
class Exports : public QObject {
  Q_OBJECT
 public:
  explicit Exports(Jobs& jobs, QObject* parent = nullptr) : QObject(parent), jobs_(jobs) {}
  ~Exports() override;

  /// Executes an export, beside others unless PictureMaker::isOneAtATime().
  void run(const Export& order);
  /// Returns whether closing the window would lose files or pages.
  bool isWriting() const;

 Q_SIGNALS:
  /// A sentence that reports success.
  void done(const QString& sentence);
  void failed(const QString& sentence);

 private:
  class Run;
  void beginNext();

  Jobs& jobs_;
  std::vector<Run*> runs_;  // those that have not ended
};

}  // namespace volumen
