#include "ui/document/jobs.h"

#include <QElapsedTimer>
#include <QLocale>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "results/text/text.h"

namespace volumen {

struct Job::State {
  int id = 0;
  JobName name;
  CancelToken cancel;
  QElapsedTimer since;
  std::atomic<bool> begun = false;
  std::mutex mutex;  // guards the members below
  QString text;
  double part = -1;
};

JobName::JobName(const QString& d, const QString& o) : doing(d), object(o) {
  constexpr int longest = 30, kept = (longest - 1) / 2;
  if (object.size() > longest) object = object.left(kept) + QChar(0x2026) + object.right(kept);
}

QString JobName::text() const {
  return object.isEmpty() || namesHidden() ? doing : Jobs::tr("%1 %2").arg(doing, object);
}

Job::Job(const JobName& name) : state_(std::make_shared<State>()) {
  static std::atomic<int> last = 0;
  state_->id = ++last;
  state_->name = name;
  state_->since.start();
}

int Job::id() const { return state_->id; }
const JobName& Job::name() const { return state_->name; }
const CancelToken& Job::cancel() const { return state_->cancel; }

bool Job::hasBegun() const { return state_->begun; }

bool Job::begin() const {
  state_->begun = true;
  return !cancelled();
}

void Job::tell(const QString& text, double part) const {
  const std::lock_guard lock(state_->mutex);
  state_->text = text;
  state_->part = part;
}

Progress Job::progress() const {
  return [job = *this](const char* what, std::size_t done, std::size_t total) {
    const QString text = QString::fromUtf8(what);
    if (total == 0) return job.tell(text, -1);
    const QLocale locale;
    job.tell(Jobs::tr("%1: %2 of %3")
                 .arg(text, locale.toString(qulonglong(done)), locale.toString(qulonglong(total))),
             double(done) / double(total));
  };
}

// Work that reads no files reports its progress by the cancel token.
JobRow Job::row() const {
  const std::lock_guard lock(state_->mutex);
  const JobName& name = state_->name;
  QString text = state_->text;
  if (text.isEmpty())
    text = name.text();
  else if (name.text() != name.doing)
    text = Jobs::tr("%1 (%2)").arg(name.text(), text);
  JobRow row{state_->id, text, state_->part, state_->since.elapsed(), true};
  if (const double done = state_->cancel.done(); row.part < 0 && done > 0) {
    row.part = done;
    row.text = Jobs::tr("%1: %2 %").arg(row.text).arg(std::floor(100 * done));
  }
  return row;
}

Jobs::Jobs(QObject* parent) : QObject(parent) {
  tick_.setInterval(100);
  connect(&tick_, &QTimer::timeout, this, &Jobs::changed);
}

std::vector<Jobs::Listed>::iterator Jobs::find(int id) {
  return std::ranges::find_if(listed_, [id](const Listed& listed) { return listed.job.id() == id; });
}

void Jobs::add(const Job& job, std::function<void()> cancelled, bool canBeCancelled) {
  listed_.push_back({job, std::move(cancelled), canBeCancelled});
  tick_.start();
  Q_EMIT changed();
}

void Jobs::remove(const Job& job) {
  const auto at = find(job.id());
  if (at == listed_.end()) return;
  listed_.erase(at);
  if (listed_.empty()) tick_.stop();
  Q_EMIT changed();
}

std::vector<JobRow> Jobs::rows() const {
  std::vector<JobRow> rows;
  for (const Listed& listed : listed_) {
    rows.push_back(listed.job.row());
    rows.back().canBeCancelled = listed.canBeCancelled;
  }
  return rows;
}

void Jobs::cancel(int id) {
  const auto at = find(id);
  if (at == listed_.end() || !at->canBeCancelled) return;
  const Listed listed = *at;
  listed.job.cancel().cancel();
  remove(listed.job);
  if (listed.cancelled) listed.cancelled();
}

}  // namespace volumen
