#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ui/document/job_lane.h"
#include "ui/workspace/session.h"
#include "viewer/volume/result.h"

namespace volumen {

/// Declares the signals of derivations, as templates cannot have any.
class DerivationSignals : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;

 Q_SIGNALS:
  /// A value is ready, could not be computed, or was dropped.
  void changed();
  /// A value cannot be computed; the sentence says why. Sent once until a version of the value is ready.
  void failed(const QString& sentence);
  /// The user cancelled.
  void cancelled();
};

/// Values of one kind that follow from the document. `Key` holds all inputs of a value. Whenever the document
/// changes, it compares the keys that it needs with what is there. It computes missing values on a lane, one
/// at a time and the most needed first, and cancels what is no longer needed. Readers find values by key and
/// hold none. A failure, lack of memory included, holds until the key changes, tryAgain(), or the rule's time
/// to try again.
template <class Key, class Value>
class Derivation : public DerivationSignals {
 public:
  using ValuePtr = std::shared_ptr<const Value>;
  using Work = std::function<Result<ValuePtr>(const Job&)>;

  /// What is there for a key. Without a value, `whyNot` is a sentence.
  struct Entry {
    Key key;
    ValuePtr value{};
    std::string whyNot{};
    bool isCancelled = false;   ///< whether the user cancelled it
    bool isTriedAgain = false;  ///< whether a failure no longer holds
    int failures = 0;           ///< number of failures in a row
  };

  struct Rule {
    /// Returns the keys of the values that the document needs, most needed first.
    std::function<std::vector<Key>()> wanted;
    /// Returns the computation of a value of at most `room` bytes, which runs on the lane.
    std::function<Work(const Key&, std::size_t room)> work;
    /// Returns the name of the job; an empty one is not listed.
    std::function<JobName(const Key&)> name;
    std::function<std::size_t(const Value&)> bytes;
    /// Returns whether two keys are versions of the same value. The old version stays until the new one is
    /// ready.
    std::function<bool(const Key&, const Key&)> areVersions = std::equal_to<Key>();
    /// Whether a version under way is finished although a newer one is needed, as for values that follow a
    /// drag.
    bool finishesVersions = false;
    /// Returns whether a value is computed within update(), as it takes less time than a picture. failed()
    /// does not report its failure.
    std::function<bool(const Key&)> isQuick = [](const Key&) { return false; };
    /// Returns whether a value that is not wanted stays while there is room.
    std::function<bool(const Key&)> isKept = [](const Key&) { return false; };
    /// Returns true while nothing may begin or end, as during a stroke.
    std::function<bool()> isPaused = [] { return false; };
    /// Returns whether this change of the workspace lets a failure be tried again.
    std::function<bool(const Entry&, const Workspace& before, const Workspace& after)> isTriedAgain =
        [](const Entry&, const Workspace&, const Workspace&) { return false; };
    /// Time before a failure is tried again, ms, doubled each time; 0: it holds. For values read from files.
    int tryAgainMs = 0;
    /// Returns the sentence that reports a failure.
    std::function<QString(const Key&, const std::string& whyNot)> failure =
        [](const Key&, const std::string& whyNot) { return QString::fromStdString(whyNot); };
    std::string lacksMemory;     ///< the reason if memory ran out
    std::string wasCancelled{};  ///< the reason if the user cancelled
    std::size_t mostBytes = std::size_t(-1);
  };

  Derivation(Rule rule, const Session& session, Jobs* list)
      : rule_(std::move(rule)), pool_(session.sharedPool()), lane_(list) {
    rest_.setSingleShot(true);
    connect(&rest_, &QTimer::timeout, this, [this] { tellChanged(); });
    connect(&session, &Session::workspaceChanged, this,
            [this](const Workspace& before, const Workspace& after) {
              for (Entry& entry : entries_)
                if (!entry.value && rule_.isTriedAgain(entry, before, after)) entry.isTriedAgain = true;
              update();
            });
    connect(&session, &Session::preferencesChanged, this, [this] { update(); });
  }
  ~Derivation() override { pool_->count(this, 0); }

  const std::vector<Entry>& entries() const { return entries_; }
  /// Returns the entry of exactly this key, or null.
  const Entry* find(const Key& key) const {
    const auto at = std::ranges::find(entries_, key, &Entry::key);
    return at == entries_.end() ? nullptr : &*at;
  }
  bool isBusy() const { return underWay_.has_value(); }

  /// Compares what is needed with what is there. To be called when an input outside the session has changed.
  void update() {
    if (rule_.isPaused()) return;
    const std::vector<Key> wanted = rule_.wanted();
    const bool isAnyNew = computeQuick(wanted);
    if (underWay_ && !isUseful(*underWay_, wanted)) {
      lane_.giveUpAll();
      underWay_.reset();
    }
    drop([&, at = std::size_t(0)](const Entry& entry) mutable {
      return !isNeeded(entry, wanted, at) && !rule_.isKept(entry.key);
    });
    const auto next = std::ranges::find_if(
        wanted, [&, at = std::size_t(0)](const Key& key) mutable { return isMissing(key, at); });
    if (!underWay_ && next != wanted.end()) begin(*next);
    if (isAnyNew) tellChanged();
  }

  /// Lets the failures of these keys be tried again at the next update().
  void tryAgain(const std::function<bool(const Key&)>& isOne) {
    for (Entry& entry : entries_)
      entry.isTriedAgain = entry.isTriedAgain || (!entry.value && isOne(entry.key));
  }

 private:
  static constexpr int restMs = 200;     // least time between two changed() while more values are computed
  static constexpr int mostDoubled = 6;  // of the time before a further try

