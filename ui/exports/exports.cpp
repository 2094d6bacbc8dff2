#include "ui/exports/exports.h"

#include <QTimer>
#include <algorithm>

namespace volumen {

namespace {

constexpr int tellEveryMs = 200;

}  // namespace

// One export. Deletes itself after its end.
class Exports::Run : public QObject {
 public:
  Run(Exports& exports, const Export& order)
      : QObject(&exports), exports_(exports), order_(order), job_(order.doing) {
    tick_.setInterval(tellEveryMs);
    connect(&tick_, &QTimer::timeout, this, [this] { order_.pictures->tellProgress(job_, made_); });
    if (isListed()) exports_.jobs_.add(job_, [this] { cancel(); });
  }
  ~Run() override {
    exports_.jobs_.remove(job_);
    lane_.wait();
  }

  void begin() {
    hasBegun_ = true;
    order_.pictures->tellProgress(job_, made_);
    tick_.start();
    write<Status>(order_.sink.begin, [this](const Status& begun) { begun ? next() : fail(begun.error()); });
  }
  bool hasBegun() const { return hasBegun_; }
  bool isOneAtATime() const { return order_.pictures->isOneAtATime(); }
  bool isWriting() const { return !order_.sink.isInWindow; }

 private:
  bool isListed() const { return !job_.name().text().isEmpty(); }

  template <class Outcome, class Work, class Then>
  void write(Work work, Then then) {
    if (order_.sink.isInWindow) return then(work());
    lane_.run(
        {}, [work](const Job&) { return work(); }, [then](const Outcome& outcome) { then(outcome); });
  }

  void next() {
    if (made_ == order_.pictures->count()) return finish();
    order_.pictures->make(made_, lane_, [this](const Result<MadePicture>& made) {
      if (hasEnded_) return;
      if (!made) return fail(made.error());
      write<Status>([take = order_.sink.take, n = made_, picture = *made] { return take(n, picture); },
                    [this](const Status& taken) {
                      if (!taken) return fail(taken.error());
                      order_.pictures->tellProgress(job_, ++made_);
                      next();
                    });
    });
  }

  void finish() {
    exports_.jobs_.remove(job_);
    if (isListed()) exports_.jobs_.add(job_, {}, false);
    write<Result<QString>>([finish = order_.sink.finish, n = made_] { return finish(n); },
                           [this](const Result<QString>& finished) {
                             if (!finished) return fail(finished.error());
                             end();
                             Q_EMIT exports_.done(*finished);
                           });
  }

  void cancel() {
    if (hasBegun_) order_.pictures->giveUp();
    fail({order_.pictures->cancelledText().toStdString()});
  }

  void fail(const Error& error) {
    if (hasEnded_) return;
    end();
    Q_EMIT exports_.failed(QString::fromStdString(error.message));
  }

  // Deletes itself after the current drawing or writing.
  void end() {
    hasEnded_ = true;
    tick_.stop();
    lane_.giveUpAll();
    exports_.jobs_.remove(job_);
    std::erase(exports_.runs_, this);
    lane_.run(
        {}, [](const Job&) {}, [this] { deleteLater(); });
    QTimer::singleShot(0, &exports_, &Exports::beginNext);
  }

  Exports& exports_;
  const Export order_;
  const Job job_;
  QTimer tick_;
  std::size_t made_ = 0;  // pictures that the sink has taken
  bool hasBegun_ = false, hasEnded_ = false;
  JobLane lane_;
};

Exports::~Exports() {
  for (QObject* run : QObjectList(children())) delete run;
}

void Exports::run(const Export& order) {
  runs_.push_back(new Run(*this, order));
  beginNext();
}

void Exports::beginNext() {
  bool isBusy =
      std::ranges::any_of(runs_, [](const Run* run) { return run->hasBegun() && run->isOneAtATime(); });
  for (Run* run : std::vector<Run*>(runs_)) {
    if (run->hasBegun() || (isBusy && run->isOneAtATime())) continue;
    isBusy = isBusy || run->isOneAtATime();
    run->begin();
  }
}

bool Exports::isWriting() const { return std::ranges::any_of(runs_, &Run::isWriting); }

}  // namespace volumen