  // Returns the element that `isIt` accepts, or null. The search begins at `at`, which is set behind the
  // element. Keys and entries mostly have the same order, so that thousands are compared in linear time.
  template <class Element, class IsIt>
  static const Element* findFrom(std::size_t& at, const std::vector<Element>& all, const IsIt& isIt) {
    const auto begin = all.begin() + std::ptrdiff_t(std::min(at, all.size()));
    auto found = std::find_if(begin, all.end(), isIt);
    if (found == all.end() && (found = std::find_if(all.begin(), begin, isIt)) == begin) return nullptr;
    at = std::size_t(found - all.begin()) + 1;
    return &*found;
  }

  bool isMissing(const Key& key, std::size_t& at) const {
    const Entry* entry = findFrom(at, entries_, [&](const Entry& one) { return one.key == key; });
    return !entry || entry->isTriedAgain;
  }
  bool isMissing(const Key& key) const {
    std::size_t at = 0;
    return isMissing(key, at);
  }
  bool isNeeded(const Entry& entry, const std::vector<Key>& wanted, std::size_t& at) const {
    return findFrom(at, wanted, [&](const Key& key) { return rule_.areVersions(key, entry.key); }) != nullptr;
  }

  // Returns whether the result of a computation is worth waiting for.
  bool isUseful(const Key& key, const std::vector<Key>& wanted) const {
    return std::ranges::any_of(wanted, [&](const Key& one) {
      return one == key || (rule_.finishesVersions && isMissing(one) && rule_.areVersions(one, key));
    });
  }

  std::size_t bytesBeside(const Key* key) const {
    std::size_t bytes = 0;
    for (const Entry& entry : entries_)
      if (entry.value && !(key && rule_.areVersions(entry.key, *key))) bytes += rule_.bytes(*entry.value);
    return bytes;
  }

  bool drop(const std::function<bool(const Entry&)>& isGone) {
    if (std::erase_if(entries_, isGone) == 0) return false;
    tellChanged();
    return true;
  }

  void tellChanged() {
    rest_.stop();
    told_.start();
    pool_->count(this, bytesBeside(nullptr));
    Q_EMIT changed();
  }

  // Returns the computation of a value in the room that is left. Lack of memory is an Error.
  Work workOf(const Key& key) const {
    const std::size_t beside = std::min(rule_.mostBytes, bytesBeside(&key));
    return [work = rule_.work(key, rule_.mostBytes - beside), lacksMemory = rule_.lacksMemory](
               const Job& job) { return orNoMemory([&] { return work(job); }, lacksMemory); };
  }

  bool computeQuick(const std::vector<Key>& wanted) {
    bool isAny = false;
    std::size_t at = 0;
    for (const Key& key : wanted) {
      if (!isMissing(key, at) || !rule_.isQuick(key)) continue;
      isAny = true;
      put(key, workOf(key)(Job(JobName())));
    }
    return isAny;
  }

  void begin(const Key& key) {
    underWay_ = key;
    lane_.run(
        rule_.name(key), workOf(key), [this, key](const Result<ValuePtr>& made) { take(key, made); },
        [this] { takeCancelled(); });
  }

  // If a computation fails, values that are not needed are dropped and it is tried once more.
  void take(const Key& key, const Result<ValuePtr>& made) {
    underWay_.reset();
    if (!made) {
      const std::vector<Key> wanted = rule_.wanted();
      const auto isSpare = [&, at = std::size_t(0)](const Entry& entry) mutable {
        return entry.value && !isNeeded(entry, wanted, at);
      };
      if (drop(isSpare)) return update();
    }
    const bool isNews = put(key, made) == 1;
    update();
    if (!underWay_ || !told_.isValid() || told_.elapsed() > restMs)
      tellChanged();
    else
      rest_.start(restMs);
    if (isNews) Q_EMIT failed(rule_.failure(key, made.message()));
  }

  // Marks all missing values as cancelled, so that one click cancels them all.
  void takeCancelled() {
    underWay_.reset();
    for (const Key& key : rule_.wanted())
      if (isMissing(key)) put({key, nullptr, rule_.wasCancelled, true});
    tellChanged();
    Q_EMIT cancelled();
  }

  // Returns the number of failures in a row; 0 for a value.
  int put(const Key& key, const Result<ValuePtr>& made) {
    if (made) {
      put({key, *made});
      return 0;
    }
    Entry entry{key, nullptr, made.message()};
    for (const Entry& old : entries_)
      if (rule_.areVersions(old.key, key)) entry.failures = std::max(entry.failures, old.failures);
    const int failures = ++entry.failures;
    put(std::move(entry));
    if (rule_.tryAgainMs > 0)
      QTimer::singleShot(rule_.tryAgainMs << std::min(failures - 1, mostDoubled), this, [this, key] {
        tryAgain([&](const Key& one) { return one == key; });
        update();
      });
    return failures;
  }

  // Puts the entry in the place of an older version, if there is one.
  void put(Entry entry) {
    const auto isOlder = [&](const Entry& old) { return rule_.areVersions(old.key, entry.key); };
    const auto place = std::ranges::find_if(entries_, isOlder);
    if (place == entries_.end()) return entries_.push_back(std::move(entry));
    entries_.erase(std::remove_if(place + 1, entries_.end(), isOlder), entries_.end());
    *place = std::move(entry);
  }

  const Rule rule_;
  const std::shared_ptr<SeriesPool> pool_;
  std::vector<Entry> entries_;
  std::optional<Key> underWay_;
  QElapsedTimer told_;  // since changed()
  QTimer rest_;         // until the next one, if there is news
  JobLane lane_;
};

}  // namespace volumen
